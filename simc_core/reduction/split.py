"""Step B of the half rule: which lags the model keeps, and what the others add to the delay.

Without zeros nothing is lost: the delay and the lags of the model add up to those of the plant.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

from simc_core.plants.models import (
    DoubleIntegratingDelay,
    FirstOrderDelay,
    IntegratingDelay,
    Model,
    OscillatingDelay,
    SecondOrderDelay,
    UnstableDelay,
)
from simc_core.reduction.dynamics import Dynamics
from simc_core.reduction.zeros import Lag, LineInTheta, Removal


@dataclass(frozen=True, slots=True)
class Shape:
    """kept: names of the lags the model keeps, largest first.   absorber: what takes half of the next lag, or ""."""

    kept: tuple[str, ...]
    absorber: str


@dataclass(frozen=True, slots=True)
class TrialReduction:
    """The half rule carried out at one assumed theta; lines are valid until the nearest of `turning_points`.

    consistent: the delay that comes out is the one assumed.
    """

    removal: Removal
    shape: Shape
    theta: LineInTheta
    turning_points: tuple[float, ...]
    consistent: bool = True


def shape_of(parts: Dynamics, order: int, integrators: int) -> Shape:
    """What the model of `order` looks like; integrators: those the zeros have left."""
    if parts.pair or integrators == 2 or (parts.unstable and order == 1):
        return Shape((), "")
    if parts.unstable:
        return Shape(("tau2",), "tau2")
    if integrators:
        return Shape(("tau2",), "tau2") if order == 2 else Shape((), "integrator")
    return Shape(("tau1", "tau2"), "tau2") if order == 2 else Shape(("tau1",), "tau1")


def delay_of(parts: Dynamics, lags: Iterable[Lag], shape: Shape, late: float) -> LineInTheta:
    """Effective delay of the half rule for `lags`, largest first."""
    rest = [lag.tau for lag in list(lags)[len(shape.kept) :]]
    weights = [0.5 if shape.absorber and i == 0 else 1.0 for i in range(len(rest))]
    return LineInTheta(
        math.fsum(
            [parts.theta, *parts.inverse, late / 2, *(w * line.at for w, line in zip(weights, rest, strict=True))]
        ),
        math.fsum(w * line.slope for w, line in zip(weights, rest, strict=True)),
    )


def resolved(trial: TrialReduction, theta: float) -> TrialReduction:
    """The trial with its lines replaced by their values at theta."""
    lags = tuple([Lag(lag.index, LineInTheta(lag.tau(theta))) for lag in trial.removal.lags])
    return TrialReduction(replace(trial.removal, lags=lags), trial.shape, LineInTheta(trial.theta(theta)), ())


def model_of(parts: Dynamics, trial: TrialReduction) -> Model:
    """The reduced model of a resolved trial."""
    k, theta = parts.k * trial.removal.gain, _tidy(trial.theta.at, parts)
    lags = [lag.tau.at for lag in trial.removal.lags]
    kept = lags[: len(trial.shape.kept)] + [0.0] * (len(trial.shape.kept) - len(lags))
    if kept and len(lags) > len(kept):
        kept[-1] += lags[len(kept)] / 2
    if parts.pair:
        return OscillatingDelay(k, theta, *parts.pair)
    if parts.unstable:
        return UnstableDelay(-k / parts.unstable, theta, 1 / parts.unstable, *kept)
    if trial.removal.integrators == 2:
        return DoubleIntegratingDelay(k, theta)
    if trial.removal.integrators:
        return IntegratingDelay(k, theta, *kept)
    if len(kept) == 2 and kept[0]:
        return SecondOrderDelay(k, theta, max(kept), min(kept))
    return FirstOrderDelay(k, theta, kept[0])


def _tidy(theta: float, parts: Dynamics) -> float:
    """theta without the rounding of its own sum: what is left of a difference may be -1e-17."""
    return theta if theta > 1e-14 * (parts.theta + sum(parts.lags)) else 0.0
