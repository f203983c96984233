"""G(s) = A_0 + A_1 s + A_2 s^2 + ... at s = 0, for a plant without integrators."""

from math import factorial

import numpy as np

from simc_core.plants.plant import Plant


def taylor(plant: Plant, terms: int) -> np.ndarray:
    """The first `terms` coefficients A_0, A_1, ... of G(s), dead time included; A_n in the unit of k times time^n."""
    found = np.zeros(terms)
    found[0] = plant.k
    for T, zeta in (*((T, None) for T in plant.leads), *plant.lead_pairs):
        found = np.convolve(found, _factor(T, zeta))[:terms]
    found = np.convolve(found, [(-plant.theta) ** n / factorial(n) for n in range(terms)])[:terms]
    for tau, zeta in (*((tau, None) for tau in plant.lags), *plant.lag_pairs):
        found = np.convolve(found, _inverse(_factor(tau, zeta), terms))[:terms]
    return found


def _factor(T: float, zeta: float | None) -> tuple[float, ...]:
    """T s + 1, or T^2 s^2 + 2 zeta T s + 1, from the constant upwards."""
    return (1.0, T) if zeta is None else (1.0, 2 * zeta * T, T * T)


def _inverse(factor: tuple[float, ...], terms: int) -> np.ndarray:
    """1/factor as a power series; factor begins with 1."""
    found = np.zeros(terms)
    found[0] = 1.0
    for n in range(1, terms):
        found[n] = -sum(c * found[n - i] for i, c in enumerate(factor[1:], start=1) if i <= n)
    return found
