"""Levenberg-Marquardt within bounds on the few parameters that are not linear."""

import numpy as np

from simc_core.identification.estimator.held_input import Array
from simc_core.identification.estimator.problem import Point, Problem

SETTLED = 1e-8  # relative gain of a round that is no gain


def refined(problem: Problem, x: Array, rounds: int = 30) -> Point:
    """The minimum of the sum of squares reached from x, by differences with the linear part projected out [GP73]."""
    best = problem.at(np.clip(x, problem.low, problem.high))
    damping = 1e-3
    for _ in range(rounds):
        full = problem.derivatives(best)
        jacobian = full - best.basis @ (best.basis.T @ full)
        gradient = jacobian.T @ best.residual
        held = ((best.x <= problem.low) & (gradient < 0)) | ((best.x >= problem.high) & (gradient > 0))
        square = jacobian.T @ jacobian
        square[held, :] = square[:, held] = 0.0
        size = np.diag(square).copy()
        size[size <= 0] = 1.0
        better = None
        for _ in range(5):
            step = np.linalg.solve(square + np.diag(damping * size + held), np.where(held, 0.0, gradient))
            tried = problem.at(np.clip(best.x + step, problem.low, problem.high))
            if tried.cost < best.cost:
                better = tried
                break
            damping *= 8
        if better is None:
            return best
        gain = best.cost - better.cost
        best = better
        damping = max(damping / 8, 1e-9)
        if gain <= SETTLED * best.cost:
            return best
    return best
