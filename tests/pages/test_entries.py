"""Table, polynomials and text describe one plant and convert into each other."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pages.common.plant import rows as entries
from simc_core import Plant
from simc_core.errors import InvalidParameter
from simc_core.numbers import read_numbers

from .test_links import plants


@settings(max_examples=50, deadline=None)
@given(plants, st.booleans())
def test_the_table_gives_back_the_same_plant(plant, pair):
    if pair:
        plant = Plant(plant.k, plant.theta, plant.lags, plant.leads, 1, ((2.0, 0.3),), ((0.5, -0.2),))
    assert entries.plant_of_rows(plant.k, plant.theta, entries.rows_of(plant)) == plant


@settings(max_examples=50, deadline=None)
@given(plants)
def test_polynomials_give_back_the_same_response(plant):
    back = entries.plant_of_polynomials(*entries.polynomials_of(plant), plant.theta)
    slowest = max(plant.lags)
    s = 1j * np.geomspace(1e-2, 1e2, 9) / slowest
    # eleven digits are written, and multiplying out loses some of them in small roots, not in G
    assert back.response(s) == pytest.approx(plant.response(s), rel=1e-8)


@pytest.mark.parametrize(
    "text", ["1 3.5 2", "1 3,5 2", "1; 3,5; 2", "1, 3.5, 2", "1,3.5,2", "[1, 3.5, 2]", " 1   3.5 2 "]
)
def test_coefficients_as_people_type_them(text):
    assert read_numbers("denominator", text) == [1.0, 3.5, 2.0]


@pytest.mark.parametrize(
    ("text", "why"),
    [("", "at least one"), ("1 x 2", "coefficient 2"), ("1 " * 3000, "at most 2000 characters")],
)
def test_coefficients_that_are_none(text, why):
    with pytest.raises(InvalidParameter, match=why):
        read_numbers("denominator", text)


def row(factor, tau=None, zeta=None):
    """A row of the table, where numbers are text."""
    return {"factor": factor, "tau": tau, "zeta": zeta}


@pytest.mark.parametrize(
    ("rows", "why"),
    [
        ([row(entries.LAG, "1.0"), row(entries.LAG, "0.0")], "row 2: τ must not be zero, found 0"),
        ([row(entries.LAG)], "row 1: τ must be a number, found nothing"),
        ([row(None, "2.0")], "row 1: choose what kind"),
        ([row(entries.LAG_PAIR, "2.0")], "row 1: ζ must be a number, found nothing"),
        ([row(entries.LAG_PAIR, "-2.0", "0.5")], "row 1: τ must be > 0, found -2"),
        ([row(entries.LEAD, "2.0")], "degree of the numerator"),
        ([row(entries.INTEGRATOR)] * 5, "integrators must be <= 4, found 5"),
        ([row(entries.LAG, "1e300")], "row 1: "),
        ([row(entries.LAG, "1.0")] * 200, "at most 40"),
    ],
)
def test_a_table_that_is_no_plant_names_the_row(rows, why):
    with pytest.raises(InvalidParameter, match=why):
        entries.plant_of_rows(1.0, 0.0, rows)


def test_rows_not_yet_begun_do_not_count():
    assert entries.plant_of_rows(2.0, 1.0, [row(None), row(entries.LAG, "3.0")]) == Plant(2.0, 1.0, (3.0,))


def test_edits_of_the_table_are_applied_in_order():
    rows = [row(entries.LAG, "1.0"), row(entries.LAG, "2.0")]
    edits = {"edited_rows": {1: {"tau": "5,0"}}, "added_rows": [{"factor": entries.INTEGRATOR}], "deleted_rows": [0]}
    assert entries.edited(rows, edits) == [row(entries.LAG, "5,0"), row(entries.INTEGRATOR)]
