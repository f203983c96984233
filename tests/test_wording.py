"""Sentences that remember what they were made of are plain English strs to everyone else."""

import copy
import json
import pickle

import pytest

from simc_core.checks import real
from simc_core.errors import DataError, InvalidParameter
from simc_core.wording import Numeral, Text, counted, joined, said

SENTENCE = said("{field} must be at least {bound:g}, found {found:.2f}", field="k", bound=2.0, found=1.5)


def test_it_is_the_english_sentence():
    assert SENTENCE == "k must be at least 2, found 1.50"
    assert hash(SENTENCE) == hash("k must be at least 2, found 1.50")
    assert json.loads(json.dumps([SENTENCE])) == ["k must be at least 2, found 1.50"]


@pytest.mark.parametrize("through", [copy.copy, copy.deepcopy, lambda text: pickle.loads(pickle.dumps(text)), str])
def test_it_stays_what_it_is(through):
    again = through(counted("{n} pole of {plant}", "{n} poles of {plant}", 3, plant=SENTENCE, context="plants"))
    assert again == "3 poles of k must be at least 2, found 1.50"
    assert (again.template, again.several) == ("{n} pole of {plant}", "{n} poles of {plant}")
    assert (again.n, again.context) == (3, "plants")
    assert again.values["plant"].values["bound"] == 2.0


def test_braces_without_values_are_what_they_are():
    assert said("$\\frac{1}{s}$") == "$\\frac{1}{s}$"


def test_one_and_several():
    assert [counted("{n} lag", "{n} lags", n) for n in (0, 1, 2)] == ["0 lags", "1 lag", "2 lags"]


def test_joined_keeps_its_parts():
    both = joined([SENTENCE, "and", Numeral("0.5")], "; ")
    assert both == f"{SENTENCE}; and; 0.5"
    assert isinstance(both, Text)
    assert both.values["parts"][0].template == SENTENCE.template


def test_a_value_can_be_put_in_place_of_another():
    assert SENTENCE.put(field="Gain k") == "Gain k must be at least 2, found 1.50"


def test_errors_tell_it():
    with pytest.raises(InvalidParameter) as refused:
        real("k", 3.0, high=2.0)
    text = str(refused.value)
    assert text.template == "{name} must be <= {high:g}, found {number:g}"
    assert dict(text.values) == {"name": "k", "high": 2.0, "number": 3.0}
    assert str(DataError(said("no number"), 3, 4)) == "line 3 column 4: no number"
