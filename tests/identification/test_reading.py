"""Files as people have them: columns, decimal signs, encodings and names."""

import numpy as np
import pytest

from simc_core import DataError, read_trend
from tests.identification.texts import OP, PV, SP, TIMES, check, rows


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


def test_one_name_twice_and_more_names_than_columns():
    trend = read_trend("t,PV,PV,OP,more,names\n" + rows(separator=",", series=(PV, PV, OP)))
    check(trend)


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
