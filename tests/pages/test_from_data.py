"""The page From data: from a record to a model, to its tuning; what cannot be read or fitted is told in words."""

import re
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from streamlit.runtime.memory_uploaded_file_manager import MemoryUploadedFileManager

from pages.common.from_data.examples import EXAMPLES
from pages.common.from_data.work import work_on, work_on_example
from pages.common.session import links
from pages.common.session.design import Design
from pages.common.session.record import Chosen, Origin
from pages.common.session.time_unit import in_time_unit
from simc_core import DataError, FirstOrderDelay, InvalidParameter, Loop, Plant, half_rule, margins, simc
from simc_core.identification.rank import USUAL
from tests.identification.test_known_controller import logged
from tests.pages.tools import address, run_page, texts

TRUTH = {  # what the examples were made with; the page says so to nobody
    "step": {"k": 1.5, "theta": 12.0, "tau1": 60.0},
    "noisy": {"k": 0.8, "theta": 20.0, "tau1": 45.0},
    "integrating": {"k_prime": 0.002, "theta": 16.0},
    "closed_loop": {"k": 1.5, "theta": 10.0, "tau1": 40.0},
    "relay": {"k": 1.2, "theta": 15.0, "tau1": 80.0},
}


def html(app) -> str:
    return " ".join(str(block.proto.body) for block in app.get("html"))


def test_without_a_record_the_page_says_what_to_do():
    app = run_page("from_data")
    assert "choose an example" in app.info[0].value
    assert not app.error


@pytest.mark.parametrize("key", TRUTH)
def test_the_process_of_an_example_is_within_the_intervals(key):
    work = work_on_example(key)
    chosen = Chosen()
    best = work.fitted(work.part(chosen)[0], chosen, USUAL).found[0]
    for name, value in TRUTH[key].items():
        low, high = best.intervals[name]
        room = 0.5 * (high - low)  # 95 % intervals of a dozen numbers: one or the other may just miss
        assert low - room <= value <= high + room, (name, best.intervals[name])


def test_a_link_opens_its_example_with_the_model():
    app = run_page("from_data", example="step")
    shown = html(app)
    assert 'aria-label="Parameters of the model' in shown
    assert re.search(r"<small>k</small><b>1\.5\d*</b> <i>°C/%</i>", shown)
    assert app.get("plotly_chart")[0].proto.alt.startswith("Record of PV, OP over 699 s")


def test_a_link_to_no_example_is_told():
    app = run_page("from_data", example="nothing")
    assert "example must be one of" in app.error[0].value
    assert "example" not in address(app)


def test_the_model_goes_to_the_tuning_with_its_units_and_origin():
    app = run_page("from_data", example="step")
    app.button(key="tune").click().run()
    assert not app.exception
    given = address(app)
    design, ignored = links.decode(given)
    assert not ignored
    assert design.plant.k == pytest.approx(1.5, rel=0.01)
    assert design.plant.theta == pytest.approx(12, abs=0.4)
    assert (design.sheet.time_unit, design.sheet.PV_unit, design.sheet.OP_unit) == ("s", "°C", "%")
    assert design.origin.structure == "FOPDT"
    assert design.origin.source == EXAMPLES["step"].title
    assert design.origin.samples == 700
    assert design.record.example == "step"


def test_another_structure_is_chosen_and_stays_in_the_address():
    app = run_page("from_data", example="step")
    app.segmented_control(key="structure").set_value("SOPDT").run()
    assert not app.exception
    assert address(app)["structure"] == "SOPDT"
    assert "τ₂" in html(app)


def test_a_part_is_fitted_and_both_ways_to_choose_it_agree():
    app = run_page("from_data", example="step")
    app.text_input(key="part_end").set_value("350").run()
    assert address(app)["end"] == "350"
    assert app.slider(key="part").value == (0.0, 350.0)
    assert "351 samples" in texts(app)
    app.slider(key="part").set_range(30.0, 300.0).run()
    assert float(address(app)["begin"]) == pytest.approx(30, abs=0.5)
    assert app.text_input(key="part_end").value.startswith("300")


def test_a_part_outside_the_record_is_refused_beside_its_field():
    app = run_page("from_data", example="step")
    app.text_input(key="part_end").set_value("9999").run()
    assert "To must be ≤ 699" in app.error[0].value
    assert "end" not in address(app)


def test_a_bad_piece_is_left_out_and_taken_back():
    app = run_page("from_data", example="step")
    app.text_input(key="bad_from").set_value("100").run()
    app.text_input(key="bad_to").set_value("120,5").run()
    app.button(key="leave_out").click().run()
    assert address(app)["bad"] == "100.0~120.5"
    assert "679 samples" in texts(app)  # 100 to 120
    app.button(key="take_back_0").click().run()
    assert "bad" not in address(app)
    assert "700 samples" in texts(app)


