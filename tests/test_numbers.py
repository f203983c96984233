"""Numbers typed by people: the value meant, or a refusal in words; never another number."""

import math
import re
from decimal import Decimal
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from simc_core.errors import InvalidParameter, SimcError
from simc_core.numbers import read_number, read_numbers

NARROW, FIXED = "\u202f", "\u00a0"


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("0,5", 0.5),
        ("2,75", 2.75),
        ("0,75", 0.75),
        ("0.5", 0.5),
        (",5", 0.5),
        ("5,", 5),
        ("5.", 5),
        ("-3", -3),
        ("−3", -3),
        ("– 3", -3),
        ("+3", 3),
        ("1e-3", 1e-3),
        ("1E−3", 1e-3),
        ("2,5e2", 250),
        ("2·10^-3", 2e-3),
        ("2 · 10^{-3}", 2e-3),
        ("2x10^3", 2000),
        ("2*10**3", 2000),
        ("2×10⁻³", 2e-3),
        ("2 10^3", 2000),
        ("10³", 1000),
        ("-10^(-3)", -1e-3),
        ("11/5", 2.2),
        ("−11/5", -2.2),
        ("11÷5", 2.2),
        ("1,5/2", 0.75),
        ("12 500", 12500),
        (f"12{NARROW}500", 12500),
        (f"1{FIXED}234{FIXED}567,5", 1234567.5),
        ("1 234,5", 1234.5),
        ("1 234.5", 1234.5),
        ("1 234,567", 1234.567),
        ("1,234.5", 1234.5),
        ("1.234,5", 1234.5),
        ("1.000,0", 1000),
        ("12.345,67", 12345.67),
        ("1\u2009000,5", 1000.5),
        ("1’000", 1000),
        ("-,5", -0.5),
        ("1,5·10^-3", 0.0015),
        ("2/-5", -0.4),
        ("1e3/2", 500),
        ("1,234.567", 1234.567),
        ("1.234,567", 1234.567),
        ("1,234,567", 1234567),
        ("1.234.567", 1234567),
        ("1'234", 1234),
        ("1’234’567.5", 1234567.5),
        ("1_000", 1000),
        ("1.234", 1.234),
        ("1.000", 1),
        ("1234,567", 1234.567),
        ("0,123", 0.123),
        ("0,000", 0),
        ("00,5", 0.5),
        ("２，５", 2.5),
        (" \u200b7\ufeff ", 7),
        ("-0", 0),
    ],
)
def test_the_number_meant(text, meant):
    assert read_number("theta", text) == pytest.approx(meant, rel=1e-15, abs=0)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "nothing"),
        ("1,234", "two ways, found '1,234': write 1234 .* 1.234"),
        ("-12,345", "two ways, found '12,345': write 12345 .* 12.345"),
        ("1,000", "two ways"),
        ("1,500e3", "two ways"),
        ("1,234/2", "two ways"),
        ("5 s", "leave out 's' and write 5"),
        ("20s", "leave out 's' and write 20"),
        ("3 min", "leave out 'min' and write 3"),
        ("5 kg/h", "leave out 'kg/h' and write 5"),
        ("120 °C", "leave out '°C'"),
        ("50%", "percent"),
        ("50 %", "percent"),
        ("1 1/2", "one fraction like"),
        ("1 234/5", "one fraction like"),
        ("1/2/3", "one fraction like"),
        ("½", "write 0.5"),
        ("1½", "write 1.5"),
        ("-2 ¾", "write -2.75"),
        ("⅓", "write 0.3333"),
        ("2π", "3.1416 for π"),
        ("pi", "3.1416 for π"),
        ("3k", "write 3e3 if 'k' is a power of ten, 3 if it is a unit"),
        ("10 µ", "write 10e-6 if 'µ'"),
        ("3 min.", "leave out 'min' and write 3"),
        ("2:30", "one number in the time unit"),
        ("1d-3", "without blanks, as in 1e-3"),
        ("1 e-3", "without blanks, as in 1e-3"),
        ("1e 3", "without blanks, as in 1e-3"),
        ("1, 5", "groups of three"),
        ("5/", "one fraction like 11/5"),
        ("/5", "one fraction like 11/5"),
        ("۵", "write the digits 0 to 9"),
        ("٣٫٥", "write the digits 0 to 9"),
        ("5 ‰", "must be one number"),
        ("5±1", "must be one number"),
        ("~5", "must be one number"),
        ("12,34,567", "one decimal point or comma"),
        ("1.2,3", "one decimal point or comma"),
        ("0·5", "work it out"),
        ("2·103", "write 2e3"),
        ("2x10-3", "write 2e-3"),
        ("10-3", "work it out"),
        ("1-2", "work it out"),
        ("2*3", "work it out"),
        ("5^2", "work it out"),
        ("--5", "must be one number"),
        ("1 23", "groups of three"),
        ("12 50", "groups of three"),
        ("0 500", "groups of three"),
        ("1 2 3", "groups of three"),
        ("1 234 56", "groups of three"),
        ("1.234 567", "groups of three"),
        ("1\n234", "groups of three"),
        ("1\t234", "groups of three"),
        ("1,23,456", "one decimal point or comma"),
        ("1,2,3", "one decimal point or comma"),
        ("1.2.3", "one decimal point or comma"),
        ("1,234,567,8", "one decimal point or comma"),
        ("1..5", "one decimal point or comma"),
        ("0,123.4", "one decimal point or comma"),
        ("k = 5", "without a name"),
        ("=5", "without a name"),
        ("inf", "finite"),
        ("-Infinity", "finite"),
        ("∞", "finite"),
        ("nan", "finite"),
        ("1e400", "exponent of at most 300"),
        ("1e-400", "exponent"),
        ("1e-250/1e100", "between"),
        ("1/0", "zero"),
        ("sqrt(2)", "'sqrt' is not known"),
        ("five", "'five' is not known"),
        ("0x10", "must be one number"),
        ("1d3", "must be one number"),
        ("1e3.5", "must be one number"),
        ("1:2", "must be one number"),
        ("(5)", "must be one number"),
        ("10^(-3", "work it out"),
        ("٣", "write the digits 0 to 9"),
        ("9" * 101, "at most 100 characters, found 101"),
        ("__import__('os')", "must be one number"),
    ],
)
def test_what_is_no_number_or_two_is_refused_in_words(text, words):
    with pytest.raises(InvalidParameter, match=f"theta.*{words}"):
        read_number("theta", text)


