"""The structures that can be fitted: their lags, the columns that their gains multiply, and the model they give.

| key | model | lags | gains |
|---|---|---|---|
| FOPDT | k e^{-theta s}/(tau1 s + 1) | tau1 | k |
| SOPDT | k e^{-theta s}/((tau1 s + 1)(tau2 s + 1)) | tau1, tau2 | k |
| IPDT | k' e^{-theta s}/s | | k' |
| IPDT_lag | k' e^{-theta s}/(s (tau2 s + 1)) | tau2 | k' |
| DIPDT | k'' e^{-theta s}/s^2 | | k'' |
| inverse | k (T s + 1) e^{-theta s}/((tau1 s + 1)(tau2 s + 1)), T of either sign | tau1, tau2 | k, k T |
| oscillating | k e^{-theta s}/(tau0^2 s^2 + 2 zeta tau0 s + 1) | tau0, zeta | k |
| unstable | k' e^{-theta s}/(s - a) | 1/a | k' |
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simc_core.identification.estimator.held_input import Array, HeldInput, Located
from simc_core.wording import said

Columns = Callable[[HeldInput, Located, NDArray[np.float64]], list[Array]]
Free = Callable[[Array, NDArray[np.float64]], list[Array]]


def _first_order(held: HeldInput, at: Located, lags: Array) -> list[Array]:
    return [held.held(at) - held.remainder(at, 1 / lags[0])]


def _two_lags(held: HeldInput, at: Located, lags: Array) -> list[Array]:
    first, difference = held.difference(at, lags[0], lags[1])
    return [held.held(at) - first - lags[1] * difference]


def _two_lags_and_zero(held: HeldInput, at: Located, lags: Array) -> list[Array]:
    first, difference = held.difference(at, lags[0], lags[1])
    return [held.held(at) - first - lags[1] * difference, difference]


def _integrator(held: HeldInput, at: Located, lags: Array) -> list[Array]:
    return [held.integral(at)]


def _integrator_and_lag(held: HeldInput, at: Located, lags: Array) -> list[Array]:
    return [held.integral(at) - lags[0] * (held.held(at) - held.remainder(at, 1 / lags[0]))]


def _two_integrators(held: HeldInput, at: Located, lags: Array) -> list[Array]:
    return [held.double_integral(at)]


def _pair(held: HeldInput, at: Located, lags: Array) -> list[Array]:
    tau0, zeta = lags
    real, imaginary = zeta / tau0, np.sqrt(1 - zeta**2) / tau0
    mode = held.remainder(at, complex(real, -imaginary))
    return [held.held(at) - ((1 - 1j * real / imaginary) * mode).real]


def _mirrored(held: HeldInput, at: Located, lags: Array) -> list[Array]:
    return [lags[0] * (held.held(at) - held.remainder(at, 1 / lags[0]))]


def _none(t: Array, lags: Array) -> list[Array]:
    return []


def _slowest(t: Array, lags: Array) -> list[Array]:
    return [np.exp(-t / lags.max())]


def _swing(t: Array, lags: Array) -> list[Array]:
    tau0, zeta = lags
    decay, angle = np.exp(-zeta * t / tau0), np.sqrt(1 - zeta**2) * t / tau0
    return [decay * np.cos(angle), decay * np.sin(angle)]


@dataclass(frozen=True, slots=True)
class Structure:
    """One structure of the table above.

    Parameters
    ----------
    key, title : str
        Its name in `identify` and in words.
    lags, gains : tuple of str
        What is fitted, beside theta.
    columns : callable
        Responses to OP with a gain of one, from the held input, the delayed instants and the lags.
    free : callable
        What an unsettled start leaves in y, for t from the first sample.
    ramp : int
        Degree of the polynomial in t that always goes along: the level where an integrator balances is not known.
    always_free : bool
        The free response is a part of the structure.
    """

    key: str
    title: str
    lags: tuple[str, ...]
    gains: tuple[str, ...]
    columns: Columns
    free: Free = _slowest
    ramp: int = 0
    always_free: bool = False

    @property
    def integrating(self) -> bool:
        """It has a pole at the origin."""
        return self.ramp > 0


STRUCTURES: Mapping[str, Structure] = {
    structure.key: structure
    for structure in (
        Structure("FOPDT", said("first order with delay"), ("tau1",), ("k",), _first_order),
        Structure("SOPDT", said("second order with delay"), ("tau1", "tau2"), ("k",), _two_lags),
        Structure("IPDT", said("integrating with delay"), (), ("k_prime",), _integrator, _none, 1),
        Structure(
            "IPDT_lag", said("integrating with lag and delay"), ("tau2",), ("k_prime",), _integrator_and_lag, ramp=1
        ),
        Structure("DIPDT", said("double integrating with delay"), (), ("k_double_prime",), _two_integrators, _none, 2),
        Structure(
            "inverse", said("second order with zero and delay"), ("tau1", "tau2"), ("k", "kT"), _two_lags_and_zero
        ),
        Structure("oscillating", said("oscillating with delay"), ("tau0", "zeta"), ("k",), _pair, _swing),
        Structure("unstable", said("unstable with delay"), ("1/a",), ("k_prime",), _mirrored, always_free=True),
    )
}
