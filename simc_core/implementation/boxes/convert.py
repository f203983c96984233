"""From a controller to the numbers that are typed into a box, and from these numbers to the controller in effect."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from simc_core import checks
from simc_core.controllers.forms import Controller, ParallelPid, SeriesPid
from simc_core.errors import BoxError, InvalidParameter
from simc_core.implementation.boxes.box import PV_FILTER, STRUCTURE, Box, Field
from simc_core.implementation.boxes.catalogue import BOXES
from simc_core.implementation.boxes.filters import (
    DerivativeFiltered,
    derivative_filtered,
    fixed_ratio_filter,
    whole_filtered,
)
from simc_core.implementation.boxes.units import Spans, law_quantity, on_the_safe_side, read, typed

SECONDS = {"s": 1, "min": 60}
SAME = 1e-12  # relative; what differs by less is the same number
REQUIRED = ("gain", "PB", "Ti", "1/Ti", "Ki", "1/Ki")
NEVER_ZERO = ("PB", "Ti", "N", "1/N", "factor")  # but where 0 is off
RATIOS = 1e-3, 1e6  # of N
Quantities = dict[str, float]  # of the law, in seconds and in units of output and PV, all gains positive


@dataclass(frozen=True, slots=True)
class Typed:
    """What is typed into a box, and what that makes.

    Parameters
    ----------
    values : mapping of str to float or str
        Numbers by the names of the box's fields; "structure" for its set-point structure, "PV filter" in seconds for a
        filter before it, where there is one.
    action : {"reverse", "direct"}
        reverse: the output falls when PV rises, as a plant of positive gain needs it.
    effective : Controller
        Read back from the typed numbers, in the time unit of the design.
    warnings : tuple of str
        What differs from the design, and what must be looked up.
    """

    values: Mapping[str, float | str]
    action: str
    effective: Controller
    warnings: tuple[str, ...]


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
        raise BoxError(f"{box.title} has no ratio N of derivative time to filter time to choose, got N = {N}", "N", N)
    N = None if N is None else checks.real("N", N, *RATIOS)
    law, pv_filter, warnings = _LAWS[box.form].forward(positive, box, N)
    action = "reverse" if sign > 0 else "direct"
    values = _numbers(box, law, spans, rounded, warnings if nearest else None)
    if box.sign * sign < 0:
        values = {name: _with_sign(box, name, value) for name, value in values.items()}
    values, more = _with_structure(box, values, law)
    if pv_filter:
        values[PV_FILTER] = pv_filter
        warnings.append(
            f"the filter tau_F = {pv_filter:g} s must be set at the measurement, before the box: the loop is as "
            "designed, but the set point is not filtered"
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
    """
    box, spans, seconds = _box(key), _spans(pv_span, out_span), _seconds(time_unit)
    if action not in ("reverse", "direct"):
        raise InvalidParameter(f"action must be reverse or direct, got {action!r}")
    names = {field.name for field in box.fields}
    unknown = [name for name in values if name not in names | {STRUCTURE, PV_FILTER}]
    if unknown:
        raise BoxError(f"{box.title} has no field {unknown[0]}; it has {', '.join(sorted(names))}", unknown[0])
    sign = 1.0 if action == "reverse" else -1.0
    law: Quantities = {}
    for field in box.fields:
        if field.name not in values:
            if field.quantity in REQUIRED:
                raise BoxError(f"{field.name} of {box.title} must be given", field.name)
            continue
        number = values[field.name]
        number = checks.real(field.name, number, -math.inf, math.inf)
        if box.sign and _carries_gain(field) and number:
            number *= box.sign * sign
            if number < 0:
                raise BoxError(
                    f"{field.name} of {box.title} must have the sign of a {action} acting controller, "
                    f"got {values[field.name]}",
                    field.name,
                    float(values[field.name]),
                    -float(values[field.name]),
                )
        _check(box, field, number)
        law[law_quantity(field)] = _off(field) if number == field.off else read(field, number, spans)
    structure = values.get(STRUCTURE, next(iter(box.structures), None))
    if box.structures:
        if structure not in box.structures:
            raise BoxError(f"{STRUCTURE} must be one of {'; '.join(box.structures)}, got {structure!r}", STRUCTURE)
        law["b"], law["c"] = box.structures[structure]
    pv_filter = checks.optional_time(PV_FILTER, values.get(PV_FILTER, 0.0))
    found = _LAWS[box.form].back(law, box)
    if pv_filter and found.tau_F:
        raise BoxError(
            f"{PV_FILTER} must be 0 beside the filter of {box.title} itself, got {pv_filter:g}: "
            "a controller has one filter here",
            PV_FILTER,
            pv_filter,
            0.0,
        )
    found = replace(found, tau_F=pv_filter) if pv_filter else found
    return found.rescaled(Fraction(1, seconds), sign)


