"""Home and plant page: what Python does, without a browser."""

import base64
import json
import re

import numpy as np
import pytest
from streamlit.testing.v1 import AppTest

from pages.common.session import project
from pages.common.session.design import Design
from pages.common.session.loops import Entry, Loops
from pages.common.session.tuning import Tuning
from simc_core import Plant, parse_plant
from simc_core.plants.examples import EVERYDAY, EXAMPLES
from tests.pages.tools import address, run_app, run_page, texts, unfold

PLACES = ("home", "plant", "half_rule", "tuning", "accuracy")


@pytest.mark.parametrize("place", PLACES)
def test_every_page_runs_alone_and_keeps_the_link(place):
    app = run_page(place, plant="2 exp(-s)/(10 s + 1)", tau_c="3")
    assert address(app)["tau_c"] == "3"
    assert "10 s + 1" in texts(app)


def test_home_offers_every_example_and_takes_one():
    app = unfold(run_app(), "papers")
    assert len([button for button in app.button if button.key and button.key.startswith("example_")]) == len(
        EVERYDAY
    ) + len(EXAMPLES)
    app.button(key=f"example_{EXAMPLES[1].key}").click().run()
    assert not app.exception
    assert parse_plant(address(app)["plant"]) == EXAMPLES[1].plant


def test_the_chain_is_there_to_click_and_marks_the_present_place():
    app = run_app()
    app.switch_page("../../half_rule.py").run()
    assert "**:blue[Half rule]**" in texts(app)


def test_text_entry_changes_plant_figures_and_address():
    app = run_page("plant")
    app.text_input("plant_text_text").set_value("3 e^{-0,5s}/(4s+1)").run()
    assert not app.error
    assert address(app)["plant"] == "3 exp(-0.5 s)/(4 s + 1)"
    step = json.loads(app.get("plotly_chart")[0].proto.spec)["data"][0]
    y = np.array(step["y"]) if isinstance(step["y"], list) else decoded(step["y"])
    assert y[-1] == pytest.approx(3.0, rel=0.02)


def decoded(array: dict) -> np.ndarray:
    """A typed array of plotly's JSON."""
    return np.frombuffer(base64.b64decode(array["bdata"]), array["dtype"])


def test_text_that_is_no_plant_stays_and_so_does_the_last_good_plant():
    app = run_page("plant")
    app.text_input("plant_text_text").set_value("3/(4s+1)").run()
    app.text_input("plant_text_text").set_value("3/(4s+").run()
    assert app.text_input("plant_text_text").value == "3/(4s+"
    assert len(app.error) == 1
    assert "^" in app.error[0].value
    assert address(app)["plant"] == "3/(4 s + 1)"
    app.text_input("plant_text_text").set_value("3/(4s+2)").run()
    assert not app.error
    assert address(app)["plant"] == "1.5/(2 s + 1)"


@pytest.mark.parametrize(("text", "at"), [("3/(4s+", 7), ("5 q/(4s+1)", 3), ("2/(4s+1)(s+1)", 9)])
def test_home_shows_what_was_typed_with_a_mark_below_the_fault(text, at):
    app = run_app()
    app.text_input(key="home_plant").set_value(text)
    next(button for button in app.button if button.label == "Tune").click().run()
    assert app.text_input(key="home_plant").value == text
    message, quoted, mark = re.search(r"(.*?)\n```text\n(.*?)\n(.*?)\n```", app.error[0].value).groups()
    assert f"position {at}" in message.replace("`", "").replace("(", "")
    assert quoted == text
    assert mark.index("^") == at - 1


@pytest.mark.parametrize(
    "text", ["", "s", "0/(s+1)", "1/(s+1)" * 500, "exp(2s)/(s+1)", "1e300/(s+1)", "1/(s+1)^200", "__import__('os')"]
)
def test_hostile_text_gives_a_message_and_no_traceback(text):
    app = run_page("plant")
    app.text_input("plant_text_text").set_value(text).run()
    assert not app.exception
    assert app.error


