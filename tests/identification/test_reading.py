"""Files as people have them. What a file holds is told by hand beside it, never by the reader itself."""

import io
import zipfile
from datetime import datetime, timedelta

import numpy as np
import pytest

from simc_core import DataError, read_trend
from simc_core.identification.reading.decode import MOST_BYTES
from simc_core.identification.reading.meaning import understand
from simc_core.identification.reading.reader import load

TIMES = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]
PV = [20.5, 20.25, 20.5, 20.5, 21.75, 22.5, 23.25, 23.5]
OP = [30.0, 30.0, 42.5, 42.5, 42.5, 42.5, 42.5, 42.5]
SP = [20.0] * 4 + [25.0] * 4


def rows(times=TIMES, separator="\t", decimal=".", series=(PV, OP)):
    def text(value) -> str:
        return value if isinstance(value, str) else str(value).replace(".", decimal)

    return "\n".join(separator.join([text(t), *(text(each[i]) for each in series)]) for i, t in enumerate(times)) + "\n"


def check(trend, times=TIMES, pv=PV, op=OP):
    """The very numbers of the file."""
    assert trend.t.tolist() == pytest.approx(times, abs=1e-6)
    assert trend.y.tolist() == pv
    held = trend.u[np.maximum(np.searchsorted(trend.instants_of_u, trend.t, "right") - 1, 0)]
    assert held.tolist() == op


@pytest.mark.parametrize("decimal", [".", ","])
@pytest.mark.parametrize("separator", ["\t", ";", "|", " "])
def test_separators_and_decimal_signs(separator, decimal):
    check(read_trend(rows(separator=separator, decimal=decimal)))


def test_commas_between_columns():
    check(read_trend("t,PV,OP\n" + rows(separator=",")))


def test_a_decimal_comma_in_quotes_between_commas():
    check(
        read_trend(
            "t,PV,OP\n" + "".join(f'{t},"{y}","{u}"\n'.replace(".", ",") for t, y, u in zip(TIMES, PV, OP, strict=True))
        )
    )


def test_comma_for_columns_and_decimals_is_refused_with_the_way_out():
    with pytest.raises(DataError, match=r"line 1: 3 names stand above 6 columns.*semicolons"):
        read_trend("t,PV,OP\n" + rows([f"{t:.1f}".replace(".", ",") for t in TIMES], ",", ","))


@pytest.mark.parametrize(
    ("encoding", "title"),
    [
        ("utf-8-sig", "UTF-8"),
        ("utf-16", "UTF-16"),
        ("utf-16-le", "UTF-16"),
        ("utf-16-be", "UTF-16"),
        ("cp1252", "1252"),
    ],
)
def test_encodings_and_their_marks(encoding, title):
    trend = read_trend(("Zeit;PV [°C];OP [%]\n" + rows(separator=";", decimal=",")).encode(encoding))
    check(trend)
    assert trend.units["y"] == "°C"
    assert title in trend.notes[0]


def test_a_title_two_rows_of_names_and_one_of_units():
    head = "Export of unit 12\n\nTime\tTIC12\tTIC12\n\tPV\tOP\nmin\t°C\t%\n"
    trend = read_trend(head + rows())
    check(trend)
    assert (trend.names["y"], trend.units) == ("TIC12 PV", {"t": "min", "y": "°C", "u": "%"})


def test_a_file_of_excel_that_names_its_delimiter():
    check(read_trend("sep=;\r\nt;PV;OP\r\n" + rows(separator=";", decimal=",").replace("\n", "\r\n")))


def test_no_names_at_all():
    check(read_trend(rows()))


def test_columns_in_another_order_and_an_index():
    text = "no\tOP\tSP\tPV\tTime (s)\n" + "\n".join(
        f"{i}\t{u}\t{r}\t{y}\t{t}" for i, (t, y, u, r) in enumerate(zip(TIMES, PV, OP, SP, strict=True))
    )
    trend = read_trend(text)
    check(trend)
    assert trend.r.tolist() == SP


BEGIN = datetime(2024, 3, 14, 9, 59, 57)
SHAPES = {
    "ISO": "%Y-%m-%dT%H:%M:%SZ",
    "ISO with fractions": "%Y-%m-%d %H:%M:%S.%f",
    "points": "%d.%m.%Y %H:%M:%S",
    "month first": "%m/%d/%Y %I:%M:%S %p",
    "named month": "%d-%b-%y %H:%M:%S",
    "slashes, year first": "%Y/%m/%d %H:%M:%S",
    "clock alone": "%H:%M:%S",
}


@pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES.keys())
def test_dates(shape):
    instants = [(BEGIN + timedelta(seconds=t)).strftime(shape) for t in TIMES]
    check(read_trend(rows(instants)))


def test_the_first_twelve_days_of_a_month_are_asked_about():
    instants = [f"03/04/2024 10:00:0{int(t)}" for t in TIMES]
    (question,) = understand(load(rows(instants))).questions
    assert question.name == "day_first"
    slow = [f"0{3 + i // 2}/04/2024 {12 * (i % 2):02d}:00:00" for i in range(8)]
    trend = read_trend(rows(slow), day_first=True)
    assert trend.span == 3.5 * 86400
    assert (
        read_trend(rows(slow), day_first=False).span
        == (datetime(2024, 6, 4, 12) - datetime(2024, 3, 4)).total_seconds()
    )


def test_points_between_day_and_month_mean_the_day_first():
    instants = [f"0{3 + i // 4}.04.2024 {6 * (i % 4):02d}:00:00" for i in range(8)]
    assert read_trend(rows(instants)).span == 1.75 * 86400


def test_clock_times_over_midnight():
    instants = [(datetime(2024, 1, 1, 23, 59, 56) + timedelta(seconds=t)).strftime("%H:%M:%S") for t in TIMES]
    trend = read_trend(rows(instants))
    assert np.diff(trend.t).tolist() == [1.0] * 7


def test_date_and_clock_in_two_columns():
    instants = [(BEGIN + timedelta(seconds=t)).strftime("%d.%m.%Y\t%H:%M:%S") for t in TIMES]
    check(read_trend("Datum\tZeit\tPV\tOP\n" + rows(instants)))


@pytest.mark.parametrize(("unit", "scale"), [("s", 1), ("ms", 1e3), ("us", 1e6), ("ns", 1e9)])
def test_epochs(unit, scale):
    instants = [str(int((1710410397 + t) * scale)) for t in TIMES]
    check(read_trend(rows(instants)))


def test_an_epoch_with_microseconds_in_a_column_of_their_own():
    instants = [f"{1382907437 + i // 2} {323492 + 500000 * (i % 2)}" for i in range(8)]
    assert np.diff(read_trend(rows(instants, " ")).t).tolist() == pytest.approx([0.5] * 7)


def test_days_of_a_spreadsheet():
    instants = [45365 + (36000 + 60 * t) / 86400 for t in TIMES]
    check(read_trend(rows(instants)), [60 * t for t in TIMES])


@pytest.mark.parametrize(
    ("title", "unit", "factor"), [("Time (ms)", "s", 1e-3), ("t [min]", "min", 1), ("Zeit in h", "h", 1)]
)
def test_units_of_plain_times(title, unit, factor):
    trend = read_trend(f"{title}\tPV\tOP\n" + rows())
    assert trend.units["t"] == unit
    assert trend.span == pytest.approx(7 * factor)


def test_the_unit_of_time_can_be_told():
    assert read_trend(rows(), time_unit="ms").span == pytest.approx(0.007)


def test_time_that_does_not_begin_at_zero():
    check(read_trend(rows([t + 1e6 for t in TIMES])))


def test_no_time_at_all():
    text = "PV;OP\n" + "\n".join(f"{y};{u}" for y, u in zip(PV, OP, strict=True))
    with pytest.raises(DataError, match="period"):
        read_trend(text)
    check(read_trend(text, period=1.0))


@pytest.mark.parametrize("word", ["Bad", "#N/A", "No Data", "I/O Timeout", "NaN", "", "---", "inf"])
def test_bad_values_are_left_out_and_told(word):
    spoiled = [*PV[:3], word, *PV[4:]]
    trend = read_trend("t;PV;OP\n" + rows(separator=";", series=(spoiled, OP)))
    assert trend.y.tolist() == PV[:3] + PV[4:]
    assert trend.u[np.searchsorted(trend.instants_of_u, 4.0)] == 42.5
    assert not word or any("line 5" in note and word in note for note in trend.notes)


def test_a_column_of_quality():
    quality = ["Good"] * 3 + ["Bad"] + ["Good"] * 4
    trend = read_trend("t;PV;Status;OP\n" + rows(separator=";", series=(PV, quality, OP)))
    assert trend.y.tolist() == PV[:3] + PV[4:]


def test_states_of_a_switch():
    states = ["Off", "Off"] + ["On"] * 6
    assert read_trend("t;PV;OP\n" + rows(separator=";", series=(PV, states))).u.tolist() == [0.0, 0.0] + [1.0] * 6


