"""parse_plant: what people write, what it means, and where it is wrong."""

import cmath
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from simc_core import ParseError, Plant, SimcError, parse_plant
from simc_core.plants.parse import LONGEST_TEXT

S = 0.3 + 0.7j


@pytest.mark.parametrize(
    ("text", "plant"),
    [
        ("(1-2s)/((10s+1)(6s+1)(s+1))", Plant(1, 0, (10, 6, 1), (-2,))),
        ("exp(-3s)/((6s+1)(4s+1)(2s+1))", Plant(1, 3, (6, 4, 2))),
        ("2 e^{-0.5s}/(s(3s+1)^2)", Plant(2, 0.5, (3, 3), integrators=1)),
        ("1/(s^2+0.6s+1)", Plant(1, lag_pairs=((1, 0.3),))),
        ("G(s) = 0,5 e^-3s/(s+1)³", Plant(0.5, 3, (1, 1, 1))),
        ("e^(-0.5 s)/s**2", Plant(1, 0.5, integrators=2)),
        ("−2·exp[−s/2]/{(s+1)}", Plant(-2, 0.5, (1,))),
        ("1/(5s+1) e^{-s}", Plant(1, 1, (5,))),
        ("1/(5s+1) * e^-2*s", Plant(1, 2, (5,))),
        ("1/(20s-1)", Plant(-1, 0, (-20,))),
        ("1/(20s-1)^2", Plant(1, 0, (-20, -20))),
        ("5", Plant(5)),
        (".5/(1.e1 s + 1)", Plant(0.5, 0, (10,))),
        ("3e-1/(2e1s+1)", Plant(0.3, 0, (20,))),
        (r"\frac{2 e^{-0.5 s}}{s \left(3 s+1\right)^{2}}", Plant(2, 0.5, (3, 3), integrators=1)),
        (r"\frac{1}{2}\cdot\frac{1}{s + 1}", Plant(0.5, 0, (1,))),
        ("s/(s^2 (4s+2))", Plant(0.5, 0, (2,), integrators=1)),
        ("(10s+1)^-2", Plant(1, 0, (10, 10))),
        ("1/e^{2s}", Plant(1, 2)),
        ("1/(1 + 2s + s)", Plant(1, 0, (3,))),
        ("1/(4s² + 1)", Plant(1, lag_pairs=((2, 0),))),
        ("\t1 / ( 8 s + 1 )\n", Plant(1, 0, (8,))),
    ],
)
def test_what_people_write(text, plant):
    assert parse_plant(text) == plant


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("(s+2)/(s^2+3*s+1)", (S + 2) / (S**2 + 3 * S + 1)),
        ("1/(s+1) + 1/(2s+1)", 1 / (S + 1) + 1 / (2 * S + 1)),
        ("e^{-s}/(s+1) - 0,5 e^{-s}/(3s+1)", cmath.exp(-S) * (1 / (S + 1) - 0.5 / (3 * S + 1))),
        ("(1 - (s+1)/(2s+1))/(s(s+4))", (1 - (S + 1) / (2 * S + 1)) / (S * (S + 4))),
        ("3/((s+1)((2s+1)(3s+1) + 5))", 3 / ((S + 1) * ((2 * S + 1) * (3 * S + 1) + 5))),
        ("(0.1s+1)(0.2s-1)/(s^4+4s^3+6s^2+4s+1)", (0.1 * S + 1) * (0.2 * S - 1) / (S + 1) ** 4),
    ],
)
def test_sums_and_products_against_complex_arithmetic(text, value):
    assert parse_plant(text).response(S) == pytest.approx(value, rel=1e-9)


def test_exact_fractions_leave_no_dust():
    """0.1 + 0.2 - 0.3 is 5.6e-17 in doubles and would be a spurious time constant."""
    assert parse_plant("1/((0.1s + 0.2s - 0.3s + 1)(s+1))") == Plant(1, 0, (1,))