@pytest.mark.parametrize("value", [None, 5, 0.5, b"5", ["5"]])
def test_only_text_is_read(value):
    for read in (read_number, read_numbers):
        with pytest.raises(InvalidParameter, match="must be text"):
            read("k", value)


@given(
    st.decimals(allow_nan=False, allow_infinity=False, min_value=-(10**9), max_value=10**9, places=4),
    st.sampled_from([" ", NARROW, FIXED, "'", "’", "_"]),
    st.sampled_from(".,"),
    st.sampled_from("-−–"),
)
def test_grouped_numbers_of_every_locale_read_back(value, separator, point, minus):
    grouped = f"{value:,.4f}"
    text = grouped.translate({ord(","): separator, ord("."): point, ord("-"): minus})
    assert read_number("k", text) == float(value)


@given(st.floats(allow_nan=False, allow_infinity=False, min_value=-1e299, max_value=1e299))
def test_every_double_reads_back_as_itself(value):
    if value != 0 and abs(value) < 1e-299:
        return
    for text in (repr(value), repr(value).replace("-", "−"), repr(value).replace("e", "·10^"), f"{value:.17E}"):
        assert read_number("k", text) == value


@given(st.integers(-(10**6), 10**6), st.integers(1, 10**6))
def test_fractions_read_back(top, bottom):
    assert read_number("k", f"{top}/{bottom}") == float(Fraction(top, bottom))


