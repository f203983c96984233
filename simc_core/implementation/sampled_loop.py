"""The loop transfer function of a plant under a sampled controller, exact for any dead time, and its verdict.

With theta = (d + f) h, 0 <= f < 1, x' = A x + B u, y = C x + D u, and u held between samples

    x+ = Phi x + Gnew u[k-d] + Gold u[k-d-1]       y[k] = C x[k] + D u[k-d-1]   (just before the sample)
    Gnew = int_0^{(1-f)h} e^{As} B ds              Gold = e^{A(1-f)h} int_0^{fh} e^{As} B ds
    G_d(z) = C (zI - Phi)^-1 (Gnew z^-d + Gold z^-(d+1)) + D z^-(d+1),        L = G_d C_d

C_d: controllers/discrete.py. The closed loop has as many poles outside a circle just beyond |z| = 1 as L has there,
less the turns of 1 + L about 0 along it [argument principle].
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from simc_core.algebra.state_space import chain
from simc_core.controllers.discrete import LAWS
from simc_core.controllers.forms import ParallelPid
from simc_core.loops.loop import Loop
from simc_core.simulation.actuator.one_step import Linear

SAME_INSTANT = 1e-9  # relative; a dead time closer than this to a multiple of h is one
MOST_PERIODS = 10_000  # of sampling in a dead time
RIM = 1e-9  # of log|z|, to the circle that counts poles: those on |z| = 1, integrators, lie within
SMALLEST_ANGLE = RIM / 100
PER_DECADE = 40  # nodes of small angles
PER_TURN = 16  # nodes in which the dead time turns L once
LARGEST_TURN = 1.0  # radians that 1 + L may turn from node to node
HALVINGS = 60


@dataclass(frozen=True, eq=False)
class SampledLoop:
    """`loop` under its controller sampled with period h by `law`, u written out `delay_scans` samples late."""

    loop: Loop
    h: float
    law: str = "backward"
    delay_scans: int = 0

    @cached_property
    def _plant(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, float, int]:
        """Phi, Gnew, Gold, C, D, d."""
        theta = self.loop.plant.theta + self.delay_scans * self.h
        d = math.floor(theta / self.h * (1 + SAME_INSTANT))
        A, B, C, D = chain(self.loop.plant.factored)
        Phi, Gold, Gnew = Linear(A, B, C, np.array(D)).late_hold(self.h, self.h - max(theta - d * self.h, 0.0))
        return Phi, Gnew, Gold, C, D, d

    def L(self, log_z: np.ndarray) -> np.ndarray:
        """L(e^{log_z}), shape (n,)."""
        Phi, Gnew, Gold, C, D, d = self._plant
        z, back = np.exp(log_z), np.exp(-log_z)
        row = np.linalg.solve(
            z[:, None, None] * np.eye(len(C)) - Phi.T, np.broadcast_to(C[:, None], (len(z), len(C), 1))
        )
        new, old = (row[..., 0] @ np.stack([Gnew, Gold], axis=1)).T
        G = np.exp(-d * log_z) * (new + back * (old + D))
        return G * LAWS[self.law].response(self._pid, self.h, log_z)

    def sensitivity(self, angles: np.ndarray) -> np.ndarray:
        """|S| at omega h = angles, shape (n,)."""
        return np.abs(1 / (1 + self.L(1j * angles)))

    def later(self, more: float) -> "SampledLoop":
        """The same with an additional dead time."""
        plant = self.loop.plant
        return replace(self, loop=replace(self.loop, plant=replace(plant, theta=plant.theta + more)))

    @property
    def direct(self) -> bool:
        """Whether a jump of u is a jump of y, a dead time later."""
        return self._plant[4] != 0

    @cached_property
    def _pid(self) -> ParallelPid:
        return self.loop.controller.to_parallel()

    @cached_property
    def angles(self) -> np.ndarray:
        """omega h from next to nothing to pi, dense where L turns: by its dead time, and at resonances of the plant."""
        d = self._plant[-1]
        small = np.geomspace(SMALLEST_ANGLE, 0.1, 1 + round(PER_DECADE * math.log10(0.1 / SMALLEST_ANGLE)))
        nodes = [small, np.linspace(0.1, math.pi, 1000 + PER_TURN * (d + 1))]
        offsets = np.concatenate([-np.geomspace(100, 0.01, 41), [0.0], np.geomspace(0.01, 100, 41)])
        for pole in np.linalg.eigvals(chain(self.loop.plant.factored)[0]):
            if pole.imag > 0:
                near = pole.imag * self.h + max(abs(pole.real) * self.h, SAME_INSTANT) * offsets
                nodes.append(np.abs((near + math.pi) % math.tau - math.pi))
        found = np.unique(np.concatenate(nodes))
        return found[(found >= SMALLEST_ANGLE) & (found <= math.pi)]

    @property
    def stable(self) -> bool:
        """Whether no closed-loop pole lies outside the unit circle."""
        log_z = RIM + 1j * np.concatenate([[0.0], self.angles])
        values = 1 + self.L(log_z)
        for _ in range(HALVINGS):
            turn = np.angle(values[1:] / values[:-1])
            far = np.flatnonzero(np.abs(turn) > LARGEST_TURN)
            if not far.size:
                break
            middle = (log_z[far] + log_z[far + 1]) / 2
            log_z = np.insert(log_z, far + 1, middle)
            values = np.insert(values, far + 1, 1 + self.L(middle))
        else:
            return False  # 1 + L passes through 0 on the circle itself
        unstable = int(np.sum(np.linalg.eigvals(chain(self.loop.plant.factored)[0]).real * self.h > RIM))
        return unstable == round(float(turn.sum()) / math.pi)
