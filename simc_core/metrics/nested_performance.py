"""Step metrics of nested loops over an infinite horizon: of y_N and u_1, for unit steps of r and of every d_i."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simc_core.certificate.verdict import IN_WORDS, stability
from simc_core.errors import NotStable
from simc_core.loops.nested import NestedLoops
from simc_core.loops.on_demand import Later
from simc_core.metrics.step_metrics import Steps, metrics_of
from simc_core.metrics.step_quality import Known, known_of, quality_of_steps
from simc_core.metrics.step_records import StepMetrics, StepQuality
from simc_core.simulation.collocation.pieces import Pieces
from simc_core.simulation.several_delays.stepper import steps_of
from simc_core.simulation.simulate_nested import time_scale
from simc_core.wording import said

AT_REST = 1e-9  # of the largest value: less than that moves in the last quarter of the horizon
FIRST_HORIZON = 8.0  # first horizon, in units of all times of the loops together
MOST_DOUBLINGS = 12
STIFF_ROUNDING = 1e-7  # a stiff loop that comes no nearer to rest than this has reached its rounding errors
LARGEST_OFFSET = 1e-7  # of the largest value: with more at rest the integrals diverge


@dataclass(frozen=True, slots=True)
class NestedPerformance:
    """What is measured on the steps of nested loops.

    Attributes
    ----------
    setpoint : StepMetrics
        Unit step of r.
    disturbances : tuple of StepMetrics, N of them
        Unit steps of d_1 to d_N, from the inside out.
    """

    setpoint: StepMetrics
    disturbances: tuple[StepMetrics, ...]

    @property
    def disturbance(self) -> StepMetrics:
        """d_N, at the input of the outermost block: d1 of a cascade."""
        return self.disturbances[-1]

    @property
    def disturbance2(self) -> StepMetrics:
        """d_1, at the input of the innermost block: d2 of a cascade."""
        return self.disturbances[0]


def nested_performance(loop: NestedLoops) -> NestedPerformance:
    """performance of nested loops. Raises NotStable."""
    verdict = stability(loop)
    if verdict.verdict != "stable":
        raise NotStable(
            said(
                "step metrics exist for stable loops only, found a cascade that is {verdict}",
                verdict=IN_WORDS[verdict.verdict],
            )
        )
    pieces, N = _to_rest(loop), len(loop.blocks)
    y_and_u = pieces.coefficients[:, :, [N - 1, N]]
    _, right = Pieces(pieces.edges, y_and_u).ends()
    offset = np.abs(right[-1, 0] - np.array([1.0] + [0.0] * N))
    if np.any(offset > LARGEST_OFFSET * np.max(np.abs(right[:, 0]), axis=0)):
        raise NotStable(
            said("IAE needs loops that settle without offset, found {offset:.4g}", offset=float(np.max(offset)))
        )
    steps = metrics_of(_steps(pieces.edges, y_and_u))
    Later(_quality, loop, [known_of(step) for step in steps]).attach(steps)
    setpoint, *disturbances = steps
    return NestedPerformance(setpoint, tuple(disturbances))


def _quality(loop: NestedLoops, known: Sequence[Known]) -> list[StepQuality]:
    """What StepMetrics has on demand."""
    pieces, N = _to_rest(loop), len(loop.blocks)
    return quality_of_steps(_steps(pieces.edges, pieces.coefficients[:, :, [N - 1, N]]), known)


def _steps(edges: np.ndarray, y_and_u: np.ndarray) -> Steps:
    """Responses to r, d_1 .. d_N one after the other; y_and_u (m, P, 2, 1 + N)."""
    m, _, _, inputs = y_and_u.shape
    rows = y_and_u.transpose(2, 3, 0, 1).reshape(2, inputs * m, -1)
    owner = np.repeat(np.arange(inputs), m)
    begin, length = np.tile(edges[:-1], inputs), np.tile(np.diff(edges), inputs)
    return Steps(owner, begin, length, rows, m * np.arange(inputs), np.array([1.0] + [0.0] * (inputs - 1)))


def _to_rest(loop: NestedLoops) -> Pieces:
    steps, t_end, before = steps_of(loop), FIRST_HORIZON * time_scale(loop), np.inf
    for _ in range(MOST_DOUBLINGS):
        pieces = steps.run(t_end)
        left, right = pieces.ends()
        late = pieces.edges[1:] >= 0.75 * pieces.edges[-1]
        change = np.max(np.abs(np.stack([left[late], right[late]]) - right[-1]), axis=(0, 1))
        moving = float(np.max(change / (np.max(np.abs(right), axis=0) + 1e-300)))
        if moving <= AT_REST or before / 2 < moving <= STIFF_ROUNDING:
            return pieces
        before, t_end = moving, 2 * t_end
    raise NotStable(
        said(
            "the loops must come to rest within {t_end:.3g}, found ones too close to their stability limit", t_end=t_end
        )
    )