def test_half_of_a_bad_piece_is_refused():
    app = run_page("from_data", example="step")
    app.text_input(key="bad_from").set_value("100").run()
    app.button(key="leave_out").click().run()
    assert "both ends are needed" in app.error[0].value


def test_a_paste_is_read_and_its_field_is_empty_again():
    app = run_page("from_data", example="step")
    rows = "t;PV;OP\n" + "".join(
        f"{i};{20 + (i > 12) * 0.1 * min(i - 12, 20)};{5 if i < 10 else 9}\n" for i in range(60)
    )
    app.text_area(key="trend_paste_0").set_value(rows)
    next(button for button in app.button if button.label == "Read").click().run()
    assert not app.exception
    assert "pasted rows" in texts(app)
    assert "example" not in address(app)
    assert app.text_area(key="trend_paste_1").value in ("", None)


def test_a_paste_that_is_no_trend_changes_nothing_and_stays():
    app = run_page("from_data", example="step")
    app.text_area(key="trend_paste_0").set_value("hello <b>world</b>\n")
    next(button for button in app.button if button.label == "Read").click().run()
    assert "nothing changed" in app.error[0].value
    assert app.text_area(key="trend_paste_0").value == "hello <b>world</b>\n"
    assert "Parameters of the model" in html(app)


def test_an_uploaded_file_is_read_and_its_memory_given_back(monkeypatch):
    given_back = []
    forget = MemoryUploadedFileManager.remove_file

    def remove_file(self, session_id, file_id):
        forget(self, session_id, file_id)
        given_back.append(self.get_files(session_id, [file_id]))

    monkeypatch.setattr(MemoryUploadedFileManager, "remove_file", remove_file)
    app = run_page("from_data")
    rows = "Zeit [s];PV;OP\n" + "".join(f"{i};{20 + (i > 30)};{5 + (i > 25)}\n" for i in range(60))
    app.file_uploader(key="trend_file_0").upload("tank.csv", rows.encode("utf-16"), "text/csv").run()
    assert not app.exception
    assert given_back == [[]]
    assert "`tank.csv`" in texts(app)
    assert "60 samples" in texts(app)


def test_roles_can_change_places_and_back():
    app = run_page("from_data", example="step")
    app.selectbox(key="reading_PV").set_value("OP").run()
    assert not app.exception
    assert app.selectbox(key="reading_OP").value == "PV"
    app.selectbox(key="reading_PV").set_value("PV").run()
    assert "700 samples" in texts(app)


def test_op_that_never_moves_gives_no_numbers():
    app = run_page("from_data", example="step")
    rows = "t;PV;OP\n" + "".join(f"{i};{20 + i % 3};5\n" for i in range(60))
    app.text_area(key="trend_paste_0").set_value(rows)
    next(button for button in app.button if button.label == "Read").click().run()
    assert not app.exception
    assert "Parameters of the model" not in html(app)
    assert app.error


def test_names_of_columns_are_never_markup():
    app = run_page("from_data")
    evil = "[x](//host)"
    rows = f"t;{evil};OP<img src=x>\n" + "".join(f"{i};{20 + (i > 30)};{5 + (i > 25)}\n" for i in range(60))
    app.text_area(key="trend_paste_0").set_value(rows)
    next(button for button in app.button if button.label == "Read").click().run()
    assert not app.exception
    for text in (item.value for kind in ("markdown", "caption", "info", "warning", "error") for item in app.get(kind)):
        outside = re.sub(r"`[^`]*`", "", text)
        assert "](" not in outside
        assert "<img" not in outside
    assert "<img" not in html(app)


@pytest.mark.parametrize("unit", ["min", "h", "ms"])
def test_origin_follows_the_plant_into_another_time_unit(unit):
    plant = FirstOrderDelay(2.0, 12.0, 60.0).plant
    origin = Origin(plant, "FOPDT", (0.1, 1.2, 3.0), 0.97, 500, "test.csv")
    design = in_time_unit(
        replace(Design(), plant=plant, origin=origin, sheet=replace(Design().sheet, time_unit="s")), unit
    )
    per = {"min": Fraction(1, 60), "h": Fraction(1, 3600), "ms": Fraction(1000)}[unit]
    assert design.origin.plant == design.plant
    assert design.origin.errors == pytest.approx((0.1, 1.2 * float(per), 3.0 * float(per)))
    back, ignored = links.decode(links.encode(design))
    assert not ignored
    assert back.origin == design.origin


