"""Lists as people keep them."""

import pytest

from simc_core import read_list, tune_chunk, tune_many
from simc_core.errors import InvalidParameter
from simc_core.many.read_list import EXAMPLES, template
from tests.identification.test_reading_workbook import workbook


def rows(text: str, coding: str = "utf-8") -> list[dict]:
    return read_list(text.encode(coding)).rows


def test_the_template_reads_and_tunes():
    found = read_list(template().encode())
    assert [row["tag"] for row in found.rows] == [example["tag"] for example in EXAMPLES]
    assert found.rows[0] == {"row": 3, "time_unit": "s"} | EXAMPLES[0]
    assert not any(result.refusal for result in tune_chunk(found.rows))


@pytest.mark.parametrize("coding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
@pytest.mark.parametrize(
    "text",
    [
        "tag,k,theta,tau1\nKühler,1.5,2,8\n",
        "Tag;K;Dead time;Tau_1\r\nKühler;1,5;2;8\r\n",
        "sep=;\ntag;k;theta;tau1\nKühler;1,5;2;8\n",
        "tag\tk\ttheta\ttau1\nKühler\t1,5\t2\t8\n",
        "Loops of plant 3,,,\n,,,\nTAG,k,Deadtime,tau\nKühler,1.5,2,8\n",
        'tag;note;k;theta;tau1\n"Kühler";"a;b\n";"1,5";2;8\n',
    ],
)
def test_separators_codings_headings(text, coding):
    (row,) = rows(text, coding)
    assert {name: row[name] for name in ("tag", "k", "theta", "tau1")} == {
        "tag": "Kühler",
        "k": "1.5",
        "theta": "2",
        "tau1": "8",
    }


def test_commas_are_settled_for_the_whole_file():
    """1,234 alone can be read in two ways; beside 0,5 it cannot, and beside 0.5 it stays for the row to refuse."""
    assert [row["theta"] for row in rows("tag;k;theta;tau1\nA;0,5;1,234;8\n")] == ["1.234"]
    assert [row["theta"] for row in rows("tag;k;theta;tau1\nA;0.5;1,234;8\n")] == ["1,234"]
    assert "two ways" in tune_chunk(rows("tag;k;theta;tau1\nA;0.5;1,234;8\n"))[0].refusal


def test_transfer_functions_keep_their_commas():
    (row,) = rows("tag;plant;Kc\nA;exp(-0,5s)/(8s+1);0,5\n")
    assert row["plant"] == "exp(-0,5s)/(8s+1)"


@pytest.mark.parametrize(
    "text",
    [
        "tag,k,theta [min],tau1 [min]\nA,1,2,8\n",
        "tag,k,theta (min),tau1\nA,1,2,8\n",
        "tag,k,theta,tau1\n,%/%,min,min\nA,1,2,8\n",
        "tag,k,theta,tau1\n-,,[Min],[min]\nA,1,2,8\n",
    ],
)
def test_units_beside_and_below_headings(text):
    assert [(row["tag"], row["time_unit"]) for row in rows(text)] == [("A", "min")]


def test_a_rows_own_unit_may_not_differ_from_the_heading():
    both = "tag,k,theta [min],tau1,time_unit\nA,1,2,8,min\nB,1,2,8,s\n"
    agreed, torn = tune_many(rows(both))
    assert not agreed.refusal
    assert "time_unit must be one of s, min, found 's (heading: min)'" in torn.refusal


def test_rows_have_their_number_in_the_file_and_empty_ones_are_left_out():
    assert [row["row"] for row in rows("tag,k,theta,tau1\nA,1,2,8\n,,,\nB,1,2,8\n")] == [2, 4]


def test_headings_that_may_mean_two_things_are_not_taken():
    found = read_list(b"tag,k,theta,tau1,gain,reset,unit\nA,1,2,8,5,6,bar\n")
    assert [name for name, taken in found.columns.items() if not taken] == ["gain", "reset", "unit"]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "nothing in it"),
        (b"tag,comment\nA,b\n", "found the headings tag, comment"),
        (b"tag,k,theta,tau1\n", "a row below its headings"),
        (b"tag,k,theta [s],tau1 [min]\nA,1,2,8\n", "all in min, found theta in s, tau1 in min"),
        (b"tag,k,theta [h],tau1\nA,1,2,8\n", "found theta in h"),
        (b"k" + b",k" * 300, "at most 200 columns"),
    ],
)
def test_files_that_are_refused(content, words):
    with pytest.raises(InvalidParameter, match=words.replace("(", r"\(")):
        read_list(content)


def test_too_many_rows():
    with pytest.raises(InvalidParameter, match="at most 2 rows here, found 3"):
        read_list(b"k,theta,tau1\n1,1,1\n1,1,1\n1,1,1\n", most=2)


def test_a_spreadsheet():
    cells = [["tag", "k", "theta", "tau1"], ["A", 1.5, 2, 8.0]]
    assert read_list(workbook(cells)).rows == [{"row": 2, "tag": "A", "k": "1.5", "theta": "2", "tau1": "8"}]
