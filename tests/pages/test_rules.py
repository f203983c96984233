"""Page of rules: the table, what is picked of it, and where that goes; links, plants of all kinds, a word on each."""

import json

import numpy as np
import pytest

from pages.common.rules import remarks
from pages.common.rules.plane import ground
from pages.common.rules.table import Question, question_of, rows_of
from pages.common.session.compared import OPTIMAL, USUAL, Compared
from pages.common.session.design import Design
from pages.common.session.time_unit import in_time_unit
from pages.common.studies.single import attempt, present_study
from simc_core import RULES, IdealPid, InvalidParameter, Plant, SeriesPid, parse_plant
from tests.pages.tools import address, run_page, texts

LAG = "exp(-s)/(8s+1)"
PLANE = "Kc and τI"


def rules(picture="", **parameters):
    return run_page("rules", picture, "rules_picture", plant=LAG, **parameters)


def listed(app):
    """The rows of the table by rule, and by kind where there are two."""
    table = app.dataframe[0].value
    names = table["rule"] + (" " + table["kind"] if "kind" in table else "")
    return dict(zip(names, table.to_dict("records"), strict=True))


def specs(app):
    return [json.loads(chart.proto.spec) for chart in app.get("plotly_chart")]


def named(figure, name):
    return next(trace for trace in figure["data"] if trace.get("name") == name)


def test_every_PI_rule_is_listed_as_its_source_has_it():
    app = rules()
    table = listed(app)
    assert len(table) == sum("PI" in rule.kinds for rule in RULES.values())
    assert (table["SIMC"]["Kc"], table["SIMC"]["τI"]) == (4, 8)
    assert (table["Ziegler-Nichols, step"]["Kc"], table["Ziegler-Nichols, step"]["Mst"]) == pytest.approx(
        (7.2, 3.271), rel=2e-4
    )
    assert table["SIMC"]["Mst"] == pytest.approx(1.59, abs=5e-3)
    assert table["Lambda"]["behind, %"] > 0  # Mst 1.104, below where the front begins
    assert "**SIMC, PI**" in texts(app)


def test_at_equal_robustness_the_numbers_are_those_that_are_known():
    table = listed(rules(compared_Ms="1.59", compared_kind="both"))
    found = {name: (row["F"], row["IAE load"], row["J"]) for name, row in table.items()}
    assert found["SIMC PI"] == pytest.approx((1.0006, 2.0012, 1.3820), rel=6e-5)
    assert found["AMIGO PI"] == pytest.approx((0.6529, 1.2327, 1.2326), rel=8e-5)
    assert found["iSIMC PID"] == pytest.approx((1.1746, 1.5520, 1.1251), rel=6e-5)
    assert found["optimum PI"][1:] == pytest.approx((1.1345, 1.2477), rel=6e-4)
    assert table["SIMC PI"]["behind, %"] == pytest.approx(100 * (2.0012 / 1.13450 - 1), abs=0.02)


def test_the_comparison_of_SG12_is_one_click_away():
    """[SG12] prints J = 1.23 for the best PI on e^{-s}/(8s+1); SIMC has 1.38 here."""
    app = rules()
    app.button(key="rules_SG12").click().run()
    table = listed(app)
    assert table["optimum"]["J"] == pytest.approx(1.2270, abs=6e-5)
    assert table["SIMC"]["behind, %"] == pytest.approx(100 * (1.3820 / 1.2270 - 1), abs=0.02)
    assert (address(app)["compared_plant"], address(app)["compared_criterion"]) == ("lag", "J")


def test_one_of_the_usual_plants_is_compared_and_named():
    app = rules(compared_plant="integrating")
    assert "not on the plant of this design" in texts(app)
    assert listed(app)["AMIGO"]["Mst"] == pytest.approx(1.410, abs=6e-4)
    assert app.button(key="rules_pin").disabled


def test_a_rule_of_a_link_is_drawn_with_a_word_on_it():
    app = rules(compared_kind="PID", compared_rule="zn_step-PID")
    assert "**Ziegler-Nichols, step, PID**, \\[[ZN42](sources?source=ZN42 " in texts(app)
    assert "raises $K_c$ by 1.25" in texts(app)
    trade_off, y, _ = specs(app)
    assert {trace["name"] for trace in y["data"]} >= {"Ziegler-Nichols, step, PID", "my design", "r"}
    assert {trace["name"] for trace in trade_off["data"]} >= {"best PI", "best PID", "PID rules", "my design"}


