"""Rows tuned: each read and designed on its own, then judged together. No row can cost another one its result."""

import gc
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from itertools import chain
from typing import Any

from simc_core.controllers.forms import Controller
from simc_core.errors import InvalidParameter, SimcError
from simc_core.implementation.boxes.convert import to_box
from simc_core.loops.loop import Loop
from simc_core.many import notes
from simc_core.many.judge import judge
from simc_core.many.request import Request, read_request
from simc_core.many.result import Judged, Result, refused, told
from simc_core.plants.models import Model
from simc_core.reduction.half_rule import reduced_model
from simc_core.rules.simc import simc
from simc_core.rules.speed import tau_c_in_use
from simc_core.studies.advice import Advice
from simc_core.studies.equal_robustness import at_equal_robustness
from simc_core.studies.tune import tune
from simc_core.wording import said

MOST_ROWS = 1000  # of one chunk: a second; with fewer, too few loops have the same structure


@dataclass(frozen=True, slots=True)
class _Design:
    """A row with its controller; model and tau_c where it is SIMC by the half rule."""

    request: Request
    controller: Controller
    model: Model | None = None
    tau_c: float = 0.0


def tune_row(row: Mapping[str, Any]) -> Result:
    """One loop of a list: tuned, judged, compared with its present settings, or refused in words.

    Parameters
    ----------
    row : mapping of str to str or float
        tag, and plant (text) or k, theta, tau1, tau2 or k_prime, theta, tau2; optional are kind, rule, tau_c or Ms,
        filter; the present settings form, Kc, tau_I, tau_D, tau_F or Kp, Ki, Kd; box, pv_span, out_span, time_unit.

    Returns
    -------
    Result
        Never raises: what goes wrong is `Result.refusal`, or an advice where only a part of the row is missing.

    References
    ----------
    [SK03]

    Examples
    --------
    The first example of [V06] prints Kc = 0.57 and tau_I = 8:

    >>> from simc_core import tune_row
    >>> found = tune_row({"tag": "FC-101", "plant": "exp(-3s)/((6s+1)(4s+1)(2s+1))"})
    >>> round(found.controller.Kc, 2), found.controller.tau_I
    (0.57, 8.0)
    >>> tune_row({"tag": "TC-7", "k": 2, "theta": 1}).refusal
    'tau1 must be given beside k, theta (0 where there is none)'
    """
    return tune_chunk([row])[0]


def tune_chunk(rows: Sequence[Mapping[str, Any]]) -> list[Result]:
    """Some rows, their loops judged together: several times faster than one by one, with the same results.

    Parameters
    ----------
    rows : sequence of mappings, at most MOST_ROWS
        As of `tune_row`.

    Returns
    -------
    list of Result
        In the order of the rows.

    Raises
    ------
    InvalidParameter
        More than MOST_ROWS rows.

    Examples
    --------
    SIMC has Kc = (1/k) tau1/(tau_c + theta) with tau_c = theta [SK03]:

    >>> from simc_core import tune_chunk
    >>> found = tune_chunk([{"k": k, "theta": 1, "tau1": 8} for k in (1, 2)])
    >>> [each.controller.Kc for each in found]
    [4.0, 2.0]
    """
    if len(rows) > MOST_ROWS:
        raise InvalidParameter(
            said(
                "a chunk may have at most {most_rows} rows, found {n}: use tune_many", most_rows=MOST_ROWS, n=len(rows)
            )
        )
    with _nothing_collected():
        designs = [_designed(row) for row in rows]
        loops = [_loops(design) for design in designs]
        judged = iter(judge(list(chain.from_iterable(loops))))
        return [
            _finished(row, design, [next(judged) for _ in own])
            for row, design, own in zip(rows, designs, loops, strict=True)
        ]


@contextmanager
def _nothing_collected() -> Iterator[None]:
    """The collector of cycles waits: a chunk makes a hundred thousand objects that stay, and no cycles to speak of.

    Looking for some among them, again and again, was a tenth of the time of a chunk.
    """
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


def _designed(row: Mapping[str, Any]) -> "_Design | Result":
    try:
        request = read_request(row)
        return _with_controller(request)
    except Exception as error:
        return refused(row, error)


def _with_controller(request: Request) -> _Design:
    plant, kind = request.plant, request.kind
    if request.Ms is not None:
        found = at_equal_robustness(request.rule, plant, kind, request.Ms).controller
        if found is None:
            raise InvalidParameter(
                said(
                    "Ms = {Ms:g} cannot be met by the rule {rule}: ask for another Ms, or leave it empty",
                    Ms=request.Ms,
                    rule=request.rule,
                )
            )
        return _Design(request, found)
    if request.rule != "simc":
        knobs = {} if request.tau_c is None else {"tau_c": request.tau_c}
        return _Design(request, tune(request.rule, plant, kind, **knobs).with_filter(request.filter))
    model = reduced_model(plant, 2 if kind == "PID" else 1)
    if request.tau_c is None and not getattr(model, "theta", 0.0):
        simc(model)  # raises: without dead time tau_c must be given
    tau_c = tau_c_in_use(model, request.tau_c, "")
    return _Design(request, simc(model, tau_c).with_filter(request.filter), model, tau_c)


def _loops(design: "_Design | Result") -> list[Loop]:
    """The new loop of a row, and the present one, if it has one."""
    if isinstance(design, Result):
        return []
    plant, present = design.request.plant, design.request.present
    return [Loop(plant, controller) for controller in (design.controller, present) if controller is not None]


def _finished(row: Mapping[str, Any], design: "_Design | Result", judged: list[Judged | Exception]) -> Result:
    if isinstance(design, Result):
        return design
    made = judged[0]
    if isinstance(made, Exception):
        return refused(row, made)
    try:
        return _told(row, design, made, judged[1] if len(judged) > 1 else None)
    except Exception as error:
        return refused(row, error)


def _told(row: Mapping[str, Any], design: _Design, made: Judged, now: Judged | Exception | None) -> Result:
    """All that is said of a row. The settings in use now, or the box, may be refused alone."""
    request, controller = design.request, design.controller
    if design.model is None:
        advice = notes.on_any(request.plant, made)
    else:
        advice = notes.on_simc(request, design.model, design.tau_c, made, Loop(request.plant, controller))
    result = Result(row, controller, made.margins, made.performance, plant=request.plant, model=design.model)
    if request.box:
        spans = request.pv_span, request.out_span
        try:
            typed = to_box(controller, request.box, *spans, time_unit=request.time_unit, rounded=True)
            result = replace(result, typed=typed)
        except SimcError as error:
            advice += (Advice("error", said("box"), said("{why}.", why=told(error))),)
    why_not = request.present_refusal or (told(now) if isinstance(now, Exception) else "")
    if why_not:
        advice += (Advice("error", said("settings now"), said("{why}.", why=why_not)),)
    advice = notes.gravest_first(advice)
    if isinstance(now, Judged):
        result = replace(result, present=now)
        advice += notes.on_present(request.plant, now)
    return replace(result, advice=advice)
