"""The ways people have a plant: a table of factors, or polynomials. Each to a Plant and back. Pure: no streamlit."""

import re
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from simc_core import Plant
from simc_core.errors import InvalidParameter
from simc_core.numbers import read_numbers

LAG = "lag 1/(τs + 1)"
LEAD = "zero (τs + 1)"
LAG_PAIR = "pair 1/(τ²s² + 2ζτs + 1)"
LEAD_PAIR = "pair (τ²s² + 2ζτs + 1)"
INTEGRATOR = "integrator 1/s"
FACTORS = (LAG, LEAD, INTEGRATOR, LAG_PAIR, LEAD_PAIR)


def rows_of(plant: Plant) -> list[dict]:
    """The plant as table rows with the columns factor, tau, zeta; gain and dead time stand apart."""
    rows = [_row(INTEGRATOR)] * plant.integrators
    rows += [_row(LAG, tau) for tau in plant.lags]
    rows += [_row(LEAD, tau) for tau in plant.leads]
    rows += [_row(LAG_PAIR, *pair) for pair in plant.lag_pairs]
    rows += [_row(LEAD_PAIR, *pair) for pair in plant.lead_pairs]
    return rows


def plant_of_rows(k: float | None, theta: float | None, rows: Iterable[Mapping]) -> Plant:
    """The plant of a table. Raises InvalidParameter, which names the row, the bound and what came in.

    Rows without a factor and without numbers are still empty and do not count.
    """
    lags, leads, lag_pairs, lead_pairs, integrators = [], [], [], [], 0
    for number, row in enumerate(rows, start=1):
        factor, tau, zeta = row["factor"], row["tau"], row["zeta"]
        if factor is None and tau is None and zeta is None:
            continue
        if factor is None:
            raise InvalidParameter(f"row {number}: choose what kind of factor this is, got none")
        if factor == INTEGRATOR:
            integrators += 1
        elif factor in (LAG, LEAD):
            (lags if factor == LAG else leads).append(_number(f"row {number}: τ", tau))
        else:
            pair = (_number(f"row {number}: τ", tau), _number(f"row {number}: ζ", zeta))
            (lag_pairs if factor == LAG_PAIR else lead_pairs).append(pair)
        _try_factor(number, factor, tau, zeta)
    return Plant(_number("k", k), _number("theta", theta), lags, leads, integrators, lag_pairs, lead_pairs)


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


def plant_of_polynomials(num: str, den: str, theta: float | None) -> Plant:
    """The plant of two texts of coefficients. Raises InvalidParameter."""
    return Plant.from_polynomials(
        read_numbers("numerator", num), read_numbers("denominator", den), _number("theta", theta)
    )


def coefficients_text(values: Sequence[float]) -> str:
    """Coefficients as people type them; twelve digits, since products of time constants carry rounding."""
    words = [f"{value:.12g}" for value in values]
    # 1 200 would read back as one number or as two
    return ("; " if any(re.match(r"\d{3}", word) for word in words[1:]) else " ").join(words)


def _row(factor: str | None, tau: float | None = None, zeta: float | None = None) -> dict:
    return {"factor": factor, "tau": tau, "zeta": zeta}


def _number(name: str, value: float | None) -> float:
    if value is None:
        raise InvalidParameter(f"{name} must be a number, got nothing")
    return value


def _try_factor(number: int, factor: str, tau: float | None, zeta: float | None) -> None:
    """Let the core judge this factor alone, so that its message can name the row."""
    pair = factor in (LAG_PAIR, LEAD_PAIR)
    try:
        if pair:
            Plant(1.0, lag_pairs=[(tau, zeta)])
        elif factor != INTEGRATOR:
            Plant(1.0, lags=[tau])
    except InvalidParameter as error:
        message = str(error).replace("lag_pairs[0] tau", "τ").replace("lag_pairs[0] zeta", "ζ").replace("lags[0]", "τ")
        raise InvalidParameter(f"row {number}: {message}") from None


def _product(rows: np.ndarray) -> np.ndarray:
    product = np.ones(1)
    for row in rows:
        product = np.polymul(product, np.trim_zeros(row, "f"))
    return np.atleast_1d(product)
