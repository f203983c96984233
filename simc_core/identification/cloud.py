"""Plants that a trend does not tell apart: drawn from the covariance, and from structures that fit nearly as well."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simc_core.errors import WrongType
from simc_core.identification.estimator.held_input import Array
from simc_core.identification.identified import Identified
from simc_core.identification.parameters import natural_values

MEMBERS = 200
NEAR = 6.0  # of the criterion within which a structure is in the cloud
SEED = 20031129  # the same trend gives the same numbers


@dataclass(frozen=True, slots=True, eq=False)
class Cloud:
    """Plants of one structure: values (n, m) of theta, its lags and gains, by name."""

    structure: str
    names: tuple[str, ...]
    values: Array

    def response(self, omega: Array) -> NDArray[np.complex128]:
        """G(j omega), shape (n, number of omega), dead time exact."""
        value = {name: self.values[:, i, None] for i, name in enumerate(self.names)}
        s = 1j * omega[None, :]
        late = np.exp(-value["theta"] * s)
        match self.structure:
            case "FOPDT":
                return value["k"] * late / (value["tau1"] * s + 1)
            case "SOPDT":
                return value["k"] * late / ((value["tau1"] * s + 1) * (value["tau2"] * s + 1))
            case "inverse":
                zero = value["T"] * s + 1
                return value["k"] * zero * late / ((value["tau1"] * s + 1) * (value["tau2"] * s + 1))
            case "IPDT":
                return value["k_prime"] * late / s
            case "IPDT_lag":
                return value["k_prime"] * late / (s * (value["tau2"] * s + 1))
            case "DIPDT":
                return value["k_double_prime"] * late / s**2
            case "oscillating":
                return value["k"] * late / ((value["tau0"] * s) ** 2 + 2 * value["zeta"] * value["tau0"] * s + 1)
            case _:
                return value["k_prime"] * late / (s - value["a"])

    @property
    def integrators(self) -> int:
        """Poles at the origin."""
        return {"IPDT": 1, "IPDT_lag": 1, "DIPDT": 2}.get(self.structure, 0)

    @property
    def unstable_poles(self) -> int:
        """Poles in the right half plane."""
        return int(self.structure == "unstable")


def clouds(identified: Identified | Sequence[Identified], members: int = MEMBERS) -> list[Cloud]:
    """The estimate and `members` plants drawn around it, for each structure that fits nearly as well as the first.

    Parameters
    ----------
    identified : Identified, or several as `identify_all` ranks them
    members : int
        Plants of each structure.
    """
    several = [identified] if isinstance(identified, Identified) else list(identified)
    if not several or not all(isinstance(one, Identified) for one in several):
        raise WrongType("identified must be what identify or identify_all returns")
    return [_drawn(one, members) for one in several if not one.criterion > NEAR]


def _drawn(one: Identified, members: int) -> Cloud:
    estimate = one.estimate
    structure = estimate.fit.problem.structure
    chance = np.random.default_rng(SEED)
    spread, vectors = np.linalg.eigh((estimate.spread + estimate.spread.T) / 2)
    root = vectors * np.sqrt(np.maximum(spread, 0.0))
    normal = chance.standard_normal((members, len(spread))) @ root.T
    normal /= np.sqrt(chance.chisquare(estimate.freedom, (members, 1)) / estimate.freedom)  # Student's t
    values = estimate.values + np.concatenate([np.zeros((1, len(spread))), normal])
    lags = slice(1, 1 + len(structure.lags))
    values[:, lags] = np.clip(values[:, lags], estimate.values[lags] - 5, estimate.values[lags] + 5)
    values[:, 0] = np.maximum(values[:, 0], 0.0)
    if "zeta" in structure.lags:
        values[:, 2] = np.maximum(values[:, 2], 0.0)
    gain = 1 + len(structure.lags)
    kept = values[:, gain] * estimate.values[gain] > 0
    found = natural_values(structure.lags, structure.gains, values[kept])
    names = tuple({"1/a": "a", "kT": "T"}.get(name, name) for name in ("theta", *structure.lags, *structure.gains))
    return Cloud(structure.key, names, found)
