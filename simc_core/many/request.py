"""One row of a list, read: which plant, how it shall be tuned, what is in the controller now, and the box it is for.

Values are numbers, or text as people type it. What is not known is left alone: lists have columns for other purposes.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Real
from typing import Any

from simc_core import checks
from simc_core.controllers.forms import FORMS, Controller, IdealPid, ParallelPid, SeriesPid
from simc_core.errors import InvalidParameter, SimcError
from simc_core.numbers import read_number
from simc_core.plants.parse import parse_plant
from simc_core.plants.plant import Plant
from simc_core.wording import said

LONGEST_CELL = 2000  # characters of a plant
LONGEST_WORD = 100  # of any other cell
KINDS = ("PI", "PID")
TIME_UNITS = ("s", "min")
MODEL = ("k", "theta", "tau1", "tau2", "k_prime")
GAINS, TIMES = ("Kp", "Ki", "Kd"), ("Kc", "tau_I", "tau_D")


@dataclass(frozen=True, slots=True)
class Request:
    """What a row asks for.

    tau_c, Ms: at most one of them is given.   filter: tau_F/tau_D.   present: the settings now, None where the row has
    none, or where they make no controller: `present_refusal` then says why.   box: "" for none.
    """

    plant: Plant
    kind: str
    rule: str
    tau_c: float | None
    Ms: float | None
    filter: float
    present: Controller | None
    present_refusal: str
    box: str
    pv_span: float
    out_span: float
    time_unit: str


def read_request(row: Mapping[str, Any]) -> Request:
    """A row as a request.

    Parameters
    ----------
    row : mapping of str to str or float
        Cells by the names of `columns.COLUMNS`; empty text, None and nan are empty cells.

    Returns
    -------
    Request
        With its plant.

    Raises
    ------
    SimcError
        A cell that cannot be read, or cells that do not fit together; the message names them.
    """
    tau_c, Ms, ratio = number(row, "tau_c"), number(row, "Ms"), number(row, "filter")
    if tau_c is not None and Ms is not None:
        raise InvalidParameter(
            said("tau_c and Ms are both given ({tau_c:g}, {Ms:g}): leave one of them empty", tau_c=tau_c, Ms=Ms)
        )
    if Ms is not None and ratio is not None:
        raise InvalidParameter(
            said("filter and Ms are both given: with Ms the filter is tau_F = 0.1 theta, leave it empty")
        )
    present, why = None, ""
    try:
        present = _present(row)
    except SimcError as error:
        why = str(error)
    return Request(
        _plant(row),
        one_of(row, "kind", KINDS),
        word(row, "rule").lower() or "simc",
        tau_c,
        Ms,
        ratio or 0.0,
        present,
        why,
        word(row, "box"),
        _or(number(row, "pv_span"), 100.0),
        _or(number(row, "out_span"), 100.0),
        one_of(row, "time_unit", TIME_UNITS),
    )


def word(row: Mapping[str, Any], name: str) -> str:
    """A cell of text, "" where it is empty."""
    value = row.get(name)
    if _empty(value):
        return ""
    text = str(value).strip()
    return checks.text(name, text, LONGEST_CELL if name == "plant" else LONGEST_WORD)


def number(row: Mapping[str, Any], name: str) -> float | None:
    """A cell with a number, None where it is empty."""
    value = row.get(name)
    if _empty(value):
        return None
    if isinstance(value, str):
        return read_number(name, value)
    if isinstance(value, bool) or not isinstance(value, Real):
        raise InvalidParameter(said("{name} must be a number, found {what}", name=name, what=type(value).__name__))
    return float(value)


def one_of(row: Mapping[str, Any], name: str, choices: tuple[str, ...]) -> str:
    """A cell with one of `choices`, whatever its letters' size; the first where it is empty."""
    text = word(row, name) or choices[0]
    known = {choice.lower(): choice for choice in choices}
    return checks.one_of(name, known.get(text.lower(), text), choices)


def _empty(value: Any) -> bool:
    """None, no text, or the nan of a table's empty cell."""
    return value is None or (isinstance(value, str) and not value.strip()) or value != value


def _or(value: float | None, default: float) -> float:
    return default if value is None else value


def _plant(row: Mapping[str, Any]) -> Plant:
    text = word(row, "plant")
    given = {name: value for name in MODEL if (value := number(row, name)) is not None}
    if text:
        if given:
            raise InvalidParameter(
                said("plant and {given} are both given: leave one of them empty", given=", ".join(given))
            )
        return parse_plant(text)
    if "k_prime" in given:
        if "k" in given or "tau1" in given:
            raise InvalidParameter(
                said("k_prime is given beside k or tau1: an integrating process has k_prime, theta, tau2")
            )
        needed: tuple[str, ...] = ("k_prime", "theta")
    else:
        needed = ("k", "theta", "tau1")
    missing = [name for name in needed if name not in given]
    if missing:
        if not given:
            raise InvalidParameter(
                said("plant must be given, as a transfer function or by k, theta and tau1, found nothing")
            )
        raise InvalidParameter(
            said("{name} must be given beside {given} (0 where there is none)", name=missing[0], given=", ".join(given))
        )
    for name in ("tau1", "tau2"):
        if given.get(name, 0.0) < 0:
            raise InvalidParameter(
                said(
                    "{name} must be >= 0, found {value:g}: write an unstable plant as text",
                    name=name,
                    value=given[name],
                )
            )
    lags = tuple(given[name] for name in ("tau1", "tau2") if given.get(name))
    if "k_prime" in given:
        return Plant(given["k_prime"], given["theta"], lags, integrators=1)
    return Plant(given["k"], given["theta"], lags)


def _present(row: Mapping[str, Any]) -> Controller | None:
    """The settings that are in the controller now; None where no gain is told."""
    gains = {name: value for name in GAINS if (value := number(row, name)) is not None}
    times = {name: value for name in TIMES if (value := number(row, name)) is not None}
    if not gains and not times:
        return None
    form, tau_F = one_of(row, "form", ("ideal", *(form for form in FORMS if form != "ideal"))), number(row, "tau_F")
    if gains and times:
        raise InvalidParameter(
            said(
                "{gains} and {times} are both given: leave one group empty",
                gains=", ".join(gains),
                times=", ".join(times),
            )
        )
    if gains:
        return ParallelPid(gains.get("Kp", 0.0), gains.get("Ki", 0.0), gains.get("Kd", 0.0), tau_F or 0.0)
    if form == "parallel":
        raise InvalidParameter(said("a parallel form has Kp, Ki and Kd, found {times}", times=", ".join(times)))
    if "Kc" not in times:
        raise InvalidParameter(said("Kc must be given beside {times}", times=", ".join(times)))
    make = SeriesPid if form == "series" else IdealPid
    return make(times["Kc"], times.get("tau_I") or math.inf, times.get("tau_D", 0.0), tau_F or 0.0)