def test_a_rule_without_settings_says_why():
    app = rules(compared_rule="symmetrical_optimum-PI")
    assert "Integrators must be 1" in app.info[0].value
    assert not [button for button in app.button if button.key == "rules_take"]


def test_a_rule_is_taken_over_as_my_settings():
    app = rules(compared_rule="amigo-PI")
    app.button(key="rules_take").click().run()
    assert not app.exception
    assert address(app)["controller"] == "own"
    form, Kc, tau_I, *_ = address(app)["own"].split("~")
    assert (form, float(Kc), float(tau_I)) == ("ideal", pytest.approx(2.160, abs=5e-4), pytest.approx(5.332, abs=5e-4))


def test_with_another_plant_it_begins_another_loop():
    app = rules(compared_plant="integrating", compared_rule="simc-PI", b="0.7")
    app.button(key="rules_take").click().run()
    assert address(app)["plant"] == "exp(-s)/s"
    assert address(app)["own"].startswith("series~0.5~8~")
    assert len(app.selectbox(key="loop").options) == 2


def test_a_rule_is_pinned_for_the_tuning_page():
    app = rules(compared_rule="amigo-PI")
    app.button(key="rules_pin").click().run()
    assert address(app)["pins"].startswith("ideal~2.1598")
    assert app.button(key="rules_pin").disabled


def test_what_is_asked_is_in_the_address():
    app = rules()
    app.segmented_control(key="widget_compared_kind").set_value("PID").run()
    app.segmented_control(key="rules_equal").set_value(True)
    app.segmented_control(key="widget_compared_criterion").set_value("setpoint")
    app.text_input(key="widget_compared_tau_F").set_value("0,2").run()
    assert not app.exception
    asked = {name.removeprefix("compared_"): text for name, text in address(app).items() if name.startswith("compared")}
    assert asked == {"kind": "PID", "Ms": "1.59", "criterion": "setpoint", "tau_F": "0.2"}
    app.segmented_control(key="rules_equal").set_value(False).run()
    assert "compared_Ms" not in address(app)


@pytest.mark.parametrize(
    ("name", "value"),
    [("plant", "x"), ("kind", "PD"), ("Ms", "1"), ("Ms", "9"), ("tau_F", "-1"), ("rule", "zn-PI"), ("rule", "simc")],
)
def test_nonsense_in_a_link_is_left_out_and_told(name, value):
    app = rules(**{f"compared_{name}": value})
    assert "not understood" in app.warning[0].value
    assert not app.exception
    assert app.dataframe


PLANTS = {
    "pure dead time": "exp(-2s)",
    "integrating": "0.05 exp(-2s)/s",
    "double integrating": "exp(-s)/s^2",
    "unstable": "2 exp(-s)/(10s-1)",
    "oscillating": "exp(-s)/(4s^2+0.8s+1)",
    "negative gain": "-1.5 exp(-4s)/((20s+1)(3s+1))",
    "no dead time": "1/(s+1)",
    "two lags": "1/((s+1)(0.2s+1))",
    "not reducible": "1/((s^2+0.6s+1)(s^2+0.2s+1))",
    "inverse response": "(1-2s)/(s+1)^3",
}


@pytest.mark.parametrize("plant", PLANTS.values(), ids=PLANTS.keys())
def test_plants_of_all_kinds_are_compared_or_refused_in_words(plant):
    app = run_page("rules", PLANE, "rules_picture", plant=plant)
    assert not app.exception
    table = app.dataframe[0].value
    assert len(table) == Question(Plant(1, 1), ("PI",), None, 0.1, "load").total
    assert ((table["remark"] != "") == table["Mst"].isna()).all()


def ground_of(plant, own=None):
    design = Design(plant=plant, own=own, source="own" if own else "simc")
    question = question_of(design)
    rows = list(rows_of(question))
    chosen = next(row for row in rows if row.key == "simc")
    present, _ = attempt(lambda: present_study(design))
    return ground(question, rows, chosen, present, mine=True)


