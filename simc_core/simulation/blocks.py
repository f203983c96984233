"""The plant over a whole block of time steps as one matrix.

x' = A x + B v,  o = C x + D v,  v(t) = u(t - theta) + d(t - theta), on a grid of step dt. Over one step the delayed
input is described by two numbers w = (w1, w2), in one of two ways:

    ramp    v runs linearly from w1 to w2                        (a continuous controller, second order in dt)
    hold    v = w1 for dt - late, then w2 for the last `late`    (a sampled controller, exact)

    x_{j+1} = Phi x_j + G1 w1_j + G2 w2_j
    o at the start of the step: C x_j + D w1_j       at its end: C x_{j+1} + D w2_j

so jumps of the input stay jumps of the output. steps stacked are one block Toeplitz matrix.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm


@dataclass(frozen=True, slots=True, eq=False)
class Linear:
    """A (n, n), B (n,), C (o, n), D (o,): one input, several outputs."""

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    D: np.ndarray

    def ramp(self, dt: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Phi, G1, G2 for an input that runs linearly over the step."""
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

    def late_hold(self, dt: float, late: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Phi, G1, G2 for an input that changes `late` before the end of the step."""
        early, first = self.hold(dt - late)
        rest, second = self.hold(late)
        return rest @ early, rest @ first, second


@dataclass(frozen=True, slots=True, eq=False)
class Blocks:
    """Up to `most` steps at once: (x, w) -> (o at starts and ends, x after); see the module docstring.

    outputs: (most, 2, o, n + 2 most).   states: (most + 1, n, n + 2 most), after 0, 1, ... steps.
    Columns: x, then w1_0, w2_0, w1_1, ...; what concerns fewer steps is the leading part.
    """

    outputs: np.ndarray
    states: np.ndarray

    @property
    def most(self) -> int:
        """Longest block."""
        return len(self.outputs)

    def __call__(self, x: np.ndarray, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Outputs (m, 2, o), at the start and at the end of each of m = len(w) steps, and the state after them."""
        m = len(w)
        known = np.concatenate([x, w.ravel()])
        o = self.outputs.shape[2]
        rows = self.outputs.reshape(-1, self.outputs.shape[-1])[: 2 * m * o, : len(known)]
        return (rows @ known).reshape(m, 2, o), self.states[m, :, : len(known)] @ known


def blocks(system: Linear, step: tuple[np.ndarray, np.ndarray, np.ndarray], most: int) -> Blocks:
    """Up to `most` steps of `system`, `step` = (Phi, G1, G2)."""
    Phi, G1, G2 = step
    n, o = len(system.B), len(system.D)
    states = np.zeros((most + 1, n, n + 2 * most))
    states[0, :, :n] = np.eye(n)
    outputs = np.zeros((most, 2, o, n + 2 * most))
    for j in range(most):
        here = n + 2 * j
        states[j + 1] = Phi @ states[j]
        states[j + 1, :, here] += G1
        states[j + 1, :, here + 1] += G2
        outputs[j] = system.C @ states[j : j + 2]
        outputs[j, 0, :, here] += system.D
        outputs[j, 1, :, here + 1] += system.D
    return Blocks(outputs, states)
