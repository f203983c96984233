"""What a trend leaves open of a plant, in few numbers that a link or a file can hold."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from simc_core import checks
from simc_core.errors import InvalidParameter, WrongType
from simc_core.identification.estimator.held_input import Array
from simc_core.identification.estimator.structures import STRUCTURES
from simc_core.identification.identified import Identified
from simc_core.wording import said

NEAR = 6.0  # of the criterion within which a structure fits nearly as well, and is part of what is not known
LARGEST = 1e12  # size of a number of them
LEAST_FREEDOM = 1.0


@dataclass(frozen=True, slots=True)
class Uncertainty:
    """A structure with the errors of its parameters, normal in the coordinates theta, ln lags (zeta as it is), gains.

    Parameters
    ----------
    structure : str
        Its key, see `identify`.
    values : tuple of float, m of them
        theta, ln lags, gains, in the order of the structure.
    covariance : tuple of float, m (m + 1)/2 of them
        Upper triangle of their covariance, row by row.
    freedom : float
        Degrees of freedom of Student's t.

    Raises
    ------
    InvalidParameter
        Another structure, another number of values, a negative variance.

    Examples
    --------
    2 e^{-3s}/(8s + 1) with standard errors of 0.2, 5 % and 0.1:

    >>> from math import log
    >>> from simc_core import Uncertainty
    >>> Uncertainty("FOPDT", (3, log(8), 2), (0.04, 0, 0, 0.0025, 0, 0.01), freedom=50).matrix.shape
    (3, 3)
    """

    structure: str
    values: tuple[float, ...]
    covariance: tuple[float, ...]
    freedom: float

    def __post_init__(self) -> None:
        checks.one_of("structure", self.structure, STRUCTURES)
        m = 1 + len(STRUCTURES[self.structure].lags) + len(STRUCTURES[self.structure].gains)
        for name, wanted in (("values", m), ("covariance", m * (m + 1) // 2)):
            given = checks.items(name, getattr(self, name), 100)
            if len(given) != wanted:
                raise InvalidParameter(
                    said(
                        "{name} of {structure} must have {wanted} numbers, found {found}",
                        name=name,
                        structure=self.structure,
                        wanted=wanted,
                        found=len(given),
                    )
                )
            kept = tuple(checks.real(name, each, -LARGEST, LARGEST) for each in given)
            object.__setattr__(self, name, kept)
        if any(each < 0 for each in np.diag(self.matrix)):
            raise InvalidParameter(
                said(
                    "covariance must not have a negative variance, found {found:g}",
                    found=float(min(np.diag(self.matrix))),
                )
            )
        freedom = checks.real("freedom", self.freedom, LEAST_FREEDOM, LARGEST)
        object.__setattr__(self, "freedom", freedom)

    @property
    def matrix(self) -> Array:
        """The covariance, shape (m, m)."""
        m = len(self.values)
        found = np.zeros((m, m))
        found[np.triu_indices(m)] = self.covariance
        return found + np.triu(found, 1).T

    def rescaled(self, time: Fraction) -> "Uncertainty":
        """The same in another time unit; times are multiplied by `time`."""
        shape, ratio = STRUCTURES[self.structure], float(time)
        values, scale = np.array(self.values), np.ones(len(self.values))
        scale[0] = ratio
        powers = {"k_prime": -1, "k_double_prime": -2, "kT": 1}
        for i, name in enumerate(shape.gains, start=1 + len(shape.lags)):
            scale[i] = ratio ** powers.get(name, 0)
        values *= scale
        for i, name in enumerate(shape.lags, start=1):
            values[i] += 0.0 if name == "zeta" else np.log(ratio)
        spread = self.matrix * np.outer(scale, scale)
        return replace(self, values=tuple(values.tolist()), covariance=_triangle(spread))


def uncertainty_of(identified: Identified | Sequence[Identified]) -> tuple[Uncertainty, ...]:
    """What a trend leaves open: the errors of the model, and of the structures that fit nearly as well.

    Parameters
    ----------
    identified : Identified, or several as `identify_all` ranks them
        Of several, those within 6 of the best criterion count.

    Returns
    -------
    tuple of Uncertainty
        In their order.

    Examples
    --------
    >>> import numpy as np
    >>> from simc_core import Trend, identify, uncertainty_of
    >>> t = np.arange(0.0, 60.0)
    >>> y = 10 * np.where(t > 13.5, 1 - np.exp(-(t - 13.5).clip(0) / 8), 0)
    >>> [round(value, 3) for value in uncertainty_of(identify(Trend(t, y, np.where(t >= 10, 55, 50))))[0].values]
    [3.5, 2.079, 2.0]
    """
    several = [identified] if isinstance(identified, Identified) else list(identified)
    if not several or not all(isinstance(one, Identified) for one in several):
        raise WrongType(said("identified must be what identify or identify_all returns"))
    return tuple(
        Uncertainty(
            one.structure,
            tuple(one.estimate.values.tolist()),
            _triangle((one.estimate.spread + one.estimate.spread.T) / 2),
            one.estimate.freedom,
        )
        for one in several
        if not one.criterion > NEAR
    )


def _triangle(matrix: Array) -> tuple[float, ...]:
    return tuple(matrix[np.triu_indices(len(matrix))].tolist())
