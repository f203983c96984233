"""All crossings and peaks of a loop transfer function over frequency.

    gain crossings     |L| = 1                     log|L| = 0
    phase crossings    L real and negative         arg(-L) = 0
    peaks              |S|, |T| largest            d log|S|/d omega = -Re(T l') = 0,   d log|T|/d omega = Re(S l') = 0

with l = log L (module logresponse). They are bracketed by sign changes on a grid: GRID_PER_DECADE nodes per decade,
clusters at lightly damped roots, and steps of theta omega <= PHASE_STEP wherever |L| is large enough to matter.
Where it is not: |S| <= 1/(1 - |L|) and |T| <= |L|/(1 - |L|), so that a peak seen on the grid excludes all frequencies
with |L| below a level. A crossing hidden as a pair between two nodes is found by its extremum. All of them together
are then polished by bracketed Newton steps with the derivatives in closed form.

A loop with |L(inf)| near 1 never gets below the level: the grid ends at MOST_NODES, and beyond it 1/(1 - |L|)
itself is the peak, up to (theta omega)^-2.
"""

import math
from dataclasses import dataclass

import numpy as np

from simc_core.logresponse import Response, sensitivities

GRID_PER_DECADE = 24
PHASE_STEP = 0.3
MOST_NODES = 12_000
LIGHT = 0.35  # damping below which a root gets a cluster
CLUSTER = 1.5 ** np.arange(-4, 40)  # offsets from a resonance, in units of its half width
NARROWEST = 1e-7  # half width of an undamped root, relative
FLAT = 1e-10  # d log|S|/d log omega below which there is only rounding
QUADRATIC = 1e-9  # after a Newton step this small the next would be below rounding
STEPS = 60  # of the polishing; six are usual


@dataclass(frozen=True, slots=True, eq=False)
class Crossings:
    """Frequencies in ascending order, and what is there.

    gain: omega where |L| = 1, with the phase margin there, arg(-L) in (-pi, pi].
    phase: omega where L is real and negative, with |L| there.   S, T: omega of the peaks of |S| and |T|, and these.
    envelope: bounds of |S| and |T| beyond the grid, 0 if it reaches far enough.
    """

    gain_omega: np.ndarray
    gain_phase: np.ndarray
    phase_omega: np.ndarray
    phase_gain: np.ndarray
    S_omega: np.ndarray
    S_peak: np.ndarray
    T_omega: np.ndarray
    T_peak: np.ndarray
    envelope: tuple[float, float] = (0.0, 0.0)


def search(response: Response) -> Crossings:
    """Every crossing and peak at 0 < omega < inf that margins can depend on."""
    omega, logs, envelope = _nodes(response)
    values = _functions(*logs)
    resolved = response.theta * np.diff(omega) <= 1.01 * PHASE_STEP
    low, high, kind = _brackets(omega, values[0], resolved)
    hidden = _hidden(omega, *values)
    if hidden[0].size:
        extra = _brackets_at(response, hidden)
        low, high, kind = (np.concatenate(pair) for pair in zip((low, high, kind), extra, strict=True))
    found = _polished(response, low, high, kind)
    log, *_ = response.log_derivatives(found)
    arg, S, T = _from_negative(log), *sensitivities(log)
    gain = kind == GAIN
    phase = (kind == PHASE) & (np.abs(arg) < 1e-6) & (np.abs(log.real) < 100)  # not the jump at an undamped root
    order = np.argsort(found, kind="stable")

    def take(where, values):
        return values[order][where[order]]

    return Crossings(
        take(gain, found),
        take(gain, arg),
        take(phase, found),
        take(phase, np.exp(np.clip(log.real, -700, 700))),
        take(kind == S_PEAK, found),
        take(kind == S_PEAK, np.abs(S)),
        take(kind == T_PEAK, found),
        take(kind == T_PEAK, np.abs(T)),
        envelope,
    )


GAIN, PHASE, S_PEAK, T_PEAK = range(4)


def _from_negative(log: np.ndarray) -> np.ndarray:
    """arg(-L) in (-pi, pi]."""
    return -((-log.imag) % (2 * math.pi) - math.pi)


