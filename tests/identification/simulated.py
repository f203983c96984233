"""Step tests whose truth is known, from closed forms alone: what identification is measured on."""

from dataclasses import dataclass

import numpy as np
from scipy.signal import lfilter

from simc_core import Trend

NOISES = (0.0, 0.005, 0.01, 0.02, 0.05, 0.1)


@dataclass(frozen=True)
class Truth:
    """k e^{-theta s}/(tau1 s + 1), and what was done to the record."""

    k: float
    theta: float
    tau1: float
    noise: float
    correlated: bool
    drift: bool
    unsettled: bool
    quantised: bool
    outliers: bool
    irregular: bool


def first_order(seed: int) -> tuple[Trend, Truth]:
    """theta/tau1 0.1 to 5, 1 to 3 steps, 40 to 2000 samples, noise 0 to 10 % of the response.

    30 % correlated over 0.3 tau1, 15 % each with drift, unsettled start, quantised PV, 10 % outliers, 20 % irregular.
    """
    chance = np.random.default_rng(seed)
    tau1 = 10 ** chance.uniform(0, 2)
    theta = tau1 * 10 ** chance.uniform(-1, np.log10(5))
    k = chance.choice([-1, 1]) * 10 ** chance.uniform(-1, 1)
    moves, n = chance.integers(1, 4), int(10 ** chance.uniform(np.log10(40), np.log10(2000)))
    before = (theta + tau1) * chance.uniform(0.3, 1)
    rests = theta + tau1 * chance.uniform(1.5, 5, moves)
    end = before + rests.sum()
    correlated, drift, unsettled, quantised, outliers, irregular = (
        bool(chance.random() < share) for share in (0.3, 0.15, 0.15, 0.15, 0.1, 0.2)
    )
    t = np.linspace(0, end, n)
    if irregular:
        t = np.sort(np.concatenate([[0.0], chance.uniform(0, end, n - 1)]))
    at = before + np.concatenate([[0.0], np.cumsum(rests)[:-1]])
    sizes = chance.choice([-1, 1], moves) * chance.uniform(0.5, 1.5, moves)
    y = sum(k * size * rise(t - s - theta, tau1) for size, s in zip(sizes, at, strict=True))
    response = float(np.ptp(y))
    noise = float(chance.choice(NOISES))
    y = y + noise * response * _noise(chance, n, end / n / (0.3 * tau1) if correlated else None)
    if drift:
        y = y + chance.uniform(-0.2, 0.2) * response * t / end
    if unsettled:
        y = y + chance.uniform(-0.3, 0.3) * response * np.exp(-t / tau1)
    if outliers:
        y = y + (chance.random(n) < 0.02) * chance.normal(size=n) * 0.5 * response
    if quantised:
        step = response * chance.choice([0.005, 0.01, 0.025])
        y = np.round(y / step) * step
    trend = Trend(t, 20 + y, np.concatenate([[0.0], np.cumsum(sizes)]), t_u=np.concatenate([[0.0], at]))
    truth = Truth(k, theta, tau1, noise, correlated, drift, unsettled, quantised, outliers, irregular)
    return trend, truth


def rise(t: np.ndarray, tau: float) -> np.ndarray:
    """1 - e^{-t/tau} from t = 0 on."""
    return -np.expm1(-np.maximum(t, 0.0) / tau)


def two_lags(t: np.ndarray, tau1: float, tau2: float) -> np.ndarray:
    """Step response of 1/((tau1 s + 1)(tau2 s + 1)), tau1 != tau2."""
    return (tau1 * rise(t, tau1) - tau2 * rise(t, tau2)) / (tau1 - tau2)


def ramp(t: np.ndarray) -> np.ndarray:
    """Step response of 1/s."""
    return np.maximum(t, 0.0)


def _noise(chance: np.random.Generator, n: int, decay: float | None) -> np.ndarray:
    white = chance.normal(size=n)
    if decay is None:
        return white
    kept = np.exp(-decay)
    white[1:] *= np.sqrt(1 - kept**2)
    return lfilter([1.0], [1.0, -kept], white)


def closed_loop(
    n: int,
    h: float,
    k: float,
    theta: float,
    tau1: float,
    Kc: float,
    tau_I: float,
    setpoint: np.ndarray,
    noise: np.ndarray,
    load: np.ndarray,
) -> Trend:
    """A sampled PI (tau_I inf: P) around k e^{-theta s}/(tau1 s + 1), OP held between samples of distance h.

    theta lies anywhere: the held OP that arrives in one interval has at most two values, each moved exactly. `load` is
    added to OP at the process, `noise` to the measurement.
    """
    y, u, state = np.zeros(n), np.zeros(n), 0.0
    late = int(np.ceil(theta / h))
    share = late * h - theta  # of an interval, the later part with the newer value
    old, new = np.exp(-(h - share) / tau1), np.exp(-share / tau1)
    integral = 0.0
    for i in range(n):
        if i:
            begun = u[i - late - 1] if i - late - 1 >= 0 else 0.0
            after = u[i - late] if i - late >= 0 and late else begun
            if late == 0:
                begun = after = u[i - 1]
            state = old * state + k * (1 - old) * (begun + load[i - 1])
            state = new * state + k * (1 - new) * (after + load[i - 1])
        y[i] = state + noise[i]
        error = setpoint[i] - y[i]
        u[i] = Kc * (error + integral)
        integral += error * h / tau_I
    return Trend(np.arange(n) * h, y, u, r=setpoint)
