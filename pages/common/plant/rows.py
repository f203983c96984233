"""The ways people have a plant: a table of factors, or polynomials. Each to a Plant and back. Pure: no streamlit."""

import re
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from pages.common.session.links import number_text
from simc_core import Plant, checks
from simc_core.errors import InvalidParameter
from simc_core.numbers import read_number, read_numbers
from simc_core.wording import renamed, said

LAG = said("lag 1/(τs + 1)")
LEAD = said("zero (τs + 1)")
LAG_PAIR = said("pair 1/(τ²s² + 2ζτs + 1)")
LEAD_PAIR = said("pair (τ²s² + 2ζτs + 1)")
INTEGRATOR = said("integrator 1/s")
FACTORS = (LAG, LEAD, INTEGRATOR, LAG_PAIR, LEAD_PAIR)


def rows_of(plant: Plant) -> list[dict]:
    """The plant as table rows with the columns factor, tau, zeta, numbers as text; gain and dead time stand apart."""
    rows = [_row(INTEGRATOR)] * plant.integrators
    rows += [_row(LAG, number_text(tau)) for tau in plant.lags]
    rows += [_row(LEAD, number_text(tau)) for tau in plant.leads]
    rows += [_row(LAG_PAIR, *map(number_text, pair)) for pair in plant.lag_pairs]
    rows += [_row(LEAD_PAIR, *map(number_text, pair)) for pair in plant.lead_pairs]
    return rows


def plant_of_rows(k: float, theta: float, rows: Iterable[Mapping]) -> Plant:
    """The plant of a table. Raises InvalidParameter, which names the row, the bound and what came in.

    Rows without a factor and without numbers are still empty and do not count.
    """
    lags, leads, lag_pairs, lead_pairs, integrators = [], [], [], [], 0
    for number, row in enumerate(rows, start=1):
        factor = row["factor"]
        if factor is None and not row["tau"] and not row["zeta"]:
            continue
        if factor is None:
            raise InvalidParameter(said("row {number}: choose what kind of factor this is, found none", number=number))
        if factor == INTEGRATOR:
            integrators += 1
        elif factor in (LAG, LEAD):
            tau = checks.time_constant(said("row {number}: τ", number=number), _number(number, "τ", row["tau"]))
            (lags if factor == LAG else leads).append(tau)
        else:
            pair = (_number(number, "τ", row["tau"]), _number(number, "ζ", row["zeta"]))
            _try_pair(number, pair)
            (lag_pairs if factor == LAG_PAIR else lead_pairs).append(pair)
    return Plant(k, theta, lags, leads, integrators, lag_pairs, lead_pairs)


def edited(rows: Sequence[Mapping], edits: Mapping) -> list[Mapping]:
    """Table rows after the edits that st.data_editor reports: edited_rows, added_rows, deleted_rows."""
    changed = [{**row, **edits.get("edited_rows", {}).get(i, {})} for i, row in enumerate(rows)]
    changed += [{**_row(None), **row} for row in edits.get("added_rows", [])]
    gone = set(edits.get("deleted_rows", []))
    return [row for i, row in enumerate(changed) if i not in gone]


def polynomials_of(plant: Plant) -> tuple[str, str]:
    """Numerator and denominator, coefficients in descending powers of s, as text."""
    parts = plant.factored
    num, den = plant.k * _product(parts.num), _product(parts.den)
    return coefficients_text(num), coefficients_text(den)


def plant_of_polynomials(num: str, den: str, theta: float) -> Plant:
    """The plant of two texts of coefficients. Raises InvalidParameter."""
    return Plant.from_polynomials(read_numbers(said("numerator"), num), read_numbers(said("denominator"), den), theta)


def coefficients_text(values: Sequence[float]) -> str:
    """Coefficients as people type them; twelve digits, since products of time constants carry rounding."""
    words = [f"{value:.12g}" for value in values]
    # 1 200 would read back as one number or as two
    return ("; " if any(re.match(r"\d{3}", word) for word in words[1:]) else " ").join(words)


def _row(factor: str | None, tau: str | None = None, zeta: str | None = None) -> dict:
    return {"factor": factor, "tau": tau, "zeta": zeta}


def _number(row: int, symbol: str, text: str | None) -> float:
    return read_number(said("row {row}: {symbol}", row=row, symbol=symbol), text or "")


def _try_pair(row: int, pair: tuple[float, float]) -> None:
    """Let the core judge this pair alone, so that its message can name the row."""
    try:
        Plant(1.0, lag_pairs=[pair])
    except InvalidParameter as error:
        message = renamed(str(error), {"lag_pairs[0] tau": "τ", "lag_pairs[0] zeta": "ζ"})
        raise InvalidParameter(said("row {row}: {message}", row=row, message=message)) from None


def _product(rows: np.ndarray) -> np.ndarray:
    product = np.ones(1)
    for row in rows:
        product = np.polymul(product, np.trim_zeros(row, "f"))
    return np.atleast_1d(product)