@pytest.mark.parametrize(
    ("text", "position", "words"),
    [
        ("", 0, "must not be empty"),
        ("  ", 0, "must not be empty"),
        ("1/(s+1", 6, r"'\(' of position 3 must be closed by '\)', found the end"),
        ("1/(s+1]", 6, r"must be closed by '\)', found '\]'"),
        ("1/(s+1))", 7, "must end here"),
        ("1/(x+1)", 3, "'x' is not known: write the transfer function in s"),
        ("K e^{-s}", 0, "'K' is not known"),
        ("1/(s+1) $", 8, "is not part of a transfer function"),
        ("1/2s", 3, "the denominator is unclear: write"),
        ("1/(s+1)(2s+1)", 7, "the denominator is unclear: write"),
        ("e^{+3s}/(s+1)", 0, "dead time must be >= 0, found -3.*look into the future; a dead time of 3 is e"),
        ("1/exp(-2s)", 2, "look into the future"),
        ("2e/(s+1)", 1, "e must have an exponent"),
        ("exp(-3)", 0, "exponent must be a multiple of s"),
        ("exp(-s^2)", 0, "exponent must be a multiple of s"),
        ("exp(-s/(s+1))", 0, "exponent must be a multiple of s"),
        ("e^-3", 4, "exponent must be a multiple of s"),
        ("1/(s+1) + e^{-s}", 8, "different dead times"),
        ("1/(s-s)", 1, "division by zero"),
        (r"\frac{1}{0}", 0, "division by zero"),
        ("0^-1", 0, "division by zero"),
        ("(s+1)^^2", 6, "whole number, found '\\^'"),
        ("s^0.5", 2, "whole number, found '0.5'"),
        ("s^41", 0, "power must be between"),
        ("(s+1)^99999999999", 0, "power must be between"),
        ("1.2.3", 0, "is not a number"),
        ("1,000,000", 0, "is not a number"),
        ("1e400", 0, "must be below 1e300"),
        ("1e99999999999999", 0, "must be below 1e300"),
        ("1/", 2, "expected here; found the end"),
        ("*2", 0, "expected here"),
        (")", 0, "not opened"),
        ("G(s) =", 6, "expected here; found the end"),
        ("__import__('os')", 0, "not part of a transfer function"),
    ],
)
def test_faults_have_a_position_and_words(text, position, words):
    with pytest.raises(ParseError, match=words) as caught:
        parse_plant(text)
    assert (caught.value.text, caught.value.position) == (text, position)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("0", "k must not be zero"),
        ("0/(s+1)", "k must not be zero"),
        ("s/(s+1)", "must not vanish at s = 0"),
        ("(s^2+1)/(s+1)", "degree of the numerator must be <= 1"),
        ("1e200/(s+1)", "between 1e-12 and 1e\\+12"),
        ("1/s^5", "integrators must be <= 4"),
        ("1/(1e-280 1e-280 s^2 + 1)", "must not be zero"),
        ("1e299 1e299/(s+1)", "more than 1e308"),
        ("exp(-1e10s)", "theta must be <= 1e\\+09"),
        ("1/((s+1)^40(2s+1))", "at most 40 entries"),
    ],
)
def test_plants_out_of_bounds(text, words):
    with pytest.raises(SimcError, match=words):
        parse_plant(text)


@pytest.mark.parametrize(
    "text",
    [
        "(" * 60 + "s" + ")" * 60,
        "((((s+1)^40)^40)^40)^40",
        "(((1e300^40)^40)^40)^40",
        "1" * (LONGEST_TEXT + 1),
        "9" * LONGEST_TEXT + "/(s+1)",
        "(" * LONGEST_TEXT,
        "-" * (LONGEST_TEXT - 1) + "1",
        "*-".join("0" * 600),
        "/".join(["(s+1)"] * 300),
        "+".join(["1/(s+1)"] * 200),
        "+".join(["1/(1e299s+1e-299)^9"] * 90),
        "(s^40+1)^4+(s^40+1)^5",
        "exp(-exp(-s))",
    ],
    ids=lambda text: f"{text[:12]}, {len(text)}",
)
def test_work_is_bounded(text):
    start = time.perf_counter()
    with pytest.raises(SimcError):
        parse_plant(text)
    assert time.perf_counter() - start < 2


@pytest.mark.parametrize("value", [None, 3, b"1/s", ["1"]])
def test_only_text_is_parsed(value):
    with pytest.raises(ParseError, match="must be text"):
        parse_plant(value)


@given(st.text(st.sampled_from("0123456789.,s+-*/^()[]{} e−·²³pxE\\frac"), max_size=40))
def test_any_text_gives_a_plant_or_a_clear_error(text):
    try:
        plant = parse_plant(text)
    except SimcError:
        return
    assert isinstance(plant, Plant)
