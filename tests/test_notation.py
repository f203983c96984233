"""Plain text reads back, LaTeX says the same as the transfer function, numbers have the digits they should."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from simc_core import (
    FirstOrderDelay,
    IController,
    IdealPid,
    OscillatingDelay,
    ParallelPid,
    Plant,
    SecondOrderDelay,
    SeriesPid,
    UnstableDelay,
    parse_plant,
)
from simc_core.cascade.pairs import PAIRS as CASCADES
from simc_core.notation import latex, latex_number, number, plain, rounded_down, rounded_up
from simc_core.plants.examples import EXAMPLES

TAUS = st.floats(1e-6, 1e6)
EITHER = TAUS | TAUS.map(lambda tau: -tau)
ZETAS = st.just(0.0) | st.floats(1e-3, 0.999) | st.floats(-0.999, -1e-3)
PAIRS = st.tuples(TAUS, ZETAS)


@st.composite
def plants(draw):
    """Plants of order up to 8 with every kind of factor; pairs with |zeta| < 1."""
    lags = draw(st.lists(EITHER, max_size=3))
    lag_pairs = draw(st.lists(PAIRS, max_size=2))
    integrators = draw(st.integers(0, 2))
    room = len(lags) + 2 * len(lag_pairs) + integrators
    leads = draw(st.lists(EITHER, max_size=min(room, 2)))
    lead_pairs = draw(st.lists(PAIRS, max_size=(room - len(leads)) // 2))
    k = draw(st.floats(1e-6, 1e6) | st.floats(-1e6, -1e-6))
    return Plant(k, draw(st.just(0.0) | TAUS), lags, leads, integrators, lag_pairs, lead_pairs)


@given(plants())
def test_plain_text_reads_back_to_the_last_bit(plant):
    assert parse_plant(plain(plant)) == plant


@given(plants())
def test_latex_reads_back_with_all_digits(plant):
    """The parser knows \\frac, so the typeset form can be read back and compared as a function."""
    again = parse_plant(latex(plant, digits=17))
    s = 0.3 + 0.4j
    assert again.response(s) == pytest.approx(plant.response(s), rel=1e-6)


@pytest.mark.parametrize("plant", [example.plant for example in EXAMPLES], ids=plain)
def test_examples_read_back(plant):
    assert parse_plant(plain(plant)) == plant
    assert parse_plant(latex(plant)) == plant


@pytest.mark.parametrize("pair", CASCADES)
def test_cascade_examples_read_back(pair):
    for plant in CASCADES[pair]:
        assert parse_plant(plain(plant)) == plant


@pytest.mark.parametrize(
    ("item", "text"),
    [
        (Plant(1, 3, (6, 4, 2)), "exp(-3 s)/((6 s + 1) (4 s + 1) (2 s + 1))"),
        (Plant(2, 0.5, (3, 3), (-2,), 1), "2 (1 - 2 s) exp(-0.5 s)/(s (3 s + 1)^2)"),
        (Plant(-1), "-1"),
        (OscillatingDelay(1, 0, 5, 0.3), "1/(25 s^2 + 3 s + 1)"),
        (UnstableDelay(0.1, 1, 0.1), "-1 exp(-s)/(1 - 10 s)"),
    ],
)
def test_plain_text(item, text):
    assert plain(item) == text


@pytest.mark.parametrize(
    ("item", "text"),
    [
        (FirstOrderDelay(1, 7, 8), r"\frac{e^{-7 s}}{8 s + 1}"),
        (SecondOrderDelay(0.225, 1.234567, 2, 1), r"\frac{0.225 e^{-1.235 s}}{(2 s + 1) (s + 1)}"),
        (FirstOrderDelay(-1, 1, 0), "-e^{-s}"),
        (Plant(1, 0, (1, 1, 1)), r"\frac{1}{(s + 1)^{3}}"),
        (IController(0.5), r"\frac{0.5}{s}"),
        (SeriesPid(0.75, 6), r"0.75 \frac{6 s + 1}{6 s}"),
        (SeriesPid(0.75, 6, 5), r"0.75 \frac{6 s + 1}{6 s} (5 s + 1)"),
        (SeriesPid(0.75, 6, 5, 0.05), r"0.75 \frac{6 s + 1}{6 s} \frac{5 s + 1}{0.05 s + 1}"),
        (SeriesPid(0.75, math.inf), "0.75"),
        (IdealPid(1.375, 11, 30 / 11), r"1.375 \left(1 + \frac{1}{11 s} + 2.727 s\right)"),
        (IdealPid(2, math.inf), "2"),
        (ParallelPid(1, 2, -3, 0.1), r"\left(1 + \frac{2}{s} - 3 s\right) \frac{1}{0.1 s + 1}"),
        (ParallelPid(1, 2), r"1 + \frac{2}{s}"),
    ],
)
def test_latex(item, text):
    assert latex(item) == text


@pytest.mark.parametrize(
    ("value", "text", "tex"),
    [
        (0.57142857, "0.5714", "0.5714"),
        (7.0, "7", "7"),
        (123456.0, "123500", "123500"),
        (1.2e-5, "1.2e-5", r"1.2\cdot 10^{-5}"),
        (3e9, "3e9", r"3\cdot 10^{9}"),
        (-0.25, "-0.25", "-0.25"),
        (math.inf, "∞", r"\infty"),
        (-math.inf, "−∞", r"-\infty"),
        (math.nan, "–", r"\text{–}"),
    ],
)
def test_numbers(value, text, tex):
    assert (number(value), latex_number(value)) == (text, tex)


@given(st.floats(1e-9, 1e9), st.integers(1, 6))
def test_a_number_rounded_up_is_not_below_and_has_few_digits(value, digits):
    found = rounded_up(value, digits)
    assert value * (1 - 1e-11) <= found <= value * (1 + 10.0 ** (1 - digits)) * (1 + 1e-11)
    assert float(f"{found:.{digits}g}") == found


@given(st.floats(1e-9, 1e9), st.integers(1, 6))
def test_a_number_rounded_down_is_not_above_and_has_few_digits(value, digits):
    found = rounded_down(value, digits)
    assert value * (1 - 10.0 ** (1 - digits)) * (1 - 1e-11) <= found <= value * (1 + 1e-11)
    assert float(f"{found:.{digits}g}") == found