def test_the_plane_shows_what_is_known_of_a_lag():
    """tau_I = tau1 = 8: L = a e^{-s}/s, Mst 1.59 at a = 0.499705; Kc = 10 is stable from tau_I = 2.11568 on."""
    plane = ground_of(Plant(1, 1, (8,))).plane
    contour, limit = next(each for each in plane["contours"] if each["level"] == "1.59"), plane["limit"]
    assert np.interp(8, contour["y"], contour["x"]) == pytest.approx(8 * 0.499705, rel=3e-3)
    x, y = np.log(limit["x"]), np.log(limit["y"])
    assert np.interp(np.log(10), x, y) == pytest.approx(np.log(2.11568), abs=0.03)
    assert next(each for each in plane["points"] if each["key"] == "simc-PI")["x"] == 4


def test_the_point_of_the_plane_stands_on_my_settings():
    mine = IdealPid(5.0, 3.0, 0.0, 0.0, 0.7)
    there = ground_of(Plant(1, 1, (8,)), mine)
    assert there.controller == mine
    assert there.plane["name"] == "my settings"
    assert there.Kc[0] < 5 < there.Kc[1]
    assert there.tau_I[0] < 3 < there.tau_I[1]


def test_where_I_have_no_PI_settings_the_point_begins_at_the_rule_that_was_picked():
    there = ground_of(Plant(1, 1, (8, 2)), SeriesPid(2, 8, 2, 0.1))
    assert (there.controller.Kc, there.controller.tau_D) == (SIMC_PI_OF_8_2, 0.0)
    assert there.plane["name"] == "settings to try"


SIMC_PI_OF_8_2 = 9 / (2 * 2)  # half rule: tau1 9, theta 2


def test_the_limit_of_an_unstable_plant_has_two_sides():
    """2 e^{-s}/(10 s - 1): below Kc = 1/2 no integral time will do, nor above the ultimate gain."""
    limit = ground_of(parse_plant("2 exp(-s)/(10s-1)")).plane["limit"]
    lowest = int(np.argmin(limit["y"]))
    assert min(limit["y"][0], limit["y"][-1]) > 5 * limit["y"][lowest]
    assert limit["x"][0] == pytest.approx(0.5, rel=0.15)


@pytest.mark.parametrize("plant", PLANTS.values(), ids=PLANTS.keys())
def test_the_point_has_a_place_on_every_plant(plant):
    there = ground_of(parse_plant(plant))
    assert there.Kc[0] <= abs(there.controller.Kc) <= there.Kc[1]
    assert there.tau_I[0] <= there.controller.tau_I <= there.tau_I[1]
    json.dumps(there.plane, allow_nan=False)


def test_each_rule_has_a_word_and_each_misprint_its_rule():
    assert remarks.MADE_FOR.keys() == RULES.keys() | {OPTIMAL}
    assert remarks.IN_CIRCULATION.keys() <= RULES.keys()


def test_rows_are_made_once_for_all_who_ask():
    question = Question(USUAL["lag"].plant, ("PI",), None, 0.1, "load")
    first = list(rows_of(question))
    assert rows_of(question).complete
    assert [id(row) for row in rows_of(question)] == [id(row) for row in first]
    assert len(first) == question.total


def test_the_filter_is_a_time_of_the_design_and_not_of_another_plant():
    design = Design(compared=Compared(kind="PID", tau_F=2.0))
    minutes = in_time_unit(in_time_unit(design, "min"), "s")
    assert question_of(minutes).tau_F == 120
    usual = Design(compared=Compared(plant="lag", kind="PID", tau_F=2.0))
    assert question_of(in_time_unit(in_time_unit(usual, "min"), "s")).tau_F == 2


def test_bounds_are_told_by_name():
    with pytest.raises(InvalidParameter, match="compared_plant must be one of balanced"):
        Compared(plant="nowhere")
    with pytest.raises(InvalidParameter, match=r"Ms must be >= 1\.1"):
        Compared(Ms=1.0)


