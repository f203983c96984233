"""What a record leaves open goes from the page From data to the tuning page, in the address and in other units."""

import re
from dataclasses import replace

import numpy as np
import pytest

from pages.common.session import links, project
from pages.common.session.design import Design
from pages.common.session.loops import Entry, Loops
from pages.common.session.record import Origin
from pages.common.session.time_unit import in_time_unit
from pages.common.studies.uncertain import fastest
from simc_core import FirstOrderDelay, Loop, Plant, Uncertainty, margins, ms_of_plants, parse_plant, simc
from tests.pages.tools import address, run_page, texts

PLANT = FirstOrderDelay(2.0, 12.0, 60.0).plant
KNOWN = Uncertainty("FOPDT", (12.0, float(np.log(60.0)), 2.0), (4.0, 0.0, 0.0, 0.01, 0.0, 0.02), 60.0)
DESIGN = replace(
    Design(), plant=PLANT, origin=Origin(PLANT, "FOPDT", (0.1, 2.0, 6.0), 0.97, 500, "tank"), uncertainty=(KNOWN,)
)


def test_links_and_files_hold_it():
    assert links.decode(links.encode(DESIGN)) == (DESIGN, [])
    backwards = dict(reversed(links.encode(DESIGN).items()))
    assert links.decode(backwards) == (DESIGN, [])
    kept, why = project.load(project.dump(Loops((Entry(DESIGN, "a"),), 0)).encode())
    assert not why
    assert kept.design == DESIGN


def test_another_plant_has_none():
    assert replace(DESIGN, plant=Plant(1, 1, (2,))).uncertainty == ()


def test_nonsense_in_an_address_is_told():
    given = links.encode(DESIGN)
    for text in ("ARX~1", "FOPDT~5~1~2", "FOPDT~a", "FOPDT~60~12~4~2~-4~0~0~0~0~0"):
        design, ignored = links.decode(given | {"uncertainty": text})
        assert design.uncertainty == ()
        assert [each.name for each in ignored] == ["uncertainty"]


def test_another_time_unit_leaves_the_probabilities_alone():
    seconds = replace(DESIGN, sheet=replace(DESIGN.sheet, time_unit="s"))
    minutes = in_time_unit(seconds, "min")
    ours = ms_of_plants(seconds.uncertainty, simc(FirstOrderDelay(2, 12, 60)))
    theirs = ms_of_plants(minutes.uncertainty, simc(FirstOrderDelay(2, 0.2, 1)))
    assert theirs == pytest.approx(ours, rel=1e-6)


def test_the_page_tells_the_probability_and_makes_the_loop_safe():
    app = run_page("tuning", view="Model error", **links.encode(DESIGN))
    assert "with a probability of" in texts(app)
    shown = float(re.search(r"not above \*\*([\d.]+)\*\* with 95", texts(app))[1])
    Ms = ms_of_plants(KNOWN, simc(FirstOrderDelay(2, 12, 60)))
    assert shown == pytest.approx(np.quantile(Ms, 0.95, method="higher"), abs=0.006)
    app.selectbox(key="uncertain_limit").set_value(1.4).run()
    app.button(key="safe_tau_c").click().run()
    assert not app.exception
    tau_c = float(address(app)["tau_c"])
    assert tau_c > 12
    slower = ms_of_plants(KNOWN, simc(FirstOrderDelay(2, 12, 60), tau_c))
    assert np.mean(slower <= 1.4) >= 0.95
    assert any("it is in use" in item.value for item in app.caption)


def test_changes_in_per_cent_are_still_there():
    app = run_page("tuning", view="Model error", **links.encode(DESIGN))
    app.segmented_control(key="errors").set_value("In per cent").run()
    assert not app.exception
    assert app.slider(key="change").value == 20


def test_a_plant_with_doubt_beyond_all_bounds_says_so():
    vague = Uncertainty("FOPDT", (12.0, float(np.log(60.0)), 2.0), (400.0, 0.0, 0.0, 4.0, 0.0, 2.0), 5.0)
    app = run_page("tuning", view="Model error", **links.encode(replace(DESIGN, uncertainty=(vague,))))
    assert "Not stable" in texts(app)
    assert any("says too little to tune on" in item.value for item in app.warning)


def test_the_fastest_is_theta_where_nothing_is_in_doubt():
    sure = Uncertainty("FOPDT", KNOWN.values, (1e-12, 0.0, 0.0, 1e-12, 0.0, 1e-12), 60.0)
    assert fastest(PLANT, Design().tuning, (sure,), 1.7, 0.95) == pytest.approx(12, rel=1e-4)


@pytest.mark.parametrize("kind", ["PI", "PID"])
def test_auto_tuning_takes_its_settings_to_the_tuning_page(kind):
    app = run_page("from_data", view="Auto-tuning", tabs="ways", example="noisy")
    if kind == "PID":
        app.segmented_control(key="auto_kind").set_value(kind).run()
    table = next(item.value for item in app.dataframe if "Ms 95 %" in item.value)
    assert list(table.iloc[:, 0]) == ["Load, damped", "Load, fast", "Set point, damped", "Set point, fast"]
    app.selectbox(key="auto_chosen").set_value("Load, fast").run()
    app.button(key="tune_auto").click().run()
    assert not app.exception
    design, ignored = links.decode(address(app))
    assert not ignored
    assert design.source == "own"
    assert design.uncertainty[0].structure == "FOPDT"
    assert margins(Loop(parse_plant("0.8 exp(-20s)/(45s+1)"), design.own)).Ms < 2.1  # made with this process
