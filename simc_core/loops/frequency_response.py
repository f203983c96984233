"""L, S, T, KS and GS of a loop at given frequencies; block diagrams in loop.py and nested.py."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simc_core import checks
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import Loop, factored_plant
from simc_core.loops.nested import CascadeLoop, NestedLoops, not_a_loop
from simc_core.wording import said

MOST_FREQUENCIES = 1_000_000  # of one call, about 0.1 s


@dataclass(frozen=True, slots=True, eq=False)
class FrequencyResponse:
    """Transfer functions of a loop at given frequencies.

    Attributes
    ----------
    omega : np.ndarray, shape (n,)
        Frequencies, in rad per time unit.
    L, S, T : np.ndarray, shape (n,), complex
        G C, 1/(1 + L) and L/(1 + L).
    KS, GS : np.ndarray, shape (n,), complex
        C S, from noise to input, in input units per output unit; G S, from load to output, in output units per input
        unit.
    """

    omega: np.ndarray
    L: np.ndarray
    S: np.ndarray
    T: np.ndarray
    KS: np.ndarray
    GS: np.ndarray


def frequency_response(loop: Loop | CascadeLoop | NestedLoops, omega: ArrayLike) -> FrequencyResponse:
    """L, S, T, KS and GS of the loop, with its dead time exact.

    Parameters
    ----------
    loop : Loop, CascadeLoop or NestedLoops
        Stable or not. Of nested loops, the outermost one with the others closed; GS is then from the disturbance at
        the input of the outermost block to its output.
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
    WrongType
        `loop` is no loop.

    Examples
    --------
    The magnitude of L = e^{-s}/(2s) is 1 at omega = 0.5:

    >>> from simc_core import Loop, Plant, SeriesPid, frequency_response
    >>> float(abs(frequency_response(Loop(Plant(1, 1, (8,)), SeriesPid(4, 8)), [0.5]).L[0]).round(12))
    1.0
    """
    at = at_frequencies(omega)
    match loop:
        case Loop():
            return _of_single(loop, at)
        case NestedLoops():
            return _of_outermost(loop, at)
        case CascadeLoop():
            return _of_outermost(loop.nested, at)
        case _:
            raise not_a_loop(loop)


def _of_single(loop: Loop, omega: np.ndarray) -> FrequencyResponse:
    s = 1j * omega
    G, C = factored_plant(loop.plant)(s), loop.controller.factored(s)
    L = G * C
    with np.errstate(divide="ignore", invalid="ignore"):
        S = 1 / (1 + L)
        T = np.where(np.isfinite(L), L * S, 1.0)
    return FrequencyResponse(omega, L, S, T, C * S, G * S)


def _of_outermost(loop: NestedLoops, omega: np.ndarray) -> FrequencyResponse:
    s = 1j * omega
    L, C, G = open_loop(loop, s), loop.outermost.factored(s), loop.blocks[-1].factored(s)
    S = 1 / (1 + L)
    return FrequencyResponse(omega, L, S, L * S, C * S, G * S)


def closed_inside(loops: NestedLoops, s: np.ndarray) -> np.ndarray:
    """Whatever the outermost controller sees before the block next to it: T of the loop inside, 1 if none."""
    if loops.inside is None:
        return np.ones_like(s)
    L = open_loop(loops.inside, s)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        return np.where(np.abs(L) > 1, 1 / (1 + 1 / L), L / (1 + L))


def open_loop(loops: NestedLoops, s: np.ndarray) -> np.ndarray:
    """L(s) of the outermost loop with all the others closed; complex, shape of s."""
    return loops.own(s) * closed_inside(loops, s)


def at_frequencies(omega: ArrayLike) -> np.ndarray:
    """omega as an array of shape (n,).

    Raises InvalidParameter where these are not positive finite numbers, or more than MOST_FREQUENCIES.
    """
    found = checks.array("omega", omega, MOST_FREQUENCIES)
    wrong = found[~(np.isfinite(found) & (found > 0))]
    if wrong.size:
        raise InvalidParameter(said("omega must be positive and finite, found {wrong:g}", wrong=wrong[0]))
    return found
