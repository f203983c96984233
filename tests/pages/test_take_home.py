"""Take home: the numbers typed into a box, proof beside them, and the way back to my settings."""

import pytest

from simc_core import BOXES
from tests.pages.tools import address, run_page

PLANT = "exp(-3s)/((6s+1)(4s+1)(2s+1))"  # [V06] example 1: Kc 0.5714, tau_I 8


def typed(app) -> str:
    """All that is written as HTML on the page."""
    return " ".join(str(block.proto) for block in app.get("html"))


def test_without_a_box_the_page_says_what_to_choose():
    app = run_page("take_home", plant=PLANT)
    assert not app.exception
    assert "Choose what you type" in app.info[0].value


def test_a_proportional_band_and_minutes_per_repeat():
    """Kc 4/7 is a band of 175 %, tau_I 8 s are 0.1333 min."""
    app = run_page("take_home", plant=PLANT, unit="s", box="honeywell_udc")
    assert not app.exception
    text = typed(app)
    assert "175" in text
    assert "0.14" in text  # minutes, to two digits and up
    assert "reverse" in text.lower()
    assert address(app)["box"] == "honeywell_udc"


@pytest.mark.parametrize("key", list(BOXES))
def test_every_box_is_shown_or_refuses_in_words(key):
    app = run_page("take_home", plant=PLANT, unit="min", box=key, order="2", filter="0.1")
    assert not app.exception
    assert app.dataframe or app.error


def test_sampling_stands_beside_the_continuous_loop():
    app = run_page("take_home", plant=PLANT, unit="s", box="matlab_pid", sampling="2")
    assert not app.exception
    assert list(app.dataframe[0].value.columns) == ["quantity", "design", "as typed", "sampled every 2 s"]


def test_numbers_in_the_box_become_my_settings():
    app = run_page("take_home", plant=PLANT, unit="s", box="honeywell_udc")
    fields = {each.label.split(" [")[0]: each for each in app.text_input}
    fields["PB"].set_value("50").run()
    fields = {each.label.split(" [")[0]: each for each in app.text_input}
    fields["RSET"].set_value("0,5").run()
    app.button(key="from_box").click().run()
    assert address(app)["controller"] == "own"
    own = address(app)["own"].split("~")
    assert float(own[1]) == pytest.approx(2.0)
    assert float(own[2]) == pytest.approx(30.0)