class _IdealOrParallel:
    """Kp + Ki/s + Kd s/(Tf s + 1), by its times or by its gains."""

    def forward(self, design: Controller, box: Box, N: float | None) -> tuple[Quantities, float, list[str]]:
        """Quantities of the law, time of a PV filter, warnings."""
        whole, warnings = design.to_parallel(), []
        if box.form == "ideal" or (box.filter in ("ratio", "fixed") and whole.Kd):
            design.to_ideal()  # raises FormError
        plain, tau_F = replace(whole, tau_F=0.0), whole.tau_F
        if box.filter == "none" or not whole.Kd:
            own, pv_filter = derivative_filtered(plain), tau_F
        elif box.filter == "time":
            own, pv_filter = derivative_filtered(whole), 0.0
            if own is None:
                own, pv_filter = derivative_filtered(plain), tau_F
        else:
            own, pv_filter = self._with_ratio(whole, box, N, warnings), 0.0
        law = {"gain": own.Kp, "Ki": own.Ki, "Kd": own.Kd, "Tf": own.Tf, "b": own.b, "c": own.c, "factor": 1.0}
        if own.Kp:
            law |= {"Ti": own.Kp / own.Ki if own.Ki else math.inf, "Td": own.Kd / own.Kp}
        if box.N:
            law["N"] = own.Kd / own.Kp / own.Tf if own.Tf else box.N
        return law, pv_filter, warnings

    def _with_ratio(self, whole: ParallelPid, box: Box, N: float | None, warnings: list[str]) -> DerivativeFiltered:
        """The design behind the filter that the box can have, that of the design if there is a choice."""
        if box.filter == "ratio" and N is None and whole.tau_F:
            own = derivative_filtered(whole)
            if own is not None and own.Kd:
                N = _within(box, own.Kd / own.Kp / own.Tf)
                if N is None:
                    return own
            else:
                N = _smallest(box)
        N = N or box.N
        tau_F = fixed_ratio_filter(whole, N)
        if tau_F is None:
            needed = 4 * whole.Kd * whole.Ki / whole.Kp**2 - 1
            raise BoxError(f"N must be >= 4 tau_D/tau_I - 1 = {needed:g} in {box.title}, got {N:g}", "N", N, needed)
        if abs(tau_F - whole.tau_F) > SAME * tau_F:
            warnings.append(
                f"the filter of the box, N = {N:g}, makes tau_F = {tau_F:g} s, the design has {whole.tau_F:g} s"
            )
        return derivative_filtered(replace(whole, tau_F=tau_F))

    def back(self, law: Quantities, box: Box) -> Controller:
        """The controller that quantities of the law make."""
        factor, Kp = law.get("factor", 1.0), law["gain"]
        Ki = law["Ki"] if "Ki" in law else Kp / law.get("Ti", math.inf)
        Kd = law["Kd"] if "Kd" in law else Kp * law.get("Td", 0.0)
        Tf = law.get("Tf", 0.0)
        if box.filter in ("ratio", "fixed") and Kd:
            if not Kp:
                raise BoxError(f"{box.title} filters D by a ratio to P, which must not be 0 then, got 0", "", 0.0)
            Tf = Kd / Kp / law.get("N", box.N)
        own = DerivativeFiltered(factor * Kp, factor * Ki, factor * Kd, Tf, law.get("b", 1.0), law.get("c", 0.0))
        whole = whole_filtered(own)
        return whole.to_ideal() if box.form == "ideal" else whole


