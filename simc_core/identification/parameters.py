"""From the coordinates of the estimator, theta, ln lags and gains, to parameters and back."""

import numpy as np

from simc_core.identification.estimator.held_input import Array
from simc_core.identification.judgement.estimate import Estimate

ORDER = ("k", "k_prime", "k_double_prime", "T", "theta", "tau1", "tau2", "tau0", "zeta", "a")


def natural(estimate: Estimate) -> tuple[list[str], Array, Array]:
    """Names, values and covariance of the parameters, gains first, larger lag first."""
    structure = estimate.fit.problem.structure
    values = natural_values(structure.lags, structure.gains, estimate.values[None, :])[0]
    names = ["theta", *structure.lags, *structure.gains]
    inner = np.diag(_scales(structure.lags, values, len(names)))
    names = [{"1/a": "a", "kT": "T"}.get(name, name) for name in names]
    if "T" in names:  # T = (k T)/k
        i, j = names.index("T"), names.index("k")
        inner[i, i], inner[i, j] = 1 / values[j], -values[i] / values[j]
    if "tau2" in names and "tau1" in names and values[names.index("tau2")] > values[names.index("tau1")]:
        i, j = names.index("tau1"), names.index("tau2")
        names[i], names[j] = names[j], names[i]
    order = sorted(range(len(names)), key=lambda i: ORDER.index(names[i]))
    covariance = inner @ estimate.spread @ inner.T
    return [names[i] for i in order], values[order], covariance[np.ix_(order, order)]


def natural_values(lags: tuple[str, ...], gains: tuple[str, ...], values: Array) -> Array:
    """Rows of (theta, ln lags, gains) as (theta, lags, gains), with a for 1/a and T for k T; theta below 0 is 0."""
    found = values.copy()
    found[:, 0] = np.maximum(found[:, 0], 0.0)
    found[found[:, 0] < 1e-9, 0] = 0.0
    for i, name in enumerate(lags, start=1):
        if name == "1/a":
            found[:, i] = np.exp(-found[:, i])
        elif name != "zeta":
            found[:, i] = np.exp(found[:, i])
    if "kT" in gains:
        found[:, -1] = found[:, -1] / found[:, -2]
    return found


def _scales(lags: tuple[str, ...], values: Array, size: int) -> Array:
    """d parameter/d coordinate, where they depend on one alone."""
    found = np.ones(size)
    for i, name in enumerate(lags, start=1):
        if name == "1/a":
            found[i] = -values[i]
        elif name != "zeta":
            found[i] = values[i]
    return found
