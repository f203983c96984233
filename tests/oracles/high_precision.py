"""Step responses of a loop in 75 digits: a method of steps in Taylor series. It shares no code with simc_core.

A loop is read as numbers (the fields of plant and controller); everything else is done here.

theta > 0. The plant input u + d is known one dead time ahead. Over a piece of length h = theta/m every signal is a
Taylor series in x = (t - edge)/h, held as fixed-point integers. A block N(s)/D(s) of order two is

    x1' = x2     d2 x2' = v - d0 x1 - d1 x2     out = n0 x1 + n1 x2 + n2 x2'        (N = n2 s^2 + n1 s + n0)

so the coefficients follow one from another, and the plant is a chain of such blocks, the controller one more:

    (Kd s^2 + Kp s + Ki)/(tau_F s^2 + s), once for -y and once, with weights b and c, for r.

Jumps are at k theta, which are edges. The highest coefficients are tested: they must be nothing.

theta = 0. Partial fractions of the closed loop, whose poles mpmath finds.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import zip_longest

import mpmath as mp

from simc_core import IController, Loop, ParallelPid, Plant

BITS = 256
ONE = 1 << BITS
REACH = 16  # largest |pole| h
CLOSED = 4.0  # |closed-loop pole| theta that is expected at least
NOTHING = 1 << (BITS - 94)  # 1e-28: what the highest coefficient of a series may be

Poly = tuple[Fraction, ...]  # ascending powers of s


def fixed(value: Fraction) -> int:
    """As a fixed-point integer."""
    return (value.numerator << BITS) // value.denominator


def exact(value: float) -> Fraction:
    """The number a double stands for."""
    return Fraction(float(value))


def multiply(p: Poly, q: Poly) -> Poly:
    """Product of two polynomials."""
    out = [Fraction(0)] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            out[i + j] += a * b
    return tuple(out)


def parallel(controller) -> tuple[Fraction, ...]:
    """Kp, Ki, Kd, tau_F, b, c of any form."""
    if isinstance(controller, IController):
        return Fraction(0), exact(controller.K_I), Fraction(0), Fraction(0), Fraction(1), Fraction(0)
    tau_F, b, c = exact(controller.tau_F), exact(controller.b), exact(controller.c)
    if isinstance(controller, ParallelPid):
        return exact(controller.Kp), exact(controller.Ki), exact(controller.Kd), tau_F, b, c
    Kc, tau_D = exact(controller.Kc), exact(controller.tau_D)
    Ki = Fraction(0) if math.isinf(controller.tau_I) else Kc / exact(controller.tau_I)
    series = type(controller).__name__ == "SeriesPid"
    return Kc + Ki * tau_D if series else Kc, Ki, Kc * tau_D, tau_F, b, c


def plant_factors(plant: Plant) -> tuple[list[Poly], list[Poly]]:
    """Numerator and denominator without k: factors of degree two, at most one of degree one at the end."""
    sides = []
    for times, pairs, origin in ((plant.leads, plant.lead_pairs, 0), (plant.lags, plant.lag_pairs, plant.integrators)):
        linear = [(Fraction(0), Fraction(1))] * origin + [(Fraction(1), exact(T)) for T in times]
        quadratic = [(Fraction(1), 2 * exact(zeta) * exact(T), exact(T) ** 2) for T, zeta in pairs]
        quadratic += [multiply(a, b) for a, b in zip(linear[::2], linear[1::2], strict=False)]
        sides.append(quadratic + ([linear[-1]] if len(linear) % 2 else []))
    return sides[0], sides[1]


class Block:
    """N(s)/D(s) from rest, see the module docstring."""

    def __init__(self, N: Poly, D: Poly, h: Fraction):
        self.N = [fixed(c) for c in (*N, 0, 0, 0)[:3]]
        self.h, D = h, (*D, Fraction(0), Fraction(0))[:3]
        self.order = max(i for i in range(3) if D[i])
        self.D = [fixed(c / D[self.order]) for c in D[: self.order]]
        self.over = fixed(1 / D[self.order])
        self.state = [0] * self.order

    def __call__(self, v: list[int], steps: list[int]) -> list[int]:
        """Series of the output for the series v of the input, over the next piece; steps: h/(j + 1)."""
        out = []
        slope = derivative(v, self.h) if self.order < 2 and self.N[2] else [0] * len(v)
        n0, n1, n2 = self.N
        alone = n1 == n2 == 0
        if self.order == 2:
            d0, d1 = self.D
            one, two = self.state
            over, sum1, sum2 = self.over, 0, 0
            for value, step in zip(v, steps, strict=True):
                sum1 += one
                sum2 += two
                rate = (over * value - d0 * one - d1 * two) >> BITS
                out.append(n0 * one >> BITS if alone else (n0 * one + n1 * two + n2 * rate) >> BITS)
                one, two = two * step >> BITS, rate * step >> BITS
            self.state = [sum1, sum2]
        elif self.order == 1:
            (d0,), (one,), over, sum1 = self.D, self.state, self.over, 0
            for value, rise, step in zip(v, slope, steps, strict=True):
                sum1 += one
                rate = (over * value - d0 * one) >> BITS
                bend = (over * rise - d0 * rate) >> BITS if n2 else 0
                out.append(n0 * one >> BITS if alone else (n0 * one + n1 * rate + n2 * bend) >> BITS)
                one = rate * step >> BITS
            self.state = [sum1]
        else:
            out = [n0 * (self.over * value >> BITS) >> BITS for value in v]
        return out


def derivative(series: list[int], h: Fraction) -> list[int]:
    """d/dt of a series in (t - edge)/h."""
    over = fixed(1 / h)
    return [(j + 1) * c * over >> BITS for j, c in enumerate(series[1:])] + [0]


@dataclass(frozen=True, slots=True, eq=False)
class UnitResponses:
    """y and u of a unit step: one series a piece, all pieces of length h from t = 0 on."""

    h: Fraction
    y: list[list[int]]
    u: list[list[int]]

    def at(self, t: float, left: bool = False) -> tuple[float, float]:
        """y and u at t, right-hand limits at jumps, or those from the left."""
        place = exact(t) / self.h
        piece = math.ceil(place) - 1 if left else math.floor(place)
        if piece < 0:
            return 0.0, 0.0
        x = fixed(place - piece)
        return to_float(value_at(self.y[piece], x)), to_float(value_at(self.u[piece], x))


def value_at(series: list[int], x: int) -> int:
    """Horner."""
    total = 0
    for c in reversed(series):
        total = c + (total * x >> BITS)
    return total


def to_float(value: int) -> float:
    """Back from fixed point, rounded once: Python divides integers exactly."""
    return value / ONE


def course(loop: Loop, load: bool, t_end: float, reach: float = REACH) -> UnitResponses:
    """Unit step of r (or of d) at t = 0 to t_end at least; theta > 0. reach: largest |pole| h of a piece."""
    Kp, Ki, Kd, tau_F, b, c = parallel(loop.controller)
    nums, dens = plant_factors(loop.plant)
    theta = exact(loop.plant.theta)
    fastest = max([*(1 / abs(T) for T in loop.plant.lags), *(1 / T for T, _ in loop.plant.lag_pairs), 0.0])
    fastest = max(fastest, 1 / float(tau_F) if tau_F else 0.0)
    m = max(math.ceil(fastest * theta / reach), 1)
    h = theta / m
    span = math.log(max(float(fastest * h), CLOSED))
    terms = next(n + 4 for n in range(1, 500) if n * span - math.lgamma(n + 1) < math.log(1e-60))
    steps = [fixed(h / (j + 1)) for j in range(terms)]
    blocks = [Block(N or (Fraction(1),), D, h) for N, D in zip_longest(nums, dens)]
    denominator = (Fraction(0), Fraction(1), tau_F)
    feedback = Block((Ki, Kp, Kd), denominator, h)
    forward = Block((Ki, b * Kp, c * Kd), denominator, h)
    k, r, d, none = fixed(exact(loop.plant.k)), ONE * (not load), ONE * load, [0] * (terms - 1)
    ys, us, largest = [], [], ONE
    for piece in range(math.floor(exact(t_end) / h) + 2):
        before = us[piece - m] if piece >= m else [-d, *none]  # u + d is zero before t = 0
        signal = [k * value >> BITS for value in (before[0] + d, *before[1:])]
        for block in blocks:
            signal = block(signal, steps)
        ahead, back = forward([r, *none], steps), feedback(signal, steps)
        us.append([one - other for one, other in zip(ahead, back, strict=True)])
        ys.append(signal)
        largest = max(largest, *map(abs, us[-1]))
        assert abs(us[-1][-2]) < NOTHING * (largest >> BITS), "too few terms"
    return UnitResponses(h, ys, us)


def without_delay(loop: Loop, load: bool) -> Callable[[float], tuple[float, float]]:
    """y and u of a unit step at t > 0 for theta = 0, distinct closed-loop poles, by partial fractions."""
    Kp, Ki, Kd, tau_F, b, c = parallel(loop.controller)
    nums, dens = plant_factors(loop.plant)
    N, D = (exact(loop.plant.k),), (Fraction(1),)
    for factor in nums:
        N = multiply(N, factor)
    for factor in dens:
        D = multiply(D, factor)
    C, Cr, Dc = (Ki, Kp, Kd), (Ki, b * Kp, c * Kd), (Fraction(0), Fraction(1), tau_F)
    if Ki == 0:
        C, Cr, Dc = C[1:], Cr[1:], Dc[1:]
    closed = added(multiply(D, Dc), multiply(N, C))
    tops = [multiply(N, Dc), tuple(-x for x in multiply(N, C))] if load else [multiply(N, Cr), multiply(D, Cr)]
    with mp.workdps(60):
        bottom = [Fraction(0), *closed[: max(i for i, x in enumerate(closed) if x) + 1]]
        poles = [mp.mpf(0), *mp.polyroots([real(x) for x in bottom[1:]], maxsteps=500, extraprec=500, asc=True)]
        gaps = [abs(p - q) / (abs(p) + abs(q)) for i, p in enumerate(poles) for q in poles[:i]]
        assert min(gaps) > 1e-10, "poles are not distinct"
        slope = [j * x for j, x in enumerate(bottom)][1:]
        residues = [[value(top, p) / value(slope, p) for p in poles] for top in tops]

    def at(t: float) -> tuple[float, float]:
        with mp.workdps(60):
            return tuple(
                float(mp.re(mp.fsum(R * mp.exp(p * t) for R, p in zip(row, poles, strict=True)))) for row in residues
            )

    return at


def added(p: Poly, q: Poly) -> Poly:
    """Sum of two polynomials."""
    return tuple(a + b for a, b in zip_longest(p, q, fillvalue=Fraction(0)))


def real(x: Fraction) -> mp.mpf:
    """As an mpmath number of the working precision."""
    return mp.mpf(x.numerator) / x.denominator


def value(p: Poly, s: mp.mpc) -> mp.mpc:
    """p(s), Horner."""
    total = mp.mpc(0)
    for c in reversed(p):
        total = total * s + real(c)
    return total
