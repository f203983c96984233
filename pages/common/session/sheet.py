"""The loop sheet: what a loop is called, its units and ranges. Pure: no streamlit.

All of it may stay empty: times then have the user's own unit, unnamed, and u and y are deviations without unit.
Numbers of a design are in these units, so changing the time unit of a sheet converts the design (in_time_unit).
"""

import math
from dataclasses import dataclass
from fractions import Fraction

from simc_core import checks
from simc_core.errors import InvalidParameter
from simc_core.wording import said

TIME_UNITS = {"s": Fraction(1), "min": Fraction(60), "h": Fraction(3600), "ms": Fraction(1, 1000)}  # in seconds
LONGEST = {"tag": 40, "note": 500, "PV": 40, "PV_unit": 16, "OP": 40, "OP_unit": 16}  # characters


@dataclass(frozen=True, slots=True)
class Sheet:
    """Names, units and ranges of one loop.

    tag, note: for people.   time_unit: one of TIME_UNITS, "" for one that is not named.
    PV, PV_unit, PV_low, PV_high, PV_now: name, unit, range and present value of the measurement y.
    OP, OP_unit, OP_low, OP_high, OP_now: the same of the controller output u. None: not known.
    """

    tag: str = ""
    note: str = ""
    time_unit: str = ""
    PV: str = ""
    PV_unit: str = ""
    PV_low: float | None = None
    PV_high: float | None = None
    PV_now: float | None = None
    OP: str = ""
    OP_unit: str = ""
    OP_low: float | None = None
    OP_high: float | None = None
    OP_now: float | None = None

    def __post_init__(self):
        put = object.__setattr__
        for name, longest in LONGEST.items():
            put(self, name, _text(name, getattr(self, name), longest))
        if self.time_unit:
            checks.one_of("time_unit", self.time_unit, TIME_UNITS)
        for signal in ("PV", "OP"):
            for end in ("low", "high", "now"):
                name = f"{signal}_{end}"
                if getattr(self, name) is not None:
                    number = checks.real(name, getattr(self, name), -checks.LARGEST_GAIN, checks.LARGEST_GAIN)
                    put(self, name, number)
            low, high, now = (getattr(self, f"{signal}_{end}") for end in ("low", "high", "now"))
            if low is not None and high is not None and not low < high:
                raise InvalidParameter(
                    said(
                        "{signal}_high must be > {signal}_low = {low:g}, found {high:g}",
                        signal=signal,
                        low=low,
                        high=high,
                    )
                )
            least, most = (-math.inf if low is None else low), (math.inf if high is None else high)
            if now is not None and not least <= now <= most:
                raise InvalidParameter(
                    said(
                        "{signal}_now must be within {least:g} to {most:g}, found {now:g}",
                        signal=signal,
                        least=least,
                        most=most,
                        now=now,
                    )
                )

    @property
    def per_cent_of_span(self) -> float | None:
        """What a gain in OP units per PV unit is to be multiplied by to be in % of span per % of span."""
        spans = (self.PV_low, self.PV_high, self.OP_low, self.OP_high)
        if None in spans:
            return None
        return (self.PV_high - self.PV_low) / (self.OP_high - self.OP_low)

    @property
    def u_name(self) -> str:
        """What the input is called where its values are told: OP on its own scale, else u, a deviation."""
        return "u" if self.OP_now is None else "OP"

    def on_scale(self, u: float) -> float:
        """A deviation u as a value of OP; as it is where the operating point is not known."""
        return u if self.OP_now is None else float(f"{u + self.OP_now:.12g}")

    def off_scale(self, value: float) -> float:
        """The deviation u that a value of OP is."""
        return value - (self.OP_now or 0.0)

    @property
    def named(self) -> bool:
        """Whether anything has been filled in."""
        return self != Sheet()


def ratio(old: str, new: str) -> Fraction:
    """What times are multiplied by when the unit changes; 1 where one of them is not named."""
    if not old or not new:
        return Fraction(1)
    return TIME_UNITS[old] / TIME_UNITS[new]


def _text(name: str, given, longest: int) -> str:
    text = "".join(c if c.isprintable() else " " for c in str(given)).strip()
    return checks.text(name, text, longest)