class _Series:
    """Kc (1 + 1/(Ti s)) (Td s + 1)/(Tf s + 1), Tf = Td/N."""

    def forward(self, design: Controller, box: Box, N: float | None) -> tuple[Quantities, float, list[str]]:
        """Quantities of the law, time of a PV filter, warnings."""
        series, warnings = design.to_series(), []
        tau_D, tau_F, pv_filter = series.tau_D, series.tau_F, 0.0
        if box.filter == "none" or not tau_D:
            ratio, pv_filter = box.N, tau_F
        else:
            ratio = self.ratio(series, tau_F) if tau_F else box.N
            chosen = box.N if box.filter == "fixed" else N or _within(box, ratio) or ratio
            made = self.filter_time(series.tau_I, tau_D, chosen)
            if abs(made - tau_F) > SAME * made:
                warnings.append(
                    f"the filter of the box, N = {chosen:g}, makes tau_F = {made:g} s, the design has {tau_F:g} s"
                )
            ratio = chosen
        law = {"gain": series.Kc, "Ti": series.tau_I, "Td": tau_D, "b": series.b, "c": series.c}
        return law | ({"N": ratio} if ratio else {}), pv_filter, warnings

    def ratio(self, series: SeriesPid, tau_F: float) -> float:
        """N that makes tau_F."""
        return series.tau_D / tau_F

    def filter_time(self, Ti: float, Td: float, N: float) -> float:
        """tau_F that N makes."""
        return Td / N

    def back(self, law: Quantities, box: Box) -> SeriesPid:
        """The controller that quantities of the law make."""
        Ti, Td = law.get("Ti", math.inf), law.get("Td", 0.0)
        tau_F = self.filter_time(Ti, Td, law.get("N", box.N)) if Td and box.filter != "none" else 0.0
        return SeriesPid(law["gain"], Ti, Td, tau_F, *self.weights(law, Ti, Td))

    def weights(self, law: Quantities, Ti: float, Td: float) -> tuple[float, float]:
        """b and c."""
        return law.get("b", 1.0), law.get("c", 0.0)


class _Interacting(_Series):
    """The same with Tf = 1/(N (1/Ti + 1/Td)), of PV only: u = Kc (1 + 1/(Ti s)) [r - (Td s + 1) PV]."""

    def ratio(self, series: SeriesPid, tau_F: float) -> float:
        return 1 / tau_F / (1 / series.tau_I + 1 / series.tau_D)

    def filter_time(self, Ti: float, Td: float, N: float) -> float:
        return 1 / N / (1 / Ti + 1 / Td)

    def weights(self, law: Quantities, Ti: float, Td: float) -> tuple[float, float]:
        return 1 / (1 + Td / Ti), 0.0


_LAWS = {
    "ideal": _IdealOrParallel(),
    "parallel": _IdealOrParallel(),
    "series": _Series(),
    "interacting": _Interacting(),
}


def _numbers(box: Box, law: Quantities, spans: Spans, round_off: bool, put: list[str] | None) -> dict[str, float | str]:
    """Typed numbers of the fields. The gain first: gains of I and D are for the gain that is typed.

    put: warnings about what was put to the nearest number; None where such a number is refused.
    """
    values: dict[str, float | str] = {}
    for field in box.fields:
        name = law_quantity(field)
        if name in ("b", "c"):
            continue
        number = field.off if law[name] == _off(field) and field.off is not None else typed(field, law[name], spans)
        exact = number
        try:
            if round_off and number != field.off:
                number = _nearest_off(field, on_the_safe_side(field, number))
                if name == "gain" and law[name] and not number:
                    raise BoxError(
                        f"{field.name} of {box.title} must be >= {field.step:g}, got {exact:g}",
                        field.name,
                        0.0,
                        field.step,
                    )
            _check(box, field, number)
        except BoxError as error:
            if put is None or math.isnan(error.nearest):
                raise
            number = error.nearest
            put.append(f"{field.name} = {exact:g} is beyond the range of the box: {number:g} is the nearest")
        if name == "gain" and law[name]:
            change = read(field, number, spans) / law[name]
            law = law | {gain: law[gain] * change for gain in ("gain", "Ki", "Kd") if gain in law}
        values[field.name] = number
    return values


def _nearest_off(field: Field, number: float) -> float:
    """Off, where that is nearer than the lowest number, for derivative action."""
    if field.quantity == "Td" and field.off == 0 and number < field.low:
        return 0.0 if number < field.low / 2 else field.low
    return number