def test_further_measures_are_columns_where_they_are_chosen():
    """SIMC on e^{-s}/(8s+1): bandwidth of S 0.355417, IE tau_I/Kc = 2; a rule without settings has a dash."""
    app = rules(unit="s")
    assert "IE, load" not in app.dataframe[0].value
    app.multiselect(key="rules_measures").set_value(["bandwidth of S", "IE, load", "settling to 5 %, load"]).run()
    assert not app.exception
    table = listed(app)
    assert table["SIMC"]["bandwidth of S [rad/s]"] == pytest.approx(0.355417, abs=5e-7)
    assert table["SIMC"]["IE, load"] == 2.0
    assert table["SIMC"]["settling to 5 %, load [s]"] < table["Lambda"]["settling to 5 %, load [s]"]
    assert np.isnan(table["symmetrical optimum"]["IE, load"])


def rows_on(name, kind="PI", **how):
    design = Design(compared=Compared(plant=name, kind=kind, **how))
    return {row.key: row for row in rows_of(question_of(design))}


@pytest.mark.parametrize(
    ("name", "kind", "which", "expected"),
    [
        ("integrating", "PI", 0, (0.5, 8, 0)),  # example 3
        ("SK98-4", "PID", 0, (0.0625, 8, 8)),
        ("SK98-5a", "PI", 1, (50, 8, 0)),
        ("SK98-9", "PI", 0, (0.5, 8 * 2.5, 0)),  # f = 2.5 at a theta = 0.25
    ],
)
def test_the_examples_of_SK98_have_the_settings_that_are_printed(name, kind, which, expected):
    printed = USUAL[name].printed[which]
    assert (printed.Kc, printed.tau_I, printed.tau_D) == expected
    found = rows_on(name, kind)["simc"].controller.to_series()
    assert (found.Kc, found.tau_I, found.tau_D) == pytest.approx(expected, rel=1e-12)


def test_the_pure_dead_time_of_SK98_has_the_integral_gain_that_is_printed():
    integral, as_PI = USUAL["delay"].printed
    assert rows_on("delay")["simc"].controller == integral
    assert as_PI.Kc / as_PI.tau_I == integral.K_I == 0.5


def test_an_unstable_plant_of_SK98_is_the_one_that_is_printed():
    """e^{-s}/(s - 0.25)."""
    s = 0.3 + 0.7j
    assert USUAL["SK98-9"].plant.response(s) == pytest.approx(np.exp(-s) / (s - 0.25))


@pytest.mark.parametrize(
    ("name", "rule", "J", "Ms"), [("delay", "simc", 1.35, 1.59), ("integrating", "simc", 1.43, 1.70)]
)
def test_the_comparison_of_SG12_has_its_printed_numbers(name, rule, J, Ms):
    """Table 5.4; the references of Table 5.3 are rounded, which is 0.6 % of J."""
    row = rows_on(name, criterion="J")[rule]
    assert (row.J, row.Mst) == (pytest.approx(J, abs=0.0085), pytest.approx(Ms, abs=0.0065))


@pytest.mark.parametrize(("name", "J"), [("integrating", 1.51), ("lag", 1.23)])
def test_the_best_of_SG12_is_the_one_that_is_printed(name, J):
    """Table 5.3, combined."""
    best = rows_on(name, criterion="J", Ms=1.59)["optimal"]
    assert pytest.approx(J, abs=0.0075) == best.J


@pytest.mark.parametrize("name", USUAL)
def test_the_page_opens_on_every_preset(name):
    app = rules(compared_plant=name)
    assert not app.exception
    assert ("Settings printed in" in texts(app)) == bool(USUAL[name].printed)


def test_what_is_said_of_SIMC_is_true_of_an_oscillating_plant_too():
    """[SK03 Table 1]: tau_I = 2 zeta tau0 there, of which the limit 4 (tau_c + theta) says nothing."""
    told = texts(run_page("rules", plant="exp(-s)/(4s^2+0.4s+1)", compared_kind="PID"))
    assert "For lags and integrators $\\tau_I \\le 4(\\tau_c + \\theta)$" in told


def test_the_action_is_told_beside_a_negative_gain():
    """The table has sizes: [SK03] Kc = tau1/(k (tau_c + theta)) is negative here."""
    assert "direct action" in texts(run_page("rules", PLANE, "rules_picture", plant=PLANTS["negative gain"]))
    assert "reverse action" in texts(rules(PLANE))
