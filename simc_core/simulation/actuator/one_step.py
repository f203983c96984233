"""A linear system over one time step.

x' = A x + B v,  o = C x + D v. Over a step of length dt the input is described by two numbers w = (w1, w2), in one of
two ways:

    ramp    v runs linearly from w1 to w2                        (a continuous controller, second order in dt)
    hold    v = w1 for dt - late, then w2 for the last `late`    (a sampled controller, exact)

    x after the step: Phi x + G1 w1 + G2 w2      o at its start: C x + D w1      at its end: C x_after + D w2

so jumps of the input stay jumps of the output.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

Step = tuple[np.ndarray, np.ndarray, np.ndarray]  # Phi, G1, G2
ON_GRID = 1e-6  # of a step; what is nearer than this to an instant of the grid is on it


def whole_steps(steps: float) -> int:
    """The least whole number >= steps and >= 1; what rounding adds to a whole number makes no further step."""
    return max(1, math.ceil(steps - ON_GRID))


@dataclass(frozen=True, slots=True, eq=False)
class Linear:
    """A (n, n), B (n,), C (o, n), D (o,): one input, several outputs."""

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    D: np.ndarray

    def ramp(self, dt: float) -> Step:
        """For an input that runs linearly over the step."""
        n = len(self.B)
        motion = np.zeros((n + 2, n + 2))
        motion[:n, :n], motion[:n, n], motion[n, n + 1] = self.A * dt, self.B * dt, 1.0
        whole = expm(motion)
        held, grown = whole[:n, n], whole[:n, n + 1]
        return whole[:n, :n], held - grown, grown

    def hold(self, dt: float) -> tuple[np.ndarray, np.ndarray]:
        """Phi, Gamma for a constant input."""
        n = len(self.B)
        motion = np.zeros((n + 1, n + 1))
        motion[:n, :n], motion[:n, n] = self.A * dt, self.B * dt
        whole = expm(motion)
        return whole[:n, :n], whole[:n, n]

    def late_hold(self, dt: float, late: float) -> Step:
        """For an input that changes `late` before the end of the step."""
        early, first = self.hold(dt - late)
        rest, second = self.hold(late)
        return rest @ early, rest @ first, second