def test_origin_ends_with_its_plant():
    plant = FirstOrderDelay(2.0, 12.0, 60.0).plant
    design = replace(Design(), plant=plant, origin=Origin(plant, "FOPDT", (0.1, 1.2, 3.0), 0.97, 500))
    assert replace(design, plant=Plant(1.0, 1.0, (2.0,))).origin is None


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("origin", "FOPDT~0.9~700~0.1~nan~1~x"),
        ("origin", "FOPDT~0.9"),
        ("origin", "<b>~1"),
        ("bad", "1~2~3"),
        ("bad", "1~x"),
        ("begin", "inf"),
        ("structure", "FOPDT2"),
        ("example", "../../etc"),
    ],
)
def test_what_a_link_says_wrongly_is_ignored_and_told(name, text):
    design, ignored = links.decode({name: text})
    assert design == Design()
    assert [each.name for each in ignored] == [name]


def test_bounds_of_what_is_chosen():
    with pytest.raises(InvalidParameter, match="end must be > begin = 5"):
        Chosen(begin=5, end=5)
    with pytest.raises(DataError, match="empty"):
        work_on("file", b"")


def test_a_slower_tuning_is_offered_for_what_is_not_known():
    """The tau_c that is named keeps Ms of the fitted plant well below the limit: the plants around it need the room."""
    app = run_page("from_data", example="integrating")
    said = next(item.value for item in app.markdown if "probability of 95 %" in item.value)
    tau_c = float(re.search(r"= ([\d.]+) s", said)[1])
    app.button(key="tune_robust").click().run()
    assert not app.exception
    design, ignored = links.decode(address(app))
    assert not ignored
    assert design.tuning.tau_c == pytest.approx(tau_c, rel=0.01)
    assert design.tuning.tau_c > design.plant.theta
    judged = margins(Loop(design.plant, simc(half_rule(design.plant).model, design.tuning.tau_c)))
    assert judged.Ms < 1.7


def experiment(app, title: str, **values: str):
    app.segmented_control(key="experiment").set_value(title).run()
    for name, text in values.items():
        app.text_input(key=name).set_value(text).run()
    assert not app.exception
    return app


def test_the_published_example_of_the_overshoot_experiment():
    """[SS10] E2: Kc 0.919 and tau_I 3.46 from Kc0 1.5, first peak 0.7816 at 4.446, first minimum 0.5443."""
    given = {"Kc0": "1.5", "setpoint": "1", "peak": "0.7816", "lowest": "0,5443", "peak_time": "4.446"}
    app = experiment(
        run_page("from_data"),
        "Set-point overshoot",
        **{f"experiment_overshoot_{name}": text for name, text in given.items()},
    )
    Kc, tau_I = map(float, re.findall(r"\*\*([\d.]+)\*\*", texts(app))[:2])
    assert Kc == pytest.approx(0.919, abs=0.0006)
    assert tau_I == pytest.approx(3.46, abs=0.006)


def test_an_overshoot_that_nobody_has_a_formula_for_is_refused():
    given = {"Kc0": "1.5", "setpoint": "1", "peak": "2", "lowest": "0.1", "peak_time": "4"}
    app = experiment(
        run_page("from_data"),
        "Set-point overshoot",
        **{f"experiment_overshoot_{name}": text for name, text in given.items()},
    )
    assert app.error
    assert "Tune this model" not in [button.label for button in app.button]


def test_a_slow_oscillation_asks_for_more_integral_time():
    """P0 = 40, tau_I = 4: F = (40/4)^2/pi^2 = 10.1, all of it on tau_I."""
    given = {"Kc": "0.5", "tau_I": "4", "period": "40"}
    app = experiment(
        run_page("from_data"),
        "Loop that oscillates",
        **{f"experiment_oscillation_{name}": text for name, text in given.items()},
    )
    assert re.search(r"\*\*40\.5\d*\*\*", texts(app))


def test_a_relay_test_of_the_present_plant():
    """1/((s+1)(10s+1)) e^{-0.3s}: omega_180 1.8402, gain there 0.02591; the relay shows a period of 3.5631."""
    app = experiment(
        run_page("from_data", plant="exp(-0.3s)/((s+1)(10s+1))"), "Relay test", experiment_relay_amplitude="1"
    )
    table = app.dataframe[-1].value
    assert float(table["exact"][0]) == pytest.approx(1 / 0.02591, rel=2e-3)
    assert float(table["exact"][1].split()[0]) == pytest.approx(2 * np.pi / 1.8402, rel=1e-3)
    assert float(table["describing function"][1].split()[0]) == pytest.approx(3.5631, rel=1e-3)


def test_what_is_typed_into_an_experiment_stays():
    app = experiment(run_page("from_data"), "Relay test", experiment_relay_amplitude="-1")
    assert app.error or "Still needed" in texts(app)
    assert app.text_input(key="experiment_relay_amplitude").value == "-1"


