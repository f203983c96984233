"""The plant: gain, dead time, lags, numerator time constants, integrators, complex pairs.

    G(s) = k e^{-theta s} prod(T_j s + 1) prod(T^2 s^2 + 2 zeta T s + 1)
           / ( s^n prod(tau_i s + 1) prod(tau^2 s^2 + 2 zeta tau s + 1) )

T < 0 is a zero in the right half plane (inverse response), tau < 0 an unstable pole:
1/(20 s - 1) is k = -1, tau = -20. Time has one unit, the user's own.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from simc_core import checks
from simc_core.algebra.factors import Factored, factors
from simc_core.algebra.polynomials import factorise
from simc_core.errors import InvalidParameter
from simc_core.wording import Text, joined, said

INTEGRATING = (
    said("integrating", context="plant"),
    said("double integrating"),
    said("triple integrating"),
    said("fourfold integrating"),
)


@dataclass(frozen=True, slots=True)
class Plant:
    """Transfer function with exact dead time, see the module docstring.

    Parameters
    ----------
    k : float
        Gain of the part without integrators, in output units per input unit (per time^n with n integrators), != 0.
    theta : float
        Dead time >= 0, in the user's time unit.
    lags : tuple of float
        Time constants tau_i of the denominator, != 0; tau < 0 is an unstable pole.
    leads : tuple of float
        Time constants T_j of the numerator, != 0; T < 0 is a zero in the right half plane.
    integrators : int
        Number n of poles at s = 0, 0 to 4.
    lag_pairs, lead_pairs : tuple of (float, float)
        (tau, zeta) of complex pairs, tau > 0.

    Raises
    ------
    InvalidParameter
        A number is out of its bounds, or the numerator has a higher degree than the denominator.

    Examples
    --------
    e^{-s}/((8 s + 1)(s + 1)) at omega = 0 and its poles:

    >>> from simc_core import Plant
    >>> plant = Plant(k=1, theta=1, lags=(8, 1))
    >>> complex(plant.response(0)), plant.poles.real.tolist()
    ((1+0j), [-0.125, -1.0])
    """

    k: float
    theta: float = 0.0
    lags: tuple[float, ...] = ()
    leads: tuple[float, ...] = ()
    integrators: int = 0
    lag_pairs: tuple[tuple[float, float], ...] = ()
    lead_pairs: tuple[tuple[float, float], ...] = ()

    def __post_init__(self) -> None:
        put = object.__setattr__  # the only way to normalise a frozen dataclass
        put(self, "k", checks.gain("k", self.k))
        put(self, "theta", checks.optional_time("theta", self.theta))
        put(self, "lags", _times("lags", self.lags))
        put(self, "leads", _times("leads", self.leads))
        put(self, "integrators", checks.whole("integrators", self.integrators, 0, 4))
        put(self, "lag_pairs", _pairs("lag_pairs", self.lag_pairs))
        put(self, "lead_pairs", _pairs("lead_pairs", self.lead_pairs))
        zeros, poles = len(self.leads) + 2 * len(self.lead_pairs), self.order
        if poles > checks.MOST_FACTORS:
            raise InvalidParameter(
                said(
                    "a plant may have at most {most_factors} poles, found {poles}",
                    most_factors=checks.MOST_FACTORS,
                    poles=poles,
                )
            )
        if zeros > poles:
            raise InvalidParameter(
                said(
                    "degree of the numerator must be <= {poles}, that of the denominator, found {zeros}",
                    poles=poles,
                    zeros=zeros,
                )
            )

    @classmethod
    def from_polynomials(cls, num: Iterable[float], den: Iterable[float], theta: float = 0.0) -> "Plant":
        """num(s)/den(s) e^{-theta s}; coefficients in descending powers of s.

        Roots are found by eigenvalues; clusters that are one multiple root within rounding are made one.
        Raises InvalidParameter: empty or zero polynomials, a zero at s = 0 that no integrator cancels.
        """
        return cls.from_products([num], [den], theta)

    @classmethod
    def from_products(
        cls, nums: Iterable[Iterable[float]], dens: Iterable[Iterable[float]], theta: float = 0.0
    ) -> "Plant":
        """prod(num_i)/prod(den_j) e^{-theta s}, each a polynomial; factors given apart stay exact."""
        top, bottom = factorise(said("numerator"), nums), factorise(said("denominator"), dens)
        integrators = bottom.at_origin - top.at_origin
        if integrators < 0:
            raise InvalidParameter(
                said(
                    "numerator must not vanish at s = 0 (no gain to control with), found s^{integrators}",
                    integrators=-integrators,
                )
            )
        return cls(top.constant / bottom.constant, theta, bottom.times, top.times, integrators, bottom.pairs, top.pairs)

    def response(self, s: ArrayLike) -> np.ndarray:
        """G(s), complex, any shape of s; exact dead time."""
        return self.factored(s)

    def rescaled(self, time: Fraction = Fraction(1), gain: float = 1.0) -> "Plant":
        """The same plant in other units.

        Parameters
        ----------
        time : Fraction
            Times are multiplied by it: 1/60 from seconds to minutes. A ratio of whole numbers, so that 180 s are 3 min
            and 180 s again to the last bit.
        gain : float
            k is multiplied by it, besides what the integrators do: k in 1/s is 60 k in 1/min.

        Returns
        -------
        Plant
            k gain/time^n, and theta and all time constants times `time`.

        Examples
        --------
        >>> Plant(2.0, 20.0, (180.0,)).rescaled(time=Fraction(1, 60)).lags
        (3.0,)
        """
        n = self.integrators
        return Plant(
            self.k * gain * time.denominator**n / time.numerator**n,
            scaled(self.theta, time),
            tuple(scaled(tau, time) for tau in self.lags),
            tuple(scaled(tau, time) for tau in self.leads),
            n,
            tuple((scaled(tau, time), zeta) for tau, zeta in self.lag_pairs),
            tuple((scaled(tau, time), zeta) for tau, zeta in self.lead_pairs),
        )

    @property
    def factored(self) -> Factored:
        """The plant as the engine sees it."""
        return Factored(
            self.k,
            factors(*[(0.0, T, 1.0) for T in self.leads], *map(_quadratic, self.lead_pairs)),
            factors(
                *[(0.0, 1.0, 0.0)] * self.integrators,
                *[(0.0, tau, 1.0) for tau in self.lags],
                *map(_quadratic, self.lag_pairs),
            ),
            self.theta,
        )

    @property
    def order(self) -> int:
        """Number of poles."""
        return self.integrators + len(self.lags) + 2 * len(self.lag_pairs)

    @property
    def poles(self) -> np.ndarray:
        """Poles, complex, with multiplicity."""
        return self.factored.poles

    @property
    def zeros(self) -> np.ndarray:
        """Zeros, complex, with multiplicity."""
        return self.factored.zeros

    @property
    def unstable_poles(self) -> int:
        """Number of poles in the open right half plane (integrators not counted)."""
        return sum(tau < 0 for tau in self.lags) + 2 * sum(zeta < 0 for _, zeta in self.lag_pairs)

    @property
    def slowest(self) -> float:
        """Largest time constant, of lags by their size; 0 where there is none."""
        return max([*map(abs, self.lags), *(tau for tau, _ in self.lag_pairs)], default=0.0)

    @property
    def total_time(self) -> float:
        """Dead time and all time constants together: a scale for horizons. 0 where there is none."""
        return self.theta + sum(map(abs, self.lags)) + sum(tau for tau, _ in self.lag_pairs)

    @property
    def kind(self) -> Text:
        """What kind of process it is, in words."""
        words = []
        if self.unstable_poles:
            words.append(said("unstable", context="plant"))
        if self.integrators:
            words.append(INTEGRATING[self.integrators - 1])
        if any(0 <= zeta < 0.7 for _, zeta in self.lag_pairs):
            words.append(said("oscillating", context="plant"))
        if not words:
            words.append(self._self_regulating_kind())
        if any(T < 0 for T in self.leads) or any(zeta < 0 for _, zeta in self.lead_pairs):
            words.append(said("inverse response"))
        return joined(words)

    def _self_regulating_kind(self) -> Text:
        if self.slowest == 0:
            return said("pure dead time") if self.theta else said("pure gain")
        if self.theta == 0:
            return said("stable, no dead time")
        if self.theta > self.slowest:
            return said("stable, dead time dominant")
        return (
            said("stable, lag dominant") if self.slowest >= 4 * self.theta else said("stable, lag and dead time alike")
        )


def scaled(time: float, ratio: Fraction) -> float:
    """A time in another unit, rounded once where `ratio` or its inverse is whole."""
    return time * ratio.numerator / ratio.denominator


def _times(name: str, values: object) -> tuple[float, ...]:
    return tuple(checks.time_constant(f"{name}[{i}]", value) for i, value in enumerate(checks.items(name, values)))


def _pairs(name: str, values: object) -> tuple[tuple[float, float], ...]:
    pairs = []
    for i, value in enumerate(checks.items(name, values)):
        pair = checks.items(f"{name}[{i}]", value)
        if len(pair) != 2:
            raise InvalidParameter(
                said("{name}[{i}] must be (tau, zeta), found {numbers} numbers", name=name, i=i, numbers=len(pair))
            )
        tau = checks.positive_time(f"{name}[{i}] tau", pair[0])
        pairs.append((tau, checks.real(f"{name}[{i}] zeta", pair[1], -100.0, 100.0)))
    return tuple(pairs)


def _quadratic(pair: tuple[float, float]) -> tuple[float, float, float]:
    tau, zeta = pair
    return tau * tau, 2 * zeta * tau, 1.0
