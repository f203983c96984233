"""The plainest spelling by its pattern, against the grammar, to the last bit; and nothing else by the pattern."""

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from simc_core import Plant, parse_plant
from simc_core.errors import SimcError
from simc_core.notation import plain
from simc_core.plants.parse import _plant
from simc_core.plants.pasted.factored import read_factored

numbers = st.sampled_from(["2", "0.5", "13.2871", "0", "007", "1", "1.10", "12345678901234567"])
tau_s = st.builds("{}{}s".format, st.just("") | numbers, st.sampled_from(["", " ", "*", " * "])) | st.just("s")
factors = st.builds("({}{}1)".format, tau_s, st.sampled_from(["+", " + "])) | st.builds(
    "(1{}{})".format, st.sampled_from(["+", "-", " - ", " + "]), tau_s
)
delays = st.builds("{}-{})".format, st.sampled_from(["exp(", "e^("]), tau_s)
beside = st.sampled_from(["", " ", "*", " * "])


@st.composite
def texts(draw) -> str:
    parts = draw(st.lists(factors | delays, max_size=3))
    top = "".join(draw(beside) + part for part in parts)
    below = draw(st.lists(factors, min_size=1, max_size=3))
    bottom = draw(st.sampled_from(["", "s"])) + "".join(draw(beside) + part for part in below)
    bottom = f"({bottom})" if len(below) > 1 or draw(st.booleans()) else bottom
    return draw(st.sampled_from(["", "-"])) + draw(st.just("") | numbers) + top + draw(beside) + "/" + bottom


def outcome(read: Callable[[str], Plant | None], text: str) -> object:
    try:
        return read(text)
    except (SimcError, OverflowError) as error:
        return str(error)


@given(text=texts() | st.text("0123456789.+-*/()se xp^1", max_size=40))
def test_whatever_the_pattern_reads_the_grammar_reads_alike(text):
    """Or refuses with the same words, where a number is out of bounds."""
    found = outcome(read_factored, text)
    assert found is None or found == outcome(_plant, text)


@pytest.mark.parametrize(
    ("text", "plant"),
    [
        ("-0.29 (1 - 2.6 s) exp(-0.7 s)/((13.2 s + 1)(6.6 s + 1))", Plant(-0.29, 0.7, (13.2, 6.6), (-2.6,))),
        ("exp(-3s)/((6s+1)(4s+1)(2s+1))", Plant(1, 3, (6, 4, 2))),
        ("2 e^(-0.5s)/(s(3s+1))", Plant(2, 0.5, (3,), (), 1)),
        ("-exp(-s)/s", Plant(-1, 1, (), (), 1)),
        (plain(Plant(0.5, 1.25, (8, 0.3), (-1.5,), 1)), Plant(0.5, 1.25, (8, 0.3), (-1.5,), 1)),
    ],
)
def test_the_plainest_spelling(text, plant):
    assert read_factored(text) == parse_plant(text) == plant


@pytest.mark.parametrize("text", ["1/2s", "1,000/(s+1)", "5e-3s/(s+1)", "* exp(-s)/(s+1)", "2 exp(-s) exp(-s)/(s+1)"])
def test_what_could_be_meant_otherwise_is_left_to_the_grammar(text):
    assert read_factored(text) is None
