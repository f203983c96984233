"""From a controller to the numbers that are typed into a box, and from these numbers to the controller in effect."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial

from simc_core import checks
from simc_core.controllers.forms import Controller
from simc_core.errors import BoxError
from simc_core.implementation.boxes.box import PV_FILTER, STRUCTURE, Box
from simc_core.implementation.boxes.catalogue import BOXES
from simc_core.implementation.boxes.fields import carries_gain, check, numbers, off_value, with_sign, with_structure
from simc_core.implementation.boxes.laws import LAWS, Quantities
from simc_core.implementation.boxes.units import Spans, law_quantity, read
from simc_core.wording import Text, said

SECONDS = {"s": 1, "min": 60}
REQUIRED = ("gain", "PB", "Ti", "1/Ti", "Ki", "1/Ki")
RATIOS = 1e-3, 1e6  # of N


@dataclass(frozen=True, slots=True)
class Typed:
    """What is typed into a box, and what that makes.

    Attributes
    ----------
    values : mapping of str to float or str
        Numbers by the names of the box's fields; "structure" for its set-point structure, "PV filter" in seconds for a
        filter before it, where there is one.
    action : {"reverse", "direct"}
        reverse: the output falls when PV rises, as a plant of positive gain needs it.
    effective : Controller
        Read back from the typed numbers, in the time unit of the design.
    warnings : tuple of Text
        What differs from the design, and what must be looked up.
    """

    values: Mapping[str, float | str]
    action: str
    effective: Controller
    warnings: tuple[Text, ...]


def to_box(
    controller: Controller,
    key: str,
    pv_span: float = 100.0,
    out_span: float = 100.0,
    time_unit: str = "s",
    N: float | None = None,
    rounded: bool = False,
    nearest: bool = False,
) -> Typed:
    """The numbers that are typed into a box for a controller.

    Parameters
    ----------
    controller : SeriesPid, IdealPid, ParallelPid or IController
        The design, its gain in units of output over units of PV.
    key : str
        Of BOXES.
    pv_span, out_span : float
        Range of PV and of the output, in the units of the controller's gain.
    time_unit : {"s", "min"}
        Of the controller.
    N : float, optional
        Ratio Td/Tf, where the box lets one choose it. None: as the design's tau_F needs it, else the box's own choice.
    rounded : bool
        To what can be typed, on the safe side: gain down, integral time up, derivative time to the nearest.
    nearest : bool
        A number beyond the range of the box becomes the nearest within it, with a warning, rather than a BoxError.

    Returns
    -------
    Typed
        Numbers, action, the controller in effect, warnings.

    Raises
    ------
    BoxError
        A number is beyond the range of the box; with the nearest that can be typed.
    FormError
        The controller has no equivalent in the form of the box.

    Examples
    --------
    A minute of integral time is one minute per repeat, and a gain of 2 a proportional band of 50 %:

    >>> from simc_core import IdealPid, to_box
    >>> found = to_box(IdealPid(2.0, 60.0), "honeywell_udc")
    >>> found.values["PB"], found.values["RSET"], found.action
    (50.0, 1.0, 'reverse')
    """
    box, spans, seconds = _box(key), _spans(pv_span, out_span), _seconds(time_unit)
    design = controller.rescaled(Fraction(seconds))
    form = design.to_parallel()
    sign = math.copysign(1.0, form.Kp or form.Ki)
    positive = design.rescaled(gain=sign)
    if N is not None and box.filter != "ratio":
        raise BoxError(
            said("{box} has no ratio N of derivative time to filter time to choose, found N = {N}", box=box.title, N=N),
            "N",
            N,
        )
    N = None if N is None else checks.real("N", N, *RATIOS)
    law, pv_filter, warnings = LAWS[box.form].forward(positive, box, N)
    action = "reverse" if sign > 0 else "direct"
    plain = numbers(box, law, spans, rounded, warnings if nearest else None)
    if box.sign * sign < 0:
        plain = {name: with_sign(box, name, number) for name, number in plain.items()}
    values, more = with_structure(box, plain, law)
    if pv_filter:
        values[PV_FILTER] = pv_filter
        warnings.append(
            said(
                "the filter tau_F = {pv_filter:g} s must be set at the measurement, before the box: the loop is "
                "as designed, but the set point is not filtered",
                pv_filter=pv_filter,
            )
        )
    effective = from_box(key, values, action, pv_span, out_span, time_unit)
    return Typed(values, action, effective, (*warnings, *more, *_of_the_box(box)))


def from_box(
    key: str,
    values: Mapping[str, float | str],
    action: str = "reverse",
    pv_span: float = 100.0,
    out_span: float = 100.0,
    time_unit: str = "s",
) -> Controller:
    """The controller that typed numbers make.

    Parameters
    ----------
    key : str
        Of BOXES.
    values : mapping of str to float or str
        As in Typed. Without derivative time it is off; ratios, weights and structure have the box's own choice.
    action : {"reverse", "direct"}
        As in Typed, whatever the box calls it (`Box.actions`).
    pv_span, out_span : float
        Range of PV and of the output.
    time_unit : {"s", "min"}
        Of the controller that is returned, and of nothing else.

    Returns
    -------
    Controller
        In the form of the box; its filter on the whole, as everywhere in simc_core.

    Raises
    ------
    BoxError
        A field is missing, unknown, or beyond its range.

    Examples
    --------
    A proportional band of 50 % and one minute per repeat are Kc = 2 and tau_I = 60 s:

    >>> from simc_core import from_box
    >>> pid = from_box("honeywell_udc", {"PB": 50.0, "RSET": 1.0})
    >>> pid.Kc, pid.tau_I
    (2.0, 60.0)
    """
    box, spans, seconds = _box(key), _spans(pv_span, out_span), _seconds(time_unit)
    checks.one_of("action", action, ("reverse", "direct"))
    names = {field.name for field in box.fields}
    unknown = [name for name in values if name not in names | {STRUCTURE, PV_FILTER}]
    if unknown:
        raise BoxError(
            said(
                "{box} has no field {field}; it has {fields}",
                box=box.title,
                field=unknown[0],
                fields=", ".join(sorted(names)),
            ),
            unknown[0],
        )
    sign = 1.0 if action == "reverse" else -1.0
    law: Quantities = {}
    for field in box.fields:
        if field.name not in values:
            if field.quantity in REQUIRED:
                raise BoxError(said("{field} of {box} must be given", field=field.name, box=box.title), field.name)
            continue
        given = number = checks.real(field.name, values[field.name])
        if box.sign and carries_gain(field) and number:
            number *= box.sign * sign
            if number < 0:
                raise BoxError(
                    said(
                        "{field} of {box} must have the sign of a reverse acting controller, found {number}",
                        field=field.name,
                        box=box.title,
                        number=values[field.name],
                    )
                    if action == "reverse"
                    else said(
                        "{field} of {box} must have the sign of a direct acting controller, found {number}",
                        field=field.name,
                        box=box.title,
                        number=values[field.name],
                    ),
                    field.name,
                    given,
                    -given,
                )
        check(box, field, number)
        law[law_quantity(field)] = off_value(field) if number == field.off else read(field, number, spans)
    structure = values.get(STRUCTURE, next(iter(box.structures), None))
    if box.structures:
        structure = checks.one_of(STRUCTURE, structure, box.structures, partial(BoxError, field=STRUCTURE))
        law["b"], law["c"] = box.structures[structure]
    pv_filter = checks.optional_time(PV_FILTER, values.get(PV_FILTER, 0.0))
    found = LAWS[box.form].back(law, box)
    if pv_filter and found.tau_F:
        raise BoxError(
            said(
                "{field} must be 0 beside the filter of {box} itself, found {pv_filter:g}: a controller has one "
                "filter here",
                field=PV_FILTER,
                box=box.title,
                pv_filter=pv_filter,
            ),
            PV_FILTER,
            pv_filter,
            0.0,
        )
    found = replace(found, tau_F=pv_filter) if pv_filter else found
    return found.rescaled(Fraction(1, seconds), sign)


def _of_the_box(box: Box) -> list[Text]:
    """What one should know of a box whatever is typed."""
    read_in = (
        []
        if box.verified == "maker"
        else [said("read in a text of a third party ({source}): check your manual", source=box.source)]
    )
    return [
        *read_in,
        *(said("not read in any text, check your manual: {what}", what=what) for what in box.unread),
        *box.notes,
    ]


def _box(key: str) -> Box:
    return BOXES[checks.one_of("key", key, BOXES)]


def _spans(pv_span: float, out_span: float) -> Spans:
    return Spans(checks.positive("pv_span", pv_span), checks.positive("out_span", out_span))


def _seconds(time_unit: str) -> int:
    return SECONDS[checks.one_of("time_unit", time_unit, SECONDS)]