@given(st.text(st.sampled_from("0123456789.,' -−+/eE*x^·10⁻³%s\u202f"), max_size=14))
def test_digits_are_never_dropped(text):
    """Whatever is read holds all digits typed in order; the only ones that may go are those of a power of ten."""
    try:
        value = read_number("k", text)
    except SimcError:
        return
    assert math.isfinite(value)
    if re.search("[eE/^⁻³]", text):
        return
    typed = re.sub(r"\D", "", text).strip("0")
    assert re.sub(r"\D", "", f"{Decimal(repr(value)):f}").strip("0") == typed or len(typed) > 12


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("1 3.5 2", [1, 3.5, 2]),
        ("1 3,5 2", [1, 3.5, 2]),
        ("1; 3,5; 2", [1, 3.5, 2]),
        ("1;3,5;2", [1, 3.5, 2]),
        ("1, 3.5, 2", [1, 3.5, 2]),
        ("1,3.5,2", [1, 3.5, 2]),
        ("1,3,2", [1, 3, 2]),
        ("[1, 3.5, 2]", [1, 3.5, 2]),
        ("1\t3.5\t2", [1, 3.5, 2]),
        ("0,5", [0.5]),
        ("2,5 1", [2.5, 1]),
        ("1,2 3,4", [1.2, 3.4]),
        ("2.5,1", [2.5, 1]),
        ("−2 1", [-2, 1]),
        ("1 −2", [1, -2]),
        ("1/3 1", [1 / 3, 1]),
        ("1e-3 2·10^-3", [1e-3, 2e-3]),
        ("[1 0.5]", [1, 0.5]),
        ("[1 0.5]'", [1, 0.5]),
        ("[1 0.5];", [1, 0.5]),
        ("[1,2]", [1, 2]),
        ("[1,2,]", [1, 2]),
        ("[1 200 1]", [1, 200, 1]),
        ("[0, 0, 1]", [0, 0, 1]),
        ("num = [1 0.5]", [1, 0.5]),
        ("den=[1, 3, 2]; % second order", [1, 3, 2]),
        ("np.array([1., 2.])", [1, 2]),
        ("conv([1 2],[3 4])", [3, 10, 8]),
        ("den = conv([1, 1], conv([1 2], [1 3]))", [1, 6, 11, 6]),
        ("np.polymul([1,1],[1,1])", [1, 2, 1]),
        ("(1 2)", [1, 2]),
        ("{1, 2}", [1, 2]),
        ("1200 120 1", [1200, 120, 1]),
        ("1; 200; 1", [1, 200, 1]),
        ("1, 200, 1", [1, 200, 1]),
        ("1.000 2", [1, 2]),
        ("12500", [12500]),
    ],
)
def test_coefficients_as_people_write_them(text, meant):
    assert read_numbers("denominator", text) == pytest.approx(meant, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("1, 2,5, 3", "two ways"),
        ("1,2, 3", "two ways"),
        ("2,5", "two ways"),
        ("[0,5]", "two ways"),
        ("[1 3,5 2]", "two ways"),
        ("1,234,567", "two ways"),
        ("12 500", "two ways"),
        ("10 000 1", "two ways"),
        ("1 200 1", "two ways"),
        ("-1 200", "two ways"),
        ("2 10^3 1", "two ways"),
        ("1 2; 3", "two ways"),
        ("1,000; 2", "coefficient 1 can be read in two ways"),
        ("1 2,500", "coefficient 2 can be read in two ways"),
        ("1 - 2", "a sign must stand at its number"),
        ("1 + 2", "a sign must stand at its number"),
        ("1-2", "work it out"),
        ("", "at least one coefficient"),
        ("[]", "at least one coefficient|missing|nothing"),
        ("1;;2", "coefficient 2 is missing"),
        ("1 x 2", "coefficient 2 must be one number, found 'x'"),
        ("s^2+3s+1", "must be"),
        ("poly([-1 -2])", "must be coefficients"),
        ("50% 1", "percent"),
        ("1 inf", "must be"),
        ("1 2 3]", "coefficient 3"),
        ("[1 2", "coefficient 1"),
        ("conv([1e300 1],[1e300 1])", "between"),
        ("1 " * 999, "at most 41 coefficients, found 999"),
        ("1 " * 3000, "at most 2000 characters"),
        ("conv(" * 300, "must be coefficients"),
    ],
)
def test_lists_that_may_be_two_are_refused(text, words):
    with pytest.raises(InvalidParameter, match=f"denominator.*(?:{words})"):
        read_numbers("denominator", text)


@given(
    st.lists(st.floats(-1e6, 1e6).map(lambda value: round(value, 3)), min_size=1, max_size=8),
    st.sampled_from(["[{}]", "{}", "x = [{}]"]),
    st.sampled_from([", ", " ", "; "]),
)
def test_lists_of_programs_read_back(values, frame, separator):
    text = frame.format(separator.join(map(repr, values)))
    assert read_numbers("numerator", text) == values
