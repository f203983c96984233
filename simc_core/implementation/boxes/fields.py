"""The numbers of the fields of a box: made from the quantities of its law, within range, rounded, with sign, or off."""

import math
from collections.abc import Mapping

from simc_core import checks
from simc_core.errors import BoxError
from simc_core.implementation.boxes.box import STRUCTURE, Box, Field
from simc_core.implementation.boxes.laws import SAME_NUMBER, Quantities
from simc_core.implementation.boxes.units import Spans, law_quantity, on_the_safe_side, read, typed
from simc_core.wording import Numeral, Text, said

NEVER_ZERO = ("PB", "Ti", "N", "1/N", "factor")  # but where 0 is off


def numbers(box: Box, law: Quantities, spans: Spans, round_off: bool, put: list[Text] | None) -> dict[str, float]:
    """Typed numbers of the fields. The gain first: gains of I and D are for the gain that is typed.

    put: warnings about what was put to the nearest number; None where such a number is refused.
    """
    values: dict[str, float] = {}
    for field in box.fields:
        name = law_quantity(field)
        if name in ("b", "c"):
            continue
        number = (
            field.off if law[name] == off_value(field) and field.off is not None else typed(field, law[name], spans)
        )
        exact = number
        try:
            if round_off and number != field.off:
                number = _nearest_off(field, on_the_safe_side(field, number))
                if name == "gain" and law[name] and not number:
                    assert field.step is not None  # else nothing was rounded
                    raise BoxError(
                        said(
                            "{field} of {box} must be >= {step:g}, found {exact:g}",
                            field=field.name,
                            box=box.title,
                            step=field.step,
                            exact=exact,
                        ),
                        field.name,
                        0.0,
                        field.step,
                    )
            check(box, field, number)
        except BoxError as error:
            if put is None or math.isnan(error.nearest):
                raise
            number = error.nearest
            put.append(
                said(
                    "{field} = {exact:g} is beyond the range of the box: {number:g} is the nearest",
                    field=field.name,
                    exact=exact,
                    number=number,
                )
            )
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


def with_structure(
    box: Box, numbers: Mapping[str, float], law: Quantities
) -> tuple[dict[str, float | str], list[Text]]:
    """Weights as numbers or as the nearest structure; a warning where the set-point response changes."""
    values: dict[str, float | str] = {**numbers}
    b, c = law["b"], law["c"] if law.get("Kd", law.get("Td")) else None
    if box.structures:

        def distance(name: str) -> float:
            have = box.structures[name]
            return abs(have[0] - b) + (abs(have[1] - c) if c is not None else 0.0)

        nearest = min(box.structures, key=distance)
        values[STRUCTURE] = nearest
        b_box, c_box = box.structures[nearest]
    else:
        b_box, c_box = 1.0, 0.0
    for field in box.fields:
        name = law_quantity(field)
        if name in ("b", "c"):
            wanted = law[name] if name == "b" or c is not None else 0.0
            number = min(max(typed(field, wanted, Spans(1.0, 1.0)), field.low), field.high)
            values[field.name] = number
            b_box, c_box = (read(field, number, Spans(1.0, 1.0)), c_box) if name == "b" else (b_box, number)
    far = abs(b_box - max(b, 0.0)) > SAME_NUMBER or (c is not None and abs(c_box - max(c, 0.0)) > SAME_NUMBER)
    if box.form == "interacting" or not far:
        return values, []
    return values, [
        said(
            "the set-point weights are b = {b:g}, c = {c:g}: the margins stay, the set-point response not",
            b=b_box,
            c=c_box,
        )
    ]


def check(box: Box, field: Field, number: float) -> None:
    """Raises BoxError where the box does not take `number`."""
    if number == field.off:
        return
    low, high = field.low, min(field.high, checks.LONGEST_TIME)
    nearest = min(max(number, low), high)
    zero = number == 0 and field.quantity in NEVER_ZERO
    if abs(number - nearest) <= SAME_NUMBER * abs(nearest) and not zero:
        return
    nearest = field.step or math.nan if zero else nearest
    why = said(
        "{field} of {box} must be {bounds}, found {number:g}",
        field=field.name,
        box=box.title,
        bounds=_bounds(field, zero and (not low), low, high),
        number=number,
    )
    if not math.isnan(nearest):
        why = said("{why}: the nearest is {nearest:g}", why=why, nearest=nearest)
    raise BoxError(why, field.name, number, nearest)


def _bounds(field: Field, positive: bool, low: float, high: float) -> str:
    """What may be typed, with its unit, and what stands for off."""
    bounds: str = Numeral(f"> 0 {field.unit}".rstrip())
    if not positive:
        bounds = said("from {low:g} to {high}", low=low, high=Numeral(f"{high:g} {field.unit}".rstrip()))
    return bounds if field.off is None else said("{bounds} ({off:g} is off)", bounds=bounds, off=field.off)


def off_value(field: Field) -> float:
    """What the law has where an action is off."""
    return math.inf if law_quantity(field) == "Ti" else 0.0


def carries_gain(field: Field) -> bool:
    return field.quantity in ("gain", "PB", "Ki", "1/Ki", "Kd")


def with_sign(box: Box, name: str, value: float) -> float:
    """-value where the field carries the gain of the controller."""
    field = next(field for field in box.fields if field.name == name)
    return -value if carries_gain(field) and value else value
