"""The loop on one element: everything that differs between tunings, as one constant matrix for each.

    z = u + d,   u = f(t) + xi - Kp p - Kd p' - Ki int p        xi: the integral at the start of the element
    f = Kp b rF + Ki int rF + Kd c rF'                          rF: the step of r through the filter,
                                                                r (1 - e^{-t/tau_F}) + rF_0 e^{-t/tau_F}

With process_maps.py's maps p, p', int p are matrices times (w at the nodes, x_0), so the element is linear in w and

    x = (x_0, xi, r, d, rF_0)   (y, z at the nodes, their coefficients for step_control.py, x at the end) = G (w, x)

r and d are the steps themselves, which stay; rF_0 is there only with a filter.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from simc_core.controllers.forms import ParallelPid
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P
from simc_core.simulation.collocation.elements import TO_CHEBYSHEV
from simc_core.simulation.one_delay.element_sizes import EYE, Elements, ElementSizes
from simc_core.simulation.one_delay.process_maps import EVERY, SIGNALS, Chosen
from simc_core.simulation.one_delay.step_control import MIDDLE

SPECTRUM = TO_CHEBYSHEV[
    [MIDDLE - 1, MIDDLE, P - 2, P - 1]
]  # of nodal values: the coefficients that step_control.py goes by
Y, Z, END = slice(P), slice(P, 2 * P), 2 * P + 8  # rows of G; in between two middle ones of y and z, two last ones
PARTS = np.array([0, P, 2 * P, 2 * P + 2, 2 * P + 4, 2 * P + 6])


class OnLevel(NamedTuple):
    """Of n tunings. G: (n, END + size, P + size), see the module docstring.

    one_less, begun: 1 - B Z and B z_x, (n, P, P) and (n, P, size), for w = H + B z with z = Z w + z_x x.
    """

    G: np.ndarray
    one_less: np.ndarray
    begun: np.ndarray


class ClosedElements:
    """The controllers of n tunings, and what each level needs of them, made when it is needed.

    One plant for all of them, and one tau_F; or as many plants as tunings. units: of time, one a plant.
    """

    def __init__(self, forms: Sequence[ParallelPid], levels: ElementSizes, units: np.ndarray):
        self.levels = levels
        self.filtered, self.tau_F = levels.chain.filtered, levels.chain.tau_F[:, None]
        values = np.array([(form.Kp, form.Kd, form.Ki, form.Kp * form.b, form.Kd * form.c) for form in forms])
        values[:, [1, 4]] /= units[:, None]
        values[:, 2] *= units
        self.gains = values[:, : SIGNALS - 1]
        self.Ki, self.ahead, self.kick = values[:, 2:3], values[:, 3:4], values[:, 4:]
        self.size = levels.chain.n + 3 + self.filtered  # of x
        self._made: dict[int, OnLevel] = {}
        self._known: dict[int, np.ndarray] = {}  # which tunings a level is made for, where not for all

    def start(self) -> np.ndarray:
        """x at t = 0 for unit steps of r and of d, (n, size, 2)."""
        n = self.levels.chain.n
        x = np.zeros((len(self.gains), self.size, 2))
        x[:, n + 1, 0] = x[:, n + 2, 1] = 1.0
        return x

    def __getitem__(self, level: int) -> OnLevel:
        if level not in self._made:
            elements = self.levels[level]
            G = self._on(elements)
            back = elements.B[:, None] @ G[:, :, Z]
            made = map(OnLevel, G, EYE - back[..., :P], back[..., P:])
            self._made |= zip(elements.levels, made, strict=True)
        return self._made[level]

    def known(self, level: int, which: list[int], likely: Callable[[], list[int]]) -> OnLevel:
        """The level, right for the tunings `which` at least.

        likely: others that will need it; what plants of their own do is made for these at once, and for no more.
        """
        if self.levels.alone or (level in self._made and level not in self._known):
            return self[level]
        n, known = len(self.gains), self._known.get(level)
        if known is not None and known[which].all():
            return self._made[level]
        wanted = [i for i in sorted({*which, *likely()}) if known is None or not known[i]]
        if len(wanted) == n:
            self._made[level] = self._alone(level, EVERY)
            return self._made[level]
        if known is None:
            G = np.empty((n, END + self.size, P + self.size))
            self._made[level] = OnLevel(G, np.empty((n, P, P)), np.empty((n, P, self.size)))
            known = self._known[level] = np.zeros(n, dtype=bool)
        some = np.array(wanted)
        for own, made in zip(self._made[level], self._alone(level, some), strict=True):
            own[some] = made
        known[some] = True
        return self._made[level]

    def _alone(self, level: int, which: Chosen) -> OnLevel:
        """One level, made anew for some of the tunings."""
        elements = self.levels.of([level], which)
        G = self._on(elements, which)[0]
        back = elements.B[0] @ G[:, Z]
        return OnLevel(G, EYE - back[..., :P], back[..., P:])

    def _on(self, elements: Elements, which: Chosen = EVERY) -> np.ndarray:
        """G on each of the levels, (L, n, END + size, P + size), of the tunings `which`."""
        gains = self.gains[which]
        L, n, own = len(elements.levels), len(gains), P + self.levels.chain.n  # own: columns of the plant's maps
        xi, r, d, rF = range(own, own + 4)
        begin = END - P  # from the column to the row of each
        nodes, Ki, tau_F = elements.nodes[:, None], self.Ki[which], self.tau_F[which if len(self.tau_F) > 1 else EVERY]
        ahead, kick = self.ahead[which], self.kick[which]
        G = np.zeros((L, n, END + self.size, P + self.size))
        y, ends = elements.signals[0].swapaxes(0, 1), elements.ends.swapaxes(0, 1)  # (L, plants, ...)
        integral = elements.signals[3, :, :, -1].swapaxes(0, 1)
        G[:, :, Y, :own] = y
        G[:, :, Z, :own] = -_fed_back(gains, elements).swapaxes(0, 1)
        G[:, :, Z, xi] = G[:, :, Z, d] = 1.0
        G[:, :, Z, r] = ahead + Ki * nodes
        G[:, :, END : begin + own, :own] = ends
        G[:, :, begin + xi, :own] = -Ki * integral
        G[:, :, begin + xi, r] = Ki[:, 0] * elements.length[:, None]
        G[:, :, begin + xi, xi] = G[:, :, begin + r, r] = G[:, :, begin + d, d] = 1.0
        if self.filtered:
            late, risen = np.exp(nodes / -tau_F), -np.expm1(nodes / -tau_F)  # risen: 1 - late, without cancellation
            slope, gained = kick / tau_F * late, Ki * tau_F * risen
            G[:, :, Z, r] = ahead * risen + slope + Ki * nodes - gained
            G[:, :, Z, rF] = ahead * late - slope + gained
            G[:, :, begin + xi, r] -= gained[..., -1]
            G[:, :, begin + xi, rF] = gained[..., -1]
            G[:, :, begin + rF, r], G[:, :, begin + rF, rF] = risen[..., -1], late[..., -1]
        spectra = SPECTRUM @ G[:, :, : 2 * P].reshape(L, n, 2, P, -1)
        G[:, :, 2 * P : END] = spectra.reshape(L, n, 2, 2, 2, -1).swapaxes(2, 3).reshape(L, n, 8, -1)
        return G


def _fed_back(gains: np.ndarray, elements: Elements) -> np.ndarray:
    """Kp p + Kd p' + Ki int p at the nodes, (n, L, P, own)."""
    n, measured = len(gains), elements.signals[1:]
    if measured.shape[1] == 1:
        return (gains @ measured.reshape(SIGNALS - 1, -1)).reshape(n, *measured.shape[2:])
    Kp, Kd, Ki = gains.T[:, :, None, None, None]
    found = Kp * measured[0]
    if Kd.any():
        found += Kd * measured[1]
    found += Ki * measured[2]
    return found
