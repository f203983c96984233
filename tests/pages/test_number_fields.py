"""Every number field reads what people type, or says why not and keeps it; without a browser."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pages.common.session.links import number_text
from simc_core import parse_plant
from simc_core.numbers import read_number
from tests.pages.tools import address, run_page, texts, unfold

PLANT = "2 exp(-3 s)/((20 s + 1) (4 s + 1))"
TYPED = {  # what is typed, and the number meant
    "0,5": 0.5,
    "0.5": 0.5,
    ",5": 0.5,
    " 1/2 ": 0.5,
    "11/10": 1.1,
    "5e-1": 0.5,
    "1,25": 1.25,
}
REFUSED = {"1,234": "two ways", "abc": "one number", "1..5": "one number", "": "nothing", "1 5": "without blanks"}


def opened(page: str, view: str, tabs: str, way: str = "", **parameters: str):
    app = run_page(page, view, tabs, plant=PLANT, **parameters)
    if page == "tuning":
        unfold(app, "excitation")
    if way:
        app.segmented_control("plant_way").set_value(way).run()
    return app


# page, open tab, the tabs, way of entry, key of the widget, name in the address (None: not in it)
FIELDS = {
    "tau_c": ("tuning", "Figures", "views", "", "tau_c_exact", "tau_c"),
    "b": ("tuning", "Figures", "views", "", "widget_b", "b"),
    "filter": ("tuning", "Figures", "views", "", "widget_filter", "filter"),
    "u_max": ("tuning", "As built", "views", "", "widget_u_max", "u_max"),
    "T_t": ("tuning", "As built", "views", "", "widget_T_t", "T_t"),
    "sampling": ("tuning", "As built", "views", "", "widget_sampling", "sampling"),
    "noise": ("tuning", "As built", "views", "", "widget_noise", "noise"),
    "r": ("tuning", "As built", "views", "", "widget_r", "r"),
    "d": ("tuning", "As built", "views", "", "widget_d", "d"),
    "b_outer": ("cascade", "Settings", "cascade_views", "", "widget_b_outer", "b_outer"),
    "tau_c_inner": ("cascade", "Settings", "cascade_views", "", "tau_c_inner_exact", "tau_c_inner"),
    "N_outer": ("cascade", "Settings", "cascade_views", "", "widget_N_outer", "N_outer"),
    "k": ("plant", "", "views", "Factors", "plant_factors_k", None),
    "theta": ("plant", "", "views", "Polynomials", "plant_polynomials_theta", None),
    "parameter": ("plant", "", "views", "k, θ, τ", "plant_parameters_tau2", None),
}
FOLDED = {
    "tuning": ("change_plant", "literature", "now", "excitation"),
    "cascade": ("enter_Ga", "enter_Gb"),
}
MORE = {"tau_c_inner": {"tau_c_inner": "2"}, "N_outer": {"method": "synthesis"}}
OPTIONAL = {"u_max", "T_t", "parameter"}


def in_use(app, field: str) -> float | None:
    """The number that the design has now."""
    name = FIELDS[field][-1]
    if name is not None:
        return float(address(app)[name]) if name in address(app) else None
    plant = parse_plant(address(app)["plant"])
    return {"k": plant.k, "theta": plant.theta, "parameter": min(plant.lags)}[field]


@pytest.mark.parametrize("field", FIELDS)
def test_each_field_takes_comma_and_point_and_keeps_what_was_typed(field):
    *where, key, _ = FIELDS[field]
    app = opened(*where, **MORE.get(field, {}))
    for text, meant in list(TYPED.items())[:: 1 if field == "b" else 3]:  # one field with all, all with some
        app.text_input(key=key).set_value(text).run()
        assert not app.exception
        assert in_use(app, field) == pytest.approx(meant, rel=1e-12)
        assert app.text_input(key=key).value == text.strip()
    app.text_input(key=key).set_value("1,1").run()
    assert in_use(app, field) == pytest.approx(1.1)


@pytest.mark.parametrize("field", FIELDS)
def test_each_field_refuses_in_words_and_the_last_good_value_stays(field):
    *where, key, _ = FIELDS[field]
    app = opened(*where, **MORE.get(field, {}))
    app.text_input(key=key).set_value("0,75").run()
    for text, why in list(REFUSED.items())[:: 1 if field == "b" else 2]:
        if not text and field in OPTIONAL:
            continue
        app.text_input(key=key).set_value(text).run()
        said = "\n".join(error.value for error in app.error)
        assert why in said
        assert "0.75 stays in use" in said
        assert in_use(app, field) == 0.75
        assert app.text_input(key=key).value == text
    app.text_input(key=key).set_value("0.8").run()
    assert not [error for error in app.error if "stays in use" in error.value]
    assert in_use(app, field) == 0.8


@pytest.mark.parametrize(
    ("field", "text", "why"),
    [
        ("b", "2,5", "b must be ≤ 2, found 2.5"),
        ("b", "−1", "b must be ≥ 0, found −1"),
        ("filter", "11", "τF/τD must be ≤ 10, found 11"),
        ("tau_c", "-3", "τc, exact must be > 0, found −3"),
        ("tau_c", "1e12", "between 1e-09 and 1e+09, found 1e+12"),
        ("u_max", "-0,1", "Highest u must be ≥ 0, where the loop is at rest, found −0.1"),
        ("sampling", "−2", "Sampling of the controller must be ≥ 0, found −2"),
        ("k", "0", "Gain k must not be zero"),
        ("theta", "−0,5", "Dead time θ must be ≥ 0, found −0.5"),
        ("N_outer", "0", "N must be ≥ 0.1, found 0"),
    ],
)
def test_bounds_are_told_with_field_bound_and_value(field, text, why):
    *where, key, _ = FIELDS[field]
    app = opened(*where, **MORE.get(field, {}))
    before = in_use(app, field)
    app.text_input(key=key).set_value(text).run()
    assert why in "\n".join(error.value for error in app.error)
    assert in_use(app, field) == before
    assert app.text_input(key=key).value == text


@pytest.mark.parametrize("minus", "-−–‒﹣－")
def test_any_minus_sign_is_one(minus):
    app = run_page("tuning", "As built", plant=PLANT)
    app.text_input(key="widget_u_min").set_value(f"{minus}1,5").run()
    assert address(app)["u_min"] == "-1.5"


@pytest.mark.parametrize("text", ["1 200", "1\u202f200", "1'200", "1,200.0", "1.200,0", "1_200", "12e2"])
def test_thousands_where_they_cannot_be_mistaken(text):
    app = run_page("tuning", "Figures", plant="exp(-30s)/(800s+1)")
    app.text_input(key="tau_c_exact").set_value(text).run()
    assert not app.error
    assert address(app)["tau_c"] == "1200"


def test_a_field_that_may_be_empty_is_emptied_and_says_what_that_means():
    app = run_page("tuning", "As built", plant=PLANT, u_max="2")
    app.text_input(key="widget_u_max").set_value("").run()
    assert not app.error
    assert "u_max" not in address(app)
    assert app.text_input(key="widget_u_max").placeholder == "no limit"


def test_a_refusal_goes_when_what_it_was_about_has_gone():
    """u within [0, 0] leaves nothing; with another lower limit an upper one of 0 is possible again."""
    app = run_page("tuning", "As built", plant=PLANT, u_min="0", u_max="1")
    app.text_input(key="widget_u_max").set_value("0").run()
    assert app.error
    app.text_input(key="widget_u_min").set_value("-1").run()
    assert not app.error
    assert app.text_input(key="widget_u_max").value == "1"


def test_what_cannot_be_used_stays_while_other_fields_change():
    app = opened("plant", "", "views", "Factors")
    app.text_input(key="plant_factors_k").set_value("1,234").run()
    app.text_input(key="plant_factors_theta").set_value("5").run()
    assert app.text_input(key="plant_factors_k").value == "1,234"
    assert "2 stays in use" in app.error[0].value
    assert parse_plant(address(app)["plant"]).theta == 5


def test_another_design_brings_its_own_number():
    app = run_page("tuning", "Figures", plant=PLANT, tau_c="3")
    app.text_input(key="tau_c_exact").set_value("abc").run()
    unfold(app, "literature").button(key="preset_tight").click().run()
    assert not app.error
    assert float(app.text_input(key="tau_c_exact").value) == 3 + 4 / 2  # theta of the half rule


@given(st.floats(allow_nan=False, allow_infinity=False).filter(lambda x: not x or 1e-300 < abs(x) < 1e300))
def test_a_number_shown_reads_back_as_the_very_number(value):
    assert read_number("x", number_text(value)) == value


@given(st.fractions(min_value=-1000, max_value=1000, max_denominator=1000))
def test_fractions_are_read_exactly(value):
    assert read_number("x", f"{value.numerator}/{value.denominator}") == value.numerator / value.denominator


@pytest.mark.parametrize(
    ("num", "den", "plant"),
    [
        ("0,5; 1", "2,5; 1; 0", "(0.5 s + 1)/(s (2.5 s + 1))"),
        ("−2 1", "1/3 1", "(-2 s + 1)/(0.3333333333333333 s + 1)"),
        ("num = [1 0.5]", "conv([1 2],[3 4])", "0.0625 (2 s + 1)/((0.5 s + 1) (0.75 s + 1))"),
    ],
)
def test_polynomials_read_numbers_as_every_field(num, den, plant):
    app = opened("plant", "", "views", "Polynomials")
    for part, text in (("num", num), ("den", den), ("theta", "0")):
        app.text_input(f"plant_polynomials_{part}").set_value(text).run()
    assert not app.error
    s = 0.3 + 0.7j
    assert parse_plant(address(app)["plant"]).response(s) == pytest.approx(parse_plant(plant).response(s))


def test_polynomials_that_can_be_read_in_two_ways_are_refused():
    app = opened("plant", "", "views", "Polynomials")
    before = address(app)["plant"]
    app.text_input("plant_polynomials_num").set_value("1, 2,5, 3").run()
    assert "two ways" in app.error[0].value
    assert address(app)["plant"] == before


def test_what_was_read_stands_in_words_beside_the_text():
    app = opened("plant", "", "views", "Text")
    app.text_input("plant_text_text").set_value("2,2 exp(-20s)/(180s+1)").run()
    assert "Read: gain 2.2, lag 180, dead time 20." in texts(app)
    app.text_input("plant_text_text").set_value("\\frob{2}/(s+1)").run()
    assert "\\frob" in app.error[0].value
    assert "the previous plant is used: gain 2.2, lag 180, dead time 20." in texts(app)
    assert "gain 2.2, lag 180, dead time 20" in texts(app)


def test_parameters_one_by_one_make_the_plant():
    app = opened("plant", "", "views", "k, θ, τ")
    assert [app.text_input(f"plant_parameters_{part}").value for part in ("k", "theta", "tau1", "tau2")] == [
        *("2", "3"),
        *("20", "4"),
    ]
    app.text_input("plant_parameters_k").set_value("11/5").run()
    app.segmented_control("plant_parameters_kind").set_value("First order").run()
    assert address(app)["plant"] == "2.2 exp(-3 s)/(20 s + 1)"
    app.segmented_control("plant_parameters_kind").set_value("Integrating").run()
    assert "Still to fill in: Gain k′" in texts(app)
    assert address(app)["plant"] == "2.2 exp(-3 s)/(20 s + 1)"  # nothing is reinterpreted
    app.text_input("plant_parameters_slope").set_value("0,05").run()
    plant = parse_plant(address(app)["plant"])
    assert (plant.k, plant.theta, plant.integrators) == (0.05, 3.0, 1)


def test_parameters_of_a_plant_that_is_no_such_model_begin_empty():
    app = run_page("plant", plant="(1-2s)/((10s+1)(6s+1)(s+1))")
    app.segmented_control("plant_way").set_value("k, θ, τ").run()
    assert app.text_input("plant_parameters_k").value == ""
    assert "Still to fill in: Gain k, Time constant τ₁" in texts(app)
    app.text_input("plant_parameters_k").set_value("-3").run()
    app.text_input("plant_parameters_tau1").set_value("7,5").run()
    assert address(app)["plant"] == "-3/(7.5 s + 1)"


@pytest.mark.parametrize(
    ("page", "view", "tabs", "way", "parameters"),
    [
        ("tuning", "Figures", "views", "", {}),
        ("tuning", "Model error", "views", "", {}),
        ("tuning", "Figures", "views", "", {"tau_c": "0.5", "order": "2"}),  # with advice, which is buttons
        ("tuning", "As built", "views", "", {}),
        ("tuning", "Figures", "views", "", {"plant": "1/(s^2+1)"}),
        ("half_rule", "", "views", "", {}),
        ("cascade", "Windup", "cascade_views", "", {"tau_c_inner": "2", "Ms_outer": "1.7"}),
        ("cascade", "Figures", "cascade_views", "", {"method": "synthesis", "tau_c_inner": "2"}),
        ("plant", "", "views", "k, θ, τ", {}),
        ("plant", "", "views", "Step test", {"unit": "min", "OP_unit": "*%*", "PV_unit": "°C"}),
        ("plant", "", "views", "Factors", {}),
    ],
)
def test_names_of_widgets_are_words_and_not_formulas(page, view, tabs, way, parameters):
    """Screen readers read the name of a field, and the options of a choice, as they are written."""
    app = unfold(run_page(page, view, tabs, **parameters), "sheet", *FOLDED.get(page, ()))
    if way:
        app.segmented_control("plant_way").set_value(way).run()
    kinds = ("text_input", "button", "segmented_control", "select_slider", "slider", "checkbox", "selectbox")
    widgets = [widget for kind in kinds for widget in app.get(kind)]
    assert widgets
    options = [option for widget in widgets for option in getattr(widget, "options", [])]
    assert not [name for name in (*(widget.label for widget in widgets), *map(str, options)) if "$" in name]
