"""What a stretch of time does to the plant and to what its controller measures: the same for all tunings.

    w --> [ g ] --> y --> [ 1/(tau_F s + 1) ] --> p        w: input of the plant behind its dead time, y = g w

The controller sees p (y itself for tau_F = 0), its slope p' if it has derivative action, and its integral. On an
element of length h all signals are polynomials given at the P Radau nodes (elements.py), and integration from the
start of the element is the matrix K = h a. Each section of the chain (realisation.py) turns v into x by

    a x'' + b x' + c x = v     with W = x'':   (a + b K + c K^2) W = v - b x'_0 - c (x_0 + K x'_0)
           b x' + c x = v      with W = x':    (b + c K) W = v - c x_0

which is the collocation method of the whole chain. Columns of every map: (w at the nodes, x_0).
"""

import numpy as np

from simc_core.algebra.state_space import Row, sections
from simc_core.controllers.forms import needs_filter
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import factored_plant
from simc_core.plants.plant import Plant
from simc_core.simulation.collocation.elements import COLLOCATION
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P

SIGNALS = 4  # y, p, p', integral of p
EYE = np.eye(P)


class ProcessMaps:
    """The chain of plant and measurement filter, and its maps for any length.

    Raises InvalidParameter: derivative action without filter on a plant whose response starts with a jump.
    """

    def __init__(self, plant: Plant, tau_F: float, derivative: bool):
        factored = factored_plant(plant)
        self.gain, self.theta, self.tau_F = plant.k, plant.theta, tau_F
        self.sections = sections(factored)
        self.derivative = derivative
        self.n = sum(2 if den[0] else 1 for _, den in self.sections) + (tau_F > 0)
        if derivative and not tau_F and not self._strictly_proper():
            raise InvalidParameter(needs_filter("on a plant whose response starts with a jump"))
        filter_ = [-1 / tau_F] if tau_F else []
        self.modes = np.array([*factored.poles, *filter_])
        self.relative_degree = factored.relative_degree

    def _strictly_proper(self) -> bool:
        if not self.sections:
            return False
        (b2, b1, _), (a, _, _) = self.sections[-1]
        return (b2 if a else b1) == 0

    def elements(self, lengths: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Of single elements: signals (4, lengths, P, P + n) and states at the end (lengths, n, P + n)."""
        n, count = self.n, len(lengths)
        K = lengths[:, None, None] * COLLOCATION
        v, ends = np.zeros((count, P, P + n)), np.zeros((count, n, P + n))
        v[:, :, :P] = self.gain * EYE
        slope, used = np.zeros_like(v), 0
        for num, den in self.sections:
            v, slope, used = _section(num, den, K, v, ends, used)
        outputs = np.empty((SIGNALS, count, P, P + n))
        outputs[0] = v
        if self.tau_F:
            v, slope, used = _section((0.0, 0.0, 1.0), (0.0, self.tau_F, 1.0), K, v, ends, used)
        outputs[1], outputs[2], outputs[3] = v, slope, K @ v
        return outputs, ends


def _section(
    num: Row, den: Row, K: np.ndarray, v: np.ndarray, ends: np.ndarray, used: int
) -> tuple[np.ndarray, np.ndarray, int]:
    """One section: its output and the slope of it, and the next free state; the states at the end go into `ends`.

    The slope is right where the section is strictly proper.
    """
    (b2, b1, b0), (a, b, c) = num, den
    right, x_0 = v.copy(), P + used
    right[:, :, x_0] -= c
    if not a:
        W = np.linalg.solve(b * EYE + c * K, right) if c else right / b
        x = K @ W
        x[:, :, x_0] += 1.0
        ends[:, used] = x[:, -1]
        return (b0 * x + b1 * W if b1 else b0 * x), b0 * W, used + 1
    ramp = K.sum(axis=2)  # K applied to 1
    right[:, :, x_0 + 1] -= b + c * ramp
    W = np.linalg.solve(a * EYE + b * K + c * (K @ K), right)
    first = K @ W
    first[:, :, x_0 + 1] += 1.0
    x = K @ first
    x[:, :, x_0] += 1.0
    ends[:, used], ends[:, used + 1] = x[:, -1], first[:, -1]
    out = b0 * x + b1 * first + b2 * W if b1 or b2 else b0 * x
    return out, b0 * first + b1 * W, used + 2
