"""A gain schedule as a program has it: a table of 1/Kp, tau_I and tau_D, and straight lines between its rows.

    Kp = 1/band,    Ki = Kp/tau_I,    Kd = Kp tau_D         band, tau_I, tau_D: straight between rows, constant beyond

Where the schedule interpolates the model, rows are put between its own, so that straight lines come near to it. The
filter is one for all rows, that of the row with the shortest: programs take it as a constant.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from simc_core import checks
from simc_core.controllers.forms import IdealPid
from simc_core.errors import FormError, InvalidParameter
from simc_core.implementation.gain_schedule import GAIN_OF_PLANT, POINTS, GainSchedule
from simc_core.loops.loop import Loop
from simc_core.sensitivity.margins import margins_many
from simc_core.wording import said

MOST_PARTS = 20
PARTS = 5  # between two rows, where the model is interpolated


@dataclass(frozen=True, eq=False)
class ScheduleTable:
    """A table made of a gain schedule.

    Parameters
    ----------
    schedule : GainSchedule
        What it is made of.
    parts : int, optional
        Rows of the table for one of the schedule. None: 1 where the schedule interpolates 1/Kc, else 5.

    Raises
    ------
    InvalidParameter
        The settings of a row have no ideal form with integral action.

    Examples
    --------
    >>> from simc_core import FirstOrderDelay, GainSchedule, ScheduleTable
    >>> schedule = GainSchedule((20, 80), (FirstOrderDelay(1, 4, 20), FirstOrderDelay(5, 2, 8)), between="PB")
    >>> table = ScheduleTable(schedule)
    >>> table.band, round(table.settings(50).Kc, 4)  # 1/((0.4 + 2.5)/2)
    ((0.4, 2.5), 0.6897)
    """

    schedule: GainSchedule
    parts: int | None = None

    def __post_init__(self) -> None:
        if self.parts is not None:
            checks.whole("parts", self.parts, 1, MOST_PARTS)
        _ = self._rows  # which has bounds of its own

    @cached_property
    def x(self) -> tuple[float, ...]:
        """Scheduling values of the rows."""
        values = self.schedule.values
        parts = self.parts or (1 if self.schedule.between == "PB" else PARTS)
        inside = [low + (high - low) * i / parts for low, high in pairwise(values) for i in range(parts)]
        return (*inside, values[-1])

    @property
    def band(self) -> tuple[float, ...]:
        """1/Kp of the rows."""
        return tuple(1 / row.Kc for row in self._rows)

    @property
    def tau_I(self) -> tuple[float, ...]:
        """Integral times of the rows, of the ideal form."""
        return tuple(row.tau_I for row in self._rows)

    @property
    def tau_D(self) -> tuple[float, ...]:
        """Derivative times of the rows, of the ideal form."""
        return tuple(row.tau_D for row in self._rows)

    @property
    def tau_F(self) -> float:
        """The filter of all rows."""
        return min(row.tau_F for row in self._rows)

    def settings(self, x: float) -> IdealPid:
        """The controller that a program has at x."""
        x = checks.real("x", x)
        band, tau_I, tau_D = (float(np.interp(x, self.x, row)) for row in (self.band, self.tau_I, self.tau_D))
        first = self._rows[0]
        return IdealPid(1 / band, tau_I, tau_D, self.tau_F, first.b, first.c)

    def peaks(self, gain: str = "linear", points: int = POINTS) -> tuple[np.ndarray, np.ndarray]:
        """Scheduling values and Ms there, as `GainSchedule.peaks`, of what a program does."""
        x = np.linspace(self.x[0], self.x[-1], checks.whole("points", points, 2, 10_000))
        found = margins_many([Loop(self.schedule.model(at, gain).plant, self.settings(at)) for at in x.tolist()])
        return x, np.array([each.Ms if each.stable else math.inf for each in found])

    def worst_Ms(self) -> float:
        """The largest of `peaks`, however the gain of the plant goes from row to row."""
        return max(float(self.peaks(gain)[1].max()) for gain in GAIN_OF_PLANT)

    @cached_property
    def _rows(self) -> tuple[IdealPid, ...]:
        rows = []
        for x in self.x:
            try:
                row = self.schedule.settings(x).to_ideal()
            except FormError as error:
                raise InvalidParameter(
                    said(
                        "settings must have an ideal form to be tabulated, found at {x:g}: {error}",
                        x=x,
                        error=str(error),
                    )
                ) from None
            if math.isinf(row.tau_I):
                raise InvalidParameter(
                    said("settings must have integral action to be tabulated, found none at {x:g}", x=x)
                )
            rows.append(row)
        return tuple(rows)
