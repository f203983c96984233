"""What the controllers of a march do on one element: everything that differs between tunings of a plant.

    z = u + d,   u = f(t) + xi - Kp p - Kd p' - Ki int p        xi: the integral at the start of the element
    f = Kp b rF + Ki int rF + Kd c rF'                          rF = 1 - e^{-t/tau_F}, a unit step through the filter

With measured.py's maps p, p', int p are matrices times (x_0, w at the nodes); so is, with the gains, what is fed back.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simc_core.controllers import ParallelPid
from simc_core.simulation.elements import P
from simc_core.simulation.levels import Levels
from simc_core.simulation.measured import SIGNALS

FORGOTTEN = 40.0  # time constants of the filter after which the step has gone through it
R, D = 0, 1  # columns: unit step of r, unit step of d


@dataclass(frozen=True, slots=True, eq=False)
class OnLevel:
    """Of all n tunings. feedback: (n, P, n_x + P), (x_0, w) -> Kp p + Kd p' + Ki int p at the nodes.

    forward: (n, P, 2), f + d for a step that has gone through the filter.   late: (n, P), times e^{-t/tau_F} what f
    still lacks.
    """

    feedback: np.ndarray
    forward: np.ndarray
    late: np.ndarray | None


class Law:
    """The controllers of n tunings with one tau_F, and what each level needs of them, made when it is needed."""

    def __init__(self, forms: Sequence[ParallelPid], levels: Levels):
        self.levels, self.tau_F = levels, forms[0].tau_F
        self.gains = np.array([(form.Kp, form.Kd, form.Ki) for form in forms])
        self.Ki = self.gains[:, 2, None]
        self.ahead = np.array([[form.Kp * form.b] for form in forms])  # proportional action on the set point
        self.kick = np.array([[form.Kd * form.c] for form in forms])
        self._made: dict[int, OnLevel] = {}

    def __getitem__(self, level: int) -> OnLevel:
        made = self._made.get(level)
        if made is None:
            made = self._made[level] = self._on(level)
        return made

    def _on(self, level: int) -> OnLevel:
        element, n = self.levels[level], len(self.gains)
        back = element.signals[P : SIGNALS * P]
        feedback = (self.gains @ back.reshape(SIGNALS - 1, -1)).reshape(n, P, back.shape[1])
        forward = np.empty((n, P, 2))
        forward[:, :, R] = self.ahead + self.Ki * element.nodes
        forward[:, :, D] = 1.0
        late, tau_F = None, self.tau_F
        if tau_F:
            fall = np.exp(element.nodes / -tau_F)
            late = (self.kick / tau_F - self.ahead) * fall - self.Ki * tau_F * (1 - fall)
        return OnLevel(feedback, forward, late)

    def known(self, at, level: int, begin: list[float], xi: np.ndarray) -> np.ndarray:
        """All of z that does not come back from the plant, (k, P, 2), on an element that begins at `begin` with xi."""
        on = self[level]
        known = on.forward[at] + xi[:, None]
        if self._unsettled(begin):
            known[:, :, R] += np.exp(np.array(begin) / -self.tau_F)[:, None] * on.late[at]
        return known

    def integral(self, at, begin: list[float], xi: np.ndarray, length: float, of_p: np.ndarray) -> np.ndarray:
        """xi at the end of the element, (k, 2): + Ki (int rF - int p)."""
        gained = -of_p
        gained[:, R] += length
        if self._unsettled(begin):
            gained[:, R] += self.tau_F * math.expm1(-length / self.tau_F) * np.exp(np.array(begin) / -self.tau_F)
        return xi + self.Ki[at] * gained

    def _unsettled(self, begin: list[float]) -> bool:
        """Whether something of the step has not gone through the filter yet."""
        return self.tau_F > 0 and min(begin) < FORGOTTEN * self.tau_F
