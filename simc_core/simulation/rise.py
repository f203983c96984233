"""What a set point or a load does over time: it rises from 0 at t = 0 to 1, at once or evenly."""

import numpy as np


def risen(t: np.ndarray, ramp: float) -> np.ndarray:
    """A ramp that reaches 1 at t = ramp; for ramp = 0 a step, right-hand limit."""
    return np.clip(t / ramp, 0.0, 1.0) if ramp else np.where(t >= 0, 1.0, 0.0)


def mean_risen(t: np.ndarray, dt: float, ramp: float) -> np.ndarray:
    """The mean of a ramp, ramp > 0, from t to t + dt."""

    def area(at: np.ndarray) -> np.ndarray:
        on_the_way = np.clip(at, 0.0, ramp)
        return on_the_way**2 / (2 * ramp) + np.maximum(at - ramp, 0.0)

    return (area(t + dt) - area(t)) / dt