def _functions(log: np.ndarray, first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The four functions whose zeros are sought, shape (4, n), and their derivatives."""
    S, T = sensitivities(log)
    bend = T * S * first**2
    values = np.stack([log.real, _from_negative(log), -(T * first).real, (S * first).real])
    slopes = np.stack([first.real, first.imag, -(T * second + bend).real, (S * second - bend).real])
    return values, slopes


def _brackets(omega: np.ndarray, values: np.ndarray, resolved: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Intervals that hold a zero: ends and kind. Where the grid does not resolve the phase, only |L| is looked at."""
    left, right = values[:, :-1], values[:, 1:]
    holds = (left < 0) != (right < 0)
    holds[PHASE] &= np.abs(left[PHASE] - right[PHASE]) < math.pi  # arg(-L) = 0, not its jump at pi
    holds[S_PEAK:] &= (left[S_PEAK:] - right[S_PEAK:]) * omega[1:] > FLAT  # peaks, not valleys
    holds[PHASE:] &= resolved
    kind, at = np.nonzero(holds)
    return omega[at], omega[at + 1], kind


def _hidden(omega: np.ndarray, values: np.ndarray, slopes: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Intervals in which log|L| or arg(-L) turns round and may touch zero: ends and kind."""
    step = np.diff(omega)
    left, right, rise, fall = values[:2, :-1], values[:2, 1:], slopes[:2, :-1], slopes[:2, 1:]
    towards = (left * rise < 0) & (right * fall > 0) & (left * right > 0)
    near = (np.abs(left) < np.abs(rise) * step) | (np.abs(right) < np.abs(fall) * step)
    kind, at = np.nonzero(towards & near)
    return omega[at], omega[at + 1], kind


def _brackets_at(response: Response, hidden) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Brackets left and right of the extrema inside `hidden`, where these are beyond zero."""
    low, high, kind = hidden
    middle = _polished(response, low, high, kind, of_slope=True)
    outer, _ = _functions(*response.log_derivatives(low))
    inner, _ = _functions(*response.log_derivatives(middle))
    pick = np.arange(kind.size)
    beyond = inner[kind, pick] * outer[kind, pick] < 0
    low, middle, high, kind = low[beyond], middle[beyond], high[beyond], kind[beyond]
    return np.concatenate([low, middle]), np.concatenate([middle, high]), np.concatenate([kind, kind])


def _polished(response: Response, low, high, kind, of_slope: bool = False) -> np.ndarray:
    """Zeros inside the brackets to full precision: Newton, or bisection where Newton would leave the bracket.

    of_slope: zeros of the slope of log|L| and arg L instead (kinds GAIN and PHASE).
    """
    if not low.size:
        return low
    pick = np.arange(kind.size)

    def at(omega):
        logs = response.log_derivatives(omega)
        if of_slope:
            return np.stack([logs[1].real, logs[1].imag])[kind, pick], np.stack([logs[2].real, logs[2].imag])[
                kind, pick
            ]
        values, slopes = _functions(*logs)
        return values[kind, pick], slopes[kind, pick]

    low, high = low.copy(), high.copy()
    rising = at(low)[0] < 0
    omega = np.sqrt(low * high)
    for _ in range(STEPS):
        value, slope = at(omega)
        below = (value < 0) == rising
        low, high = np.where(below, omega, low), np.where(below, high, omega)
        with np.errstate(divide="ignore", invalid="ignore"):
            newton = omega - value / slope
        inside = (newton >= low) & (newton <= high)
        following = np.where(value == 0, omega, np.where(inside, newton, np.sqrt(low * high)))
        settled = (inside & (np.abs(following - omega) <= QUADRATIC * omega)) | (high - low <= 4e-16 * omega)
        omega = following
        if np.all(settled | (value == 0)):
            break
    return omega


def _nodes(response: Response):
    """Grid, log L with derivatives on it, and the envelope of |S| and |T| where the grid had to end early."""
    omega = _base_grid(response)
    logs = response.log_derivatives(omega)
    if not response.theta:
        return omega, logs, (0.0, 0.0)
    level, last = _level(response, omega, logs[0])
    size = logs[0].real
    matters = (np.maximum(size[:-1], size[1:]) >= level) | (omega[1:] <= last)
    pieces = np.where(matters, np.ceil(response.theta * np.diff(omega) / PHASE_STEP), 1).clip(1)
    within = np.cumsum(pieces) <= MOST_NODES
    beyond = ~within & matters
    pieces = np.where(within, pieces, 1).astype(int)
    if pieces.max() > 1:
        omega = _refined(omega, pieces)
        logs = response.log_derivatives(omega)
    x = np.exp(min(np.max(size[1:][beyond], initial=-math.inf), -1e-15))
    return omega, logs, (1 / (1 - x), x / (1 - x)) if beyond.any() else (0.0, 0.0)


def _level(response: Response, omega: np.ndarray, log: np.ndarray) -> tuple[float, float]:
    """log|L| below which nothing matters, and the frequency up to which everything does.

    Beyond the last gain crossing the phase falls by 2 pi within two turns of the dead time: there is a phase crossing.
    """
    S, T = sensitivities(log)
    Ms, Mt = np.max(np.abs(S)), np.max(np.abs(T))
    above = np.nonzero(log.real >= 0)[0]
    start = omega[above[-1]] if above.size else 0.0
    last = start + 4 * math.pi / response.theta
    at_last = float(np.interp(last, omega, log.real))
    return min(math.log1p(-1 / max(Ms, 1 + 1e-6)), math.log(Mt / (1 + Mt)), at_last), last


def _refined(omega: np.ndarray, pieces: np.ndarray) -> np.ndarray:
    """Interval i in pieces[i] equal parts."""
    index = np.arange(pieces.sum()) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    fine = np.repeat(omega[:-1], pieces) + np.repeat(np.diff(omega) / pieces, pieces) * index
    return np.append(fine, omega[-1])


def _base_grid(response: Response) -> np.ndarray:
    """Two decades beyond all corners at either end, clusters where the damping is light."""
    corners = list(np.abs(response.roots))
    for gain, power in (response.at_zero, response.at_infinity):
        if power:
            corners.append(abs(gain) ** (-1 / power))
    if response.theta:
        corners += [1 / response.theta, 4 * math.pi / response.theta]
    corners = np.array(corners or [1.0])
    first, last = 1e-2 * corners.min(), 1e2 * corners.max()
    grid = np.geomspace(first, last, 2 + int(GRID_PER_DECADE * math.log10(last / first)))
    upper = response.roots[response.roots.imag > 0]
    light = upper[np.abs(upper.real) < LIGHT * np.abs(upper)]
    if not light.size:
        return grid
    width = np.maximum(np.abs(light.real), NARROWEST * np.abs(light))
    offsets = width[:, None] * CLUSTER
    near = offsets < 0.5 * light.imag[:, None]
    centres = np.broadcast_to(light.imag[:, None], offsets.shape)
    cluster = np.concatenate([(centres - offsets)[near], (centres + offsets)[near]])
    return np.unique(np.concatenate([grid, cluster]))