def test_ways_of_entry_describe_one_plant():
    app = run_page("plant", plant="2 exp(-0.5 s)/((3 s + 1) (4 s + 1))")
    app.segmented_control("plant_way").set_value("Polynomials").run()
    assert app.text_input("plant_polynomials_den").value == "12 7 1"
    assert app.text_input("plant_polynomials_num").value == "2"
    app.text_input("plant_polynomials_num").set_value("4").run()
    assert not app.error
    assert address(app)["plant"].startswith("4 exp(-0.5 s)")
    app.text_input(key="plant_polynomials_theta").set_value("-1").run()
    assert "Dead time θ must be ≥ 0, found −1" in app.error[0].value
    assert address(app)["plant"].startswith("4 exp(-0.5 s)")
    app.segmented_control("plant_way").set_value("Factors").run()
    app.text_input(key="plant_factors_k").set_value("0").run()
    assert "Gain k must not be zero" in app.error[0].value
    app.text_input(key="plant_factors_k").set_value("5").run()
    assert not app.error
    assert address(app)["plant"].startswith("5 exp(-0.5 s)")


def test_examples_can_be_chosen():
    app = run_page("plant")
    app.segmented_control("plant_way").set_value("Examples").run()
    app.selectbox("plant_example").select(EXAMPLES[-1].name).run()
    assert not app.exception
    assert app.selectbox("plant_example").value == EXAMPLES[-1].name


def test_nonsense_in_a_link_is_named_and_the_rest_taken():
    app = run_page("tuning", plant="2/(5s+1)", tau_c="soon", colour="red", order="2")
    shown = app.warning[0].value
    assert "`tau_c = soon` was ignored: a number was expected" in shown
    assert "`colour = red` was ignored" in shown
    assert address(app) == {"plant": "2/(5 s + 1)", "order": "2"}
    next(button for button in app.button if button.label == "Dismiss").click().run()
    assert "colour" not in texts(app)


def test_another_link_in_the_same_session_opens_what_it_says_and_nothing_of_the_former():
    app = run_page("plant", plant="2/(5s+1)", tau_c="3", b="0.5")
    app.query_params.clear()
    app.query_params.update({"plant": "3/(4s+1)", "order": "2"})
    app.run()
    assert address(app) == {"plant": "3/(4 s + 1)", "order": "2"}


def test_state_survives_the_way_through_the_pages():
    app = run_app(plant="2 exp(-s)/(10 s + 1)", tau_c="3", b="0.5")
    for name in PLACES[1:]:
        app.query_params.clear()  # as the navigation does
        app.switch_page(f"../../{name}.py").run()
        assert not app.exception
        assert address(app) == {"plant": "2 exp(-s)/(10 s + 1)", "order": "1", "tau_c": "3", "b": "0.5"}


def test_a_project_file_is_opened_and_a_wrong_one_changes_nothing():
    app = run_page("plant", plant="2/(5s+1)", b="0.5")
    wanted = project.dump(Loops((Entry(Design(Plant(7.0, 1.0, (9.0,)), Tuning(2, tau_c=3.0))),)))
    upload(app, "wrong.json", wanted.replace('"version": 2', '"version": 7'))
    assert "nothing changed: version must be 1 or 2, found 7" in app.error[0].value
    assert address(app) == {"plant": "2/(5 s + 1)", "order": "1", "b": "0.5"}
    upload(app, "right.json", wanted)
    assert not app.error
    assert "Opened: `right.json`" in texts(app)
    assert address(app) == {"plant": "7 exp(-s)/(9 s + 1)", "order": "2", "tau_c": "3"}
    assert app.text_input("plant_text_text").value == "7 exp(-s)/(9 s + 1)"


def upload(app: AppTest, name: str, content: str) -> None:
    app.file_uploader("project_file").set_value((name, content.encode(), "application/json")).run()
    assert not app.exception
