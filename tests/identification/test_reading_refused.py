"""What is no trend is refused in words."""

import pytest

from simc_core import DataError, read_trend
from simc_core.identification.reading.decode import MOST_BYTES


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
