"""The loop, and the one block diagram that fixes all signs.

                                      d
                                      |
    r ---->[ C_r ]--->(+)---- u --->(+)--->[ G = g e^{-theta s} ]----+---> y
                       ^ -                                           |
                       |                                             |
                       +-----------------[ C ]<----------------------+

    u = C_r r - C y        y = G (u + d)        L = G C
    S = 1/(1+L)   T = L/(1+L)   KS = C/(1+L)   GS = G/(1+L)

C is `controller.response`, C_r `controller.setpoint_response`. With b = c = 1 C_r = C.
"""

from dataclasses import dataclass
from functools import lru_cache, singledispatch

import numpy as np

from simc_core import checks
from simc_core.algebra.factors import Factored
from simc_core.controllers.forms import Controller
from simc_core.errors import InvalidParameter
from simc_core.plants.plant import Plant

MOST_FREQUENCIES = 1_000_000  # of one call, about 0.1 s


@dataclass(frozen=True, slots=True)
class Loop:
    """A plant under feedback, see the module docstring."""

    plant: Plant
    controller: Controller

    @property
    def L(self) -> Factored:
        """Loop transfer function G C, exact dead time."""
        return factored_plant(self.plant) * self.controller.factored


@lru_cache(maxsize=16)
def factored_plant(plant: Plant) -> Factored:
    """One plant meets many controllers."""
    return plant.factored


@dataclass(frozen=True, slots=True, eq=False)
class FrequencyResponse:
    """Arrays of shape (n,): omega in rad per time unit, the others complex."""

    omega: np.ndarray
    L: np.ndarray
    S: np.ndarray
    T: np.ndarray
    KS: np.ndarray
    GS: np.ndarray


@singledispatch
def frequency_response(loop: Loop, omega) -> FrequencyResponse:
    """L, S, T, KS and GS of the loop, with its dead time exact. For nested loops see nested.py.

    Parameters
    ----------
    loop : Loop, CascadeLoop or NestedLoops
        Stable or not.
    omega : array_like, shape (n,)
        Frequencies > 0, in rad per time unit.

    Returns
    -------
    FrequencyResponse
        Complex arrays of shape (n,).

    Raises
    ------
    InvalidParameter
        omega is not a list of positive finite numbers.

    Examples
    --------
    The magnitude of L = e^{-s}/(2s) is 1 at omega = 0.5:

    >>> from simc_core import Loop, Plant, SeriesPid, frequency_response
    >>> float(abs(frequency_response(Loop(Plant(1, 1, (8,)), SeriesPid(4, 8)), [0.5]).L[0]).round(12))
    1.0
    """
    omega = at_frequencies(omega)
    s = 1j * omega
    G, C = factored_plant(loop.plant)(s), loop.controller.factored(s)
    L = G * C
    with np.errstate(divide="ignore", invalid="ignore"):
        S = 1 / (1 + L)
        T = np.where(np.isfinite(L), L * S, 1.0)
    return FrequencyResponse(omega, L, S, T, C * S, G * S)


def at_frequencies(omega) -> np.ndarray:
    """omega as an array of shape (n,).

    Raises InvalidParameter where these are not positive finite numbers, or more than MOST_FREQUENCIES.
    """
    omega = checks.array("omega", omega, MOST_FREQUENCIES)
    wrong = omega[~(np.isfinite(omega) & (omega > 0))]
    if wrong.size:
        raise InvalidParameter(f"omega must be positive and finite, got {wrong[0]:g}")
    return omega
