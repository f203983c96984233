"""From a quantity in seconds and in units of output and PV to the number that is typed, and back.

K% = K span_PV/span_OUT       PB% = 100/K%       PB in PV units = span_OUT/K
"""

import math
from dataclasses import dataclass

from simc_core.implementation.boxes.box import Field


def _inverse(value: float) -> float:
    return 1 / value if value else math.inf


def _rest(value: float) -> float:
    return 1 - value


# How a quantity is made of one of the law's own, and that one of it: each of the functions is its own inverse.
MADE_OF = {
    "PB": ("gain", _inverse),
    "1/Ti": ("Ti", _inverse),
    "1/Ki": ("Ki", _inverse),
    "1/N": ("N", _inverse),
    "1-b": ("b", _rest),
}
DOWN, UP, NEAREST = math.floor, math.ceil, round
SAFE_SIDE = {"gain": DOWN, "PB": UP, "Ti": UP, "1/Ti": DOWN, "Ki": DOWN, "1/Ki": UP}  # others to the nearest


@dataclass(frozen=True, slots=True)
class Spans:
    """Spans of PV and output, in their own units."""

    pv: float
    out: float

    def scale(self, field: Field) -> float:
        """Typed number of a quantity 1."""
        unit = {
            "%/%": self.pv / self.out,
            "%/PV": 100 / self.out,
            "%": 100 * self.out / self.pv,
            "units": self.out,
            "min": 1 / 60,
            "1/min": 60.0,
            "s": 1.0,
            "1/s": 1.0,
        }
        scale = math.prod(unit[part] for part in field.unit.split())
        return (1 / scale if field.quantity == "1/Ki" and "%/%" in field.unit else scale) / field.word


def law_quantity(field: Field) -> str:
    """Name of the law's own quantity that `field` stands for."""
    return MADE_OF.get(field.quantity, (field.quantity, None))[0]


def typed(field: Field, value: float, spans: Spans) -> float:
    """What is typed for a value of the law's own quantity."""
    if field.quantity in MADE_OF:
        value = MADE_OF[field.quantity][1](value)
    return value * spans.scale(field)


def read(field: Field, number: float, spans: Spans) -> float:
    """The value of the law's own quantity that a typed number stands for."""
    value = number / spans.scale(field)
    return MADE_OF[field.quantity][1](value) if field.quantity in MADE_OF else value


def on_the_safe_side(field: Field, number: float) -> float:
    """The number that can be typed on the safe side: gain down, band up, Ti up, Td to the nearest."""
    if field.step is None or not math.isfinite(number):
        return number
    steps = number / field.step
    near = round(steps)
    if abs(steps - near) > 1e-9 * max(abs(steps), 1.0):
        near = SAFE_SIDE.get(field.quantity, NEAREST)(steps)
    return float(f"{near * field.step:.12g}")
