"""Plants that a trend does not tell apart: drawn from the covariance, and from structures that fit nearly as well."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simc_core.errors import SimcError, WrongType
from simc_core.identification.estimator.held_input import Array
from simc_core.identification.estimator.structures import STRUCTURES
from simc_core.identification.identified import Identified
from simc_core.identification.models import as_model
from simc_core.identification.parameters import natural_values
from simc_core.identification.uncertainty import Uncertainty, uncertainty_of
from simc_core.plants.plant import Plant
from simc_core.wording import said

MEMBERS = 200
SEED = 20031129  # the same trend gives the same numbers
Uncertain = Identified | Uncertainty | Sequence[Identified] | Sequence[Uncertainty]


@dataclass(frozen=True, slots=True, eq=False)
class Cloud:
    """Plants of one structure: values (n, m) of theta, its lags and gains, by name; the estimate first."""

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

    def plants(self, count: int) -> list[Plant]:
        """The first `count` of them, the estimate first; members outside the bounds of a plant are passed over."""
        found: list[Plant] = []
        for row in self.values:
            if len(found) == count:
                break
            try:
                found.append(as_model(self.structure, dict(zip(self.names, row.tolist(), strict=True)))[0])
            except SimcError:
                continue
        return found

    @property
    def integrators(self) -> int:
        """Poles at the origin."""
        return {"IPDT": 1, "IPDT_lag": 1, "DIPDT": 2}.get(self.structure, 0)

    @property
    def unstable_poles(self) -> int:
        """Poles in the right half plane."""
        return int(self.structure == "unstable")


def clouds(uncertain: Uncertain, members: int = MEMBERS) -> list[Cloud]:
    """The estimate and `members` plants drawn around it, for each structure that fits nearly as well as the first.

    Parameters
    ----------
    uncertain : Identified or Uncertainty, or several
        Of several Identified, as `identify_all` ranks them, those within 6 of the best criterion count.
    members : int
        Plants of each structure.
    """
    return [_drawn(one, members) for one in _uncertainties(uncertain)]


def _uncertainties(uncertain: Uncertain) -> tuple[Uncertainty, ...]:
    if isinstance(uncertain, Uncertainty):
        return (uncertain,)
    if isinstance(uncertain, Identified):
        return uncertainty_of(uncertain)
    several = tuple(uncertain)
    known = tuple(one for one in several if isinstance(one, Uncertainty))
    fitted = tuple(one for one in several if isinstance(one, Identified))
    if several and len(known) == len(several):
        return known
    if several and len(fitted) == len(several):
        return uncertainty_of(fitted)
    raise WrongType(said("identified must be what identify, identify_all or uncertainty_of returns"))


def _drawn(one: Uncertainty, members: int) -> Cloud:
    structure = STRUCTURES[one.structure]
    chance = np.random.default_rng(SEED)
    size = np.sqrt(np.maximum(np.diag(one.matrix), 0.0))
    own = np.where(size > 0, size, 1.0)  # drawn from the correlations, so that units make no other plants
    spread, vectors = np.linalg.eigh(one.matrix / np.outer(own, own))
    root = size[:, None] * vectors * np.sqrt(np.maximum(spread, 0.0))
    normal = chance.standard_normal((members, len(spread))) @ root.T
    normal /= np.sqrt(chance.chisquare(one.freedom, (members, 1)) / one.freedom)  # Student's t
    centre = np.array(one.values)
    values = centre + np.concatenate([np.zeros((1, len(spread))), normal])
    lags = slice(1, 1 + len(structure.lags))
    values[:, lags] = np.clip(values[:, lags], centre[lags] - 5, centre[lags] + 5)
    if structure.lags == ("tau1", "tau2"):
        values[:, lags] = _with_their_sum(values[:, lags], centre[lags])
    values[:, 0] = np.maximum(values[:, 0], 0.0)
    if "zeta" in structure.lags:
        values[:, 2] = np.maximum(values[:, 2], 0.0)
    gain = 1 + len(structure.lags)
    kept = values[:, gain] * centre[gain] > 0
    found = natural_values(structure.lags, structure.gains, values[kept])
    names = tuple({"1/a": "a", "kT": "T"}.get(name, name) for name in ("theta", *structure.lags, *structure.gains))
    return Cloud(structure.key, names, found)


def _with_their_sum(drawn: Array, centre: Array) -> Array:
    """ln lags, rows of two, drawn about a centre: as they are to first order, but with the sum that this leaves.

    Two lags that part are told from one another by their sum, not by their product: to draw them one by one would make
    the sum of two that are not told apart as large as one likes.
    """
    half, middle = (centre[0] - centre[1]) / 2, (centre[0] + centre[1]) / 2
    parted = (drawn[:, 0] - drawn[:, 1]) / 2
    total = (drawn[:, 0] + drawn[:, 1]) / 2 - middle + np.tanh(half) * (parted - half)
    total += middle + np.log(2 * np.cosh(half))
    larger = total - np.log(2 * np.cosh(parted))
    return np.stack([larger + parted, larger - parted], axis=1)
