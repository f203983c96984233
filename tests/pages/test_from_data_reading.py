"""Files and pastes on the page From data: what is asked about them, and how it is answered."""

import re

import pytest
from streamlit.runtime.memory_uploaded_file_manager import MemoryUploadedFileManager

from tests.identification.test_known_controller import logged
from tests.pages.from_data import html, pasted
from tests.pages.tools import address, run_page, texts


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