def test_thousands_and_units_behind_numbers():
    text = "t;PV;OP\n" + "".join(f'{t};"1,2{y:05.2f}";{u} %\n' for t, y, u in zip(TIMES, PV, OP, strict=True))
    assert read_trend(text).y.tolist() == [1200 + y for y in PV]


def test_three_digits_after_every_comma_are_asked_about():
    table = load("t;PV;OP\n0;1,234;5\n1;1,235;5\n2;1,236;6\n3;1,250;6\n")
    assert [question.name for question in table.questions] == ["decimal"]
    assert read_trend("t;PV;OP\n0;1,234;5\n1;1,235;5\n2;1,236;6\n", decimal=".").y.tolist() == [1234.0, 1235.0, 1236.0]


def test_the_newest_first():
    check(read_trend("t\tPV\tOP\n" + rows(TIMES[::-1], series=(PV[::-1], OP[::-1]))))


def test_equal_instants_keep_the_last_but_a_step_of_op_stays():
    trend = read_trend("t;PV;OP\n0;1;0\n0;1;50\n1;1;50\n1;3;50\n2;4;50\n3;5;50\n")
    assert trend.t.tolist() == [0, 0, 1, 2, 3]
    assert trend.u.tolist() == [0, 50, 50, 50, 50]
    assert trend.y.tolist() == [1, 1, 3, 4, 5]


def test_a_clock_that_is_put_back_by_an_hour():
    instants = [
        (datetime(2024, 10, 27, 2, 40) + timedelta(minutes=10 * i)).strftime("%Y-%m-%d %H:%M") for i in range(3)
    ]
    instants += [
        (datetime(2024, 10, 27, 2, 10) + timedelta(minutes=10 * i)).strftime("%Y-%m-%d %H:%M") for i in range(5)
    ]
    trend = read_trend(rows(instants))
    assert np.diff(trend.t).tolist() == [600.0] * 7
    assert any("put back by an hour" in note for note in trend.notes)


def test_samples_out_of_order_are_sorted():
    order = [0, 1, 3, 2, 4, 5, 7, 6]
    trend = read_trend(
        "t\tPV\tOP\n" + rows([TIMES[i] for i in order], series=([PV[i] for i in order], [OP[i] for i in order]))
    )
    check(trend)
    assert any("backwards 2 times" in note for note in trend.notes)


def test_time_that_begins_anew():
    trend = read_trend("t\tPV\tOP\n" + rows(TIMES[:4], series=(PV, OP)) + rows())
    check(trend)
    assert any("2 records" in note for note in trend.notes)