def _with_structure(box: Box, values: dict, law: Quantities) -> tuple[dict, list[str]]:
    """Weights as numbers or as the nearest structure; a warning where the set-point response changes."""
    b, c = law["b"], law["c"] if law.get("Kd", law.get("Td")) else None
    if box.structures:

        def distance(name: str) -> float:
            have = box.structures[name]
            return abs(have[0] - b) + (abs(have[1] - c) if c is not None else 0.0)

        nearest = min(box.structures, key=distance)
        values = values | {STRUCTURE: nearest}
        b_box, c_box = box.structures[nearest]
    else:
        b_box, c_box = 1.0, 0.0
    for field in box.fields:
        name = law_quantity(field)
        if name in ("b", "c"):
            wanted = law[name] if name == "b" or c is not None else 0.0
            number = min(max(typed(field, wanted, Spans(1.0, 1.0)), field.low), field.high)
            values = values | {field.name: number}
            b_box, c_box = (read(field, number, Spans(1.0, 1.0)), c_box) if name == "b" else (b_box, number)
    far = abs(b_box - max(b, 0.0)) > SAME or (c is not None and abs(c_box - max(c, 0.0)) > SAME)
    if box.form == "interacting" or not far:
        return values, []
    return values, [
        f"the set-point weights are b = {b_box:g}, c = {c_box:g}: the margins stay, the set-point response not"
    ]


def _of_the_box(box: Box) -> list[str]:
    """What one should know of a box whatever is typed."""
    read_in = [] if box.verified == "maker" else [f"read in a text of a third party ({box.source}): check your manual"]
    return [*read_in, *(f"not read in any text, check your manual: {what}" for what in box.unread), *box.notes]


def _within(box: Box, N: float) -> float | None:
    """None if N can be typed, else the nearest that can."""
    field = box.field_of("N", "1/N")
    if field is None:
        return None
    number = N if field.quantity == "N" else 1 / N
    nearest = min(max(number, field.low), field.high)
    if abs(nearest - number) <= SAME * number:
        return None
    return nearest if field.quantity == "N" else 1 / nearest


def _smallest(box: Box) -> float:
    """The smallest N that can be typed: the most filtering."""
    field = box.field_of("N", "1/N")
    return (field.low if field.quantity == "N" else 1 / field.high) or box.N


def _check(box: Box, field: Field, number: float) -> None:
    """Raises BoxError where the box does not take `number`."""
    if number == field.off:
        return
    low, high = field.low, min(field.high, checks.LONGEST_TIME)
    nearest = min(max(number, low), high)
    zero = number == 0 and field.quantity in NEVER_ZERO
    if abs(number - nearest) <= SAME * abs(nearest) and not zero:
        return
    nearest = field.step or math.nan if zero else nearest
    bounds = "> 0" if zero and not low else f"from {low:g} to {high:g}"
    off = "" if field.off is None else f" ({field.off:g} is off)"
    there = "" if math.isnan(nearest) else f": the nearest is {nearest:g}"
    raise BoxError(
        f"{field.name} of {box.title} must be {bounds} {field.unit}".rstrip() + f"{off}, got {number:g}{there}",
        field.name,
        number,
        nearest,
    )


def _off(field: Field) -> float:
    """What the law has where an action is off."""
    return math.inf if law_quantity(field) == "Ti" else 0.0


def _carries_gain(field: Field) -> bool:
    return field.quantity in ("gain", "PB", "Ki", "1/Ki", "Kd")


def _with_sign(box: Box, name: str, value: float) -> float:
    """-value where the field carries the gain of the controller."""
    field = next(field for field in box.fields if field.name == name)
    return -value if _carries_gain(field) and value else value


def _box(key: str) -> Box:
    if key not in BOXES:
        raise InvalidParameter(f"key must be one of BOXES ({', '.join(BOXES)}), got {key!r}")
    return BOXES[key]


def _spans(pv_span: float, out_span: float) -> Spans:
    for name, span in (("pv_span", pv_span), ("out_span", out_span)):
        if checks.gain(name, span) < 0:
            raise InvalidParameter(f"{name} must be > 0, got {span:g}")
    return Spans(float(pv_span), float(out_span))


def _seconds(time_unit: str) -> int:
    if time_unit not in SECONDS:
        raise InvalidParameter(f"time_unit must be s or min, got {time_unit!r}")
    return SECONDS[time_unit]