def test_every_page_tells_where_an_identified_plant_comes_from():
    plant = FirstOrderDelay(2.0, 12.0, 60.0).plant
    origin = Origin(plant, "FOPDT", (0.1, 1.2, 3.0), 0.97, 500, "a*b*.csv")
    link = links.encode(replace(Design(), plant=plant, origin=origin))
    for page in ("plant", "tuning"):
        told = [item.proto.help for item in run_page(page, **link).caption if item.proto.help]
        assert any("`a*b*.csv`" in text and "fit 97.0 %, 500 samples" in text and "θ 1.2" in text for text in told)


def test_a_part_with_nothing_in_it_leaves_the_figure_and_says_so():
    app = run_page("from_data", example="step", begin="10", end="11")
    assert "at least 3 samples" in app.error[0].value
    assert app.get("plotly_chart")
    app.text_input(key="part_end").set_value("600").run()
    assert not app.error
    assert "591 samples" in texts(app)


def pasted(rows: str):
    app = run_page("from_data")
    app.text_area(key="trend_paste_0").set_value(rows)
    next(button for button in app.button if button.label == "Read").click().run()
    assert not app.exception
    return app


def test_the_decimal_sign_is_asked_for_where_three_digits_follow_every_comma():
    rows = "t;PV;OP\n" + "".join(
        f"{i};1,{200 + 5 * max(0, min(i - 32, 60))};{40 if i < 30 else 45}\n" for i in range(120)
    )
    app = pasted(rows)
    assert any("what is the decimal sign?" in item.value for item in app.caption)
    small = float(re.search(r"<small>k[^<]*</small><b>([\d.]+)", html(app))[1])
    app.selectbox(key="reading_decimal").set_value(".").run()
    assert not app.exception
    large = float(re.search(r"<small>k[^<]*</small><b>([\d.]+)", html(app))[1])
    assert large == pytest.approx(1000 * small, rel=0.01)


def test_rows_without_time_are_asked_how_far_they_are_apart():
    rows = "PV;OP\n" + "".join(f"{20 + 0.1 * max(0, min(i - 32, 60)):.1f};{40 if i < 30 else 45}\n" for i in range(120))
    app = pasted(rows)
    assert "Parameters of the model" not in html(app)
    app.text_input(key="period").set_value("0,5").run()
    assert not app.exception
    assert "every 0.5" in texts(app)
    assert "Parameters of the model" in html(app)


def test_a_unit_of_time_that_is_not_told_can_be_chosen():
    rows = "t;PV;OP\n" + "".join(
        f"{i};{20 + 0.1 * max(0, min(i - 32, 60)):.1f};{40 if i < 30 else 45}\n" for i in range(120)
    )
    app = pasted(rows)
    assert any("unit of time is not told" in item.value for item in app.info)
    app.selectbox(key="reading_time_unit").set_value("min").run()
    assert not app.exception
    app.button(key="tune").click().run()
    assert address(app)["unit"] == "min"


def test_a_link_with_a_rare_structure_opens_it():
    app = run_page("from_data", example="step", structure="inverse")
    assert app.segmented_control(key="structure").value == "inverse"
    assert "<small>T</small>" in html(app)


def test_a_closed_loop_without_op_asks_for_its_controller():
    _, record = logged(0.01)
    rows = "\n".join(f"{t:.1f};{r:.0f};{y:.4f}" for t, r, y in zip(record.t, record.r, record.y, strict=True))
    app = pasted("Time [s];SP;PV\n" + rows + "\n")
    assert app.error[0].value.startswith("No column is the controller output")
    assert "since the set point moved" in app.error[0].value
    assert "controller=" not in app.error[0].value  # what the library calls it; here it is a field
    app.text_input(key="loop_Kc").set_value("0.9").run()
    app.text_input(key="loop_tau_I").set_value("12").run()
    app.button(key="compute_op").click().run()
    assert not app.exception
    assert not app.error
    assert any("OP was computed from PV, SP and the controller" in item.value for item in app.warning)
    assert re.search(r"<small>k</small><b>(1\.9|2\.0)", html(app))


def test_a_closed_loop_at_constant_set_point_without_op_stays_refused():
    _, record = logged(0.01, setpoint=False)
    rows = "\n".join(f"{t:.1f};5;{y:.4f}" for t, y in zip(record.t, record.y, strict=True))
    app = pasted("Time [s];SP;PV\n" + rows + "\n")
    assert any("The set point never moves" in item.value for item in app.error)
    assert not [field for field in app.text_input if field.key.startswith("loop_")]  # nothing is asked for in vain
    assert "Parameters of the model" not in html(app)