def test_a_first_sample_of_a_sensor_that_wakes_up():
    y = [3.75, *(27.25 + 0.25 * (i // 4) for i in range(30))]
    trend = read_trend("t;PV;OP\n" + "".join(f"{i};{value};{5 if i > 8 else 0}\n" for i, value in enumerate(y)))
    assert trend.y[0] == 27.25
    assert any("3.75" in note for note in trend.notes)


def test_one_row_for_each_value_of_a_tag():
    text = "Tag;Timestamp;Value\n"
    for i, t in enumerate(TIMES):
        text += f"FIC1.PV;2024-03-14 10:00:0{int(t)};{PV[i]}\n"
        if i in (0, 2):
            text += f"FIC1.OP;2024-03-14 10:00:0{int(t)}.5;{OP[i]}\n"
    trend = read_trend(text)
    assert trend.y.tolist() == PV
    assert trend.u.tolist() == [30.0, 42.5]
    assert trend.t_u[1] - trend.t[0] == pytest.approx(2.5)


def test_a_wide_export_with_empty_cells():
    op = [30.0, "", 42.5, "", "", "", "", ""]
    trend = read_trend("t;PV;OP\n" + rows(separator=";", series=(PV, op)))
    assert trend.u.tolist() == [30.0, 42.5]
    assert trend.t_u.tolist() == [0.0, 2.0]


def test_a_column_of_time_for_each_signal():
    text = "time 1;PV;time 2;OP\n" + "".join(f"{t};{PV[i]};{t + 0.5};{OP[i]}\n" for i, t in enumerate(TIMES))
    trend = read_trend(text)
    assert trend.t_u.tolist() == [t + 0.5 for t in TIMES]


def test_one_name_twice_and_more_names_than_columns():
    trend = read_trend("t,PV,PV,OP,more,names\n" + rows(separator=",", series=(PV, PV, OP)))
    check(trend)


def test_exponents():
    check(
        read_trend(
            "t;PV;OP\n" + "".join(f"{t:e};{1e3 * y:.3f}E-3;{u:e}\n" for t, y, u in zip(TIMES, PV, OP, strict=True))
        )
    )


def test_names_on_the_wrong_columns_are_asked_about():
    """The header says input, set point, output; the columns are set point, OP, PV."""
    t = np.arange(0, 90, 0.25)
    r = np.where(t < 2, 0.0, np.where(t < 45, 260.0, 230.0))
    y = r + 4 * np.sin(3 * t)
    u = 130 + 0.5 * (r - 260) + np.round(20 * np.cos(0.7 * t)) / 4
    text = "Tiempo (s),Input (rpm),Setpoint (rpm),Output (PWM)\n"
    text += "".join(f"{a},{b},{c},{d:.3f}\n" for a, b, c, d in zip(t, r, u, y, strict=True))
    reading = understand(load(text))
    assert (reading.roles["SP"], reading.roles["OP"], reading.roles["PV"]) == ("Input", "Setpoint", "Output")
    assert any("do not fit" in question.text for question in reading.questions)
    assert dict(reading.trend.units) == {"t": "s"}  # rpm and PWM stand above the wrong columns as well
    assert any("Units are left open" in said for said in reading.understood)


def test_two_outputs_that_move_together_are_asked_about():
    text = "t;PWM;Voltaje (V);Velocidad (rad/s)\n"
    text += "".join(f"{t};{85 * (t > 2)};{3 * (t > 2)};{y}\n" for t, y in zip(TIMES, PV, strict=True))
    reading = understand(load(text))
    assert reading.roles["OP"] == "Voltaje"
    (question,) = (each for each in reading.questions if each.name == "OP")
    assert set(question.choices) == {"PWM", "Voltaje"}
    assert read_trend(text, columns={"OP": "PWM"}).u.max() == 85


def test_a_file_without_op_is_refused_in_words():
    text = "timestamp_ms,setpoint_rpm,actual_rpm\n" + "".join(f"{10 * i},100,{y}\n" for i, y in enumerate(PV))
    with pytest.raises(DataError, match="controller output"):
        read_trend(text)


@pytest.mark.parametrize(
    ("source", "match"),
    [
        (b"", "empty"),
        ("\n\n", "empty"),
        (b"%PDF-1.7 ...", "PDF"),
        (b"1;2\n\x00\x00\x00\x00" * 10, "not text"),
        ("hello\nworld\n", "no columns"),
        ("a;b\nc;d\ne;f\n", "no columns|no row of numbers"),
        (b"PK\x03\x04 damaged", "damaged|cannot be opened"),
        ("no such file", "no file"),
    ],
)
def test_what_is_no_trend_is_refused_in_words(source, match):
    with pytest.raises(DataError, match=match):
        read_trend(source)


def test_bounds_of_a_file():
    with pytest.raises(DataError, match="at most 20 MB"):
        read_trend(b"1;2\n" * (MOST_BYTES // 4 + 1))
    with pytest.raises(DataError, match=r"64 columns|no columns"):
        read_trend("\n".join(";".join(map(str, range(70))) for _ in range(5)))
    with pytest.raises(DataError, match="line 3: a line may have"):
        read_trend("t;PV\n1;2\n" + "3" * 30_000 + ";4\n5;6\n")


def test_a_quote_that_is_never_closed_is_told():
    with pytest.raises(DataError, match="quote"):
        read_trend('t;PV;OP\n0;1;2\n1;"1;2\n' + "".join(f"{i};1;3\n" for i in range(2, 40_000)))


def test_an_epoch_beyond_all_dates_is_no_traceback():
    rows = "".join(f"{i};1;3\n" for i in range(1382907437, 1382907637))
    with pytest.raises(DataError, match=r"must hold numbers within"):
        read_trend("1382907437323492;27;62\n" + rows)


def workbook(cells, sheet="Trend") -> bytes:
    """A minimal xlsx, written by hand after ECMA-376."""
    main = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
    relations = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
    package = "http://schemas.openxmlformats.org/package/2006"

    def cell(value) -> str:
        if isinstance(value, str):
            return f'<c t="inlineStr"><is><t>{value}</t></is></c>'
        return f"<c><v>{value!r}</v></c>"

    body = "".join(f"<row>{''.join(map(cell, row))}</row>" for row in cells)
    parts = {
        "[Content_Types].xml": f'<Types xmlns="{package}/content-types">'
        '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
        '<Override PartName="/xl/workbook.xml" '
        'ContentType="application/vnd.openxmlformats-officedocument.spreadsheetml.sheet.main+xml"/>'
        '<Override PartName="/xl/worksheets/sheet1.xml" '
        'ContentType="application/vnd.openxmlformats-officedocument.spreadsheetml.worksheet+xml"/></Types>',
        "_rels/.rels": f'<Relationships xmlns="{package}/relationships"><Relationship Id="r1" '
        f'Type="{relations}/officeDocument" Target="xl/workbook.xml"/></Relationships>',
        "xl/workbook.xml": f'<workbook xmlns="{main}" xmlns:r="{relations}"><sheets>'
        f'<sheet name="{sheet}" sheetId="1" r:id="r1"/></sheets></workbook>',
        "xl/_rels/workbook.xml.rels": f'<Relationships xmlns="{package}/relationships"><Relationship Id="r1" '
        f'Type="{relations}/worksheet" Target="worksheets/sheet1.xml"/></Relationships>',
        "xl/worksheets/sheet1.xml": f'<worksheet xmlns="{main}"><sheetData>{body}</sheetData></worksheet>',
    }
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as written:
        for name, text in parts.items():
            written.writestr(name, '<?xml version="1.0" encoding="UTF-8"?>' + text)
    return file.getvalue()


def test_a_spreadsheet_file():
    cells = [["Zeit [s]", "PV [°C]", "OP [%]"], *([t, y, u] for t, y, u in zip(TIMES, PV, OP, strict=True))]
    trend = read_trend(workbook(cells))
    check(trend)
    assert trend.units == {"t": "s", "y": "°C", "u": "%"}


def test_a_sheet_that_does_not_exist_is_named():
    with pytest.raises(DataError, match="sheet must be one of Trend"):
        read_trend(workbook([["t", "PV", "OP"], [0, 1, 2]]), sheet="Other")


def test_a_spreadsheet_that_unpacks_to_too_much_is_not_unpacked(monkeypatch):
    monkeypatch.setattr("simc_core.identification.reading.workbook.MOST_UNPACKED", 2_000_000)
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as written:
        written.writestr("xl/worksheets/sheet1.xml", b"\0" * 3_000_000)
    with pytest.raises(DataError, match="may unpack to 2 MB"):
        read_trend(file.getvalue())


def test_a_path_reads_as_its_bytes(tmp_path):
    path = tmp_path / "trend.csv"
    path.write_text("t;PV;OP\n" + rows(separator=";"))
    check(read_trend(path))
    check(read_trend(str(path)))


def test_a_day_at_one_second_arrives_whole():
    n = 86_400
    text = "t;PV;OP\n" + "".join(f"{i};{i % 977}.5;{30 + (i > n // 2)}\n" for i in range(n))
    trend = read_trend(text)
    assert trend.t.size == n
    assert float(trend.y.sum()) == sum(i % 977 for i in range(n)) + 0.5 * n
    assert int(np.argmax(trend.u > 30)) == n // 2 + 1


@pytest.mark.parametrize(
    ("at", "said"), [(12.0, "moves exactly as OP does"), (13.0, "moved at once with OP"), (45.0, "changes too")]
)
def test_another_input_that_was_moved_is_told(at, said):
    """A feed is moved with OP, a little later, or long after: PV may answer it."""
    t = np.arange(0.0, 80.0, 0.5)
    rows = "".join(f"{a};{50 + 0.1 * a:.2f};{40 + 5 * (a >= 12):.0f};{100 + 10 * (a >= at):.0f}\n" for a in t)
    text = "t [s];PV;OP;Feed\n" + rows
    reading = understand(load(text))
    (question,) = (each for each in reading.questions if each.name == "inputs")
    assert said in question.text
    assert "Feed" in question.text
    assert any(said in note for note in read_trend(text).notes)


def test_op_in_a_second_unit_and_numbers_of_phases_are_no_other_input():
    t = np.arange(0.0, 80.0, 0.5)
    rows = "".join(
        f"{a};{50 + 0.1 * a:.2f};{40 + 5 * (a >= 12):.0f};{4 + 0.5 * (a >= 12)};{1 + int(a // 10)};{b:.3f}\n"
        for a, b in zip(t, np.sin(t), strict=True)
    )
    reading = understand(load("t [s];PV;OP;OP mA;Phase;Noise\n" + rows))
    assert not [each for each in reading.questions if each.name == "inputs"]
