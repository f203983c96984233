"""Margins and crossings of single and of nested loops; margins_of_response.py says what they are.

Margins of nested loops mean something only where they are stable AND every loop inside is, see verdict.py.
"""

from collections.abc import Sequence

from simc_core.certificate.verdict import Stability, stability, stability_many
from simc_core.loops.loop import Loop
from simc_core.loops.nested import CascadeLoop, NestedLoops, not_a_loop
from simc_core.loops.on_demand import Later
from simc_core.sensitivity.bandwidth import Bandwidth, bandwidth_of
from simc_core.sensitivity.crossings import Crossings, search, search_many
from simc_core.sensitivity.log_response import FactoredResponse
from simc_core.sensitivity.margins_of_response import NOT_STABLE, Margins, margins_from, margins_of
from simc_core.sensitivity.nested_response import nested_response


def margins(loop: Loop | CascadeLoop | NestedLoops) -> Margins:
    """Margins of a loop, with its dead time exact; all nan where it, or a loop inside it, is not stable.

    Parameters
    ----------
    loop : Loop, CascadeLoop or NestedLoops
        Of nested loops, the outermost one with the others closed.

    Returns
    -------
    Margins
        Angles in degrees, times in the user's unit, frequencies in rad per that unit.

    Raises
    ------
    WrongType
        `loop` is no loop.

    References
    ----------
    [SK03] for the definitions of GM, PM, Ms and Mt.

    Examples
    --------
    The tight PI of a first-order model has GM = pi and Ms = 1.59, whatever k, tau1 and theta [SK03]:

    >>> from simc_core import FirstOrderDelay, Loop, Plant, margins, simc
    >>> found = margins(Loop(Plant(1, 1, (8,)), simc(FirstOrderDelay(1, 1, 8))))
    >>> round(found.GM, 4), round(found.Ms, 2)
    (3.1416, 1.59)
    """
    match loop:
        case Loop():
            return margins_many([loop], [stability(loop)])[0]
        case NestedLoops():
            return _with_bandwidth(loop, margins_of(nested_response(loop))) if stability(loop).sound else NOT_STABLE
        case CascadeLoop():
            return margins(loop.nested)
        case _:
            raise not_a_loop(loop)


def crossings(loop: Loop | CascadeLoop | NestedLoops) -> Crossings:
    """Every crossing and peak of L, also of a loop that is not stable: for drawing.

    Parameters
    ----------
    loop : Loop, CascadeLoop or NestedLoops
        Of nested loops, the outermost one with the others closed.

    Returns
    -------
    Crossings
        Frequencies in rad per time unit.

    Raises
    ------
    WrongType
        `loop` is no loop.

    Examples
    --------
    The magnitude of e^{-s}/(2 s) is 1 at omega = 1/2, where the phase margin is 90 degrees less 1/2 rad:

    >>> from simc_core import Loop, Plant, SeriesPid, crossings
    >>> found = crossings(Loop(Plant(1, 1, (8,)), SeriesPid(4, 8)))
    >>> found.gain_omega.round(9).tolist(), found.gain_phase.round(9).tolist()
    ([0.5], [1.070796327])
    """
    match loop:
        case Loop():
            return search(FactoredResponse(loop.L))
        case NestedLoops():
            return search(nested_response(loop))
        case CascadeLoop():
            return search(nested_response(loop.nested))
        case _:
            raise not_a_loop(loop)


def margins_many(loops: Sequence[Loop], verdicts: Sequence[Stability] | None = None) -> list[Margins]:
    """Margins of single loops, worked on together: cheapest where all have the same plant and form of controller.

    Parameters
    ----------
    loops : sequence of Loop, n of them
        The loops.
    verdicts : sequence of Stability, n of them, optional
        What `stability_many` says of `loops`, where that is known.

    Returns
    -------
    list of Margins, n of them
        In the order of `loops`; all nan where a loop is not stable.

    Raises
    ------
    InvalidParameter
        Where `stability` does for one of them.

    Examples
    --------
    GM = pi/(2 K theta) of K e^{-theta s}/s:

    >>> from simc_core import Loop, Plant, SeriesPid, margins_many
    >>> loops = [Loop(Plant(1, 1, integrators=1), SeriesPid(K, float("inf"))) for K in (0.25, 0.5)]
    >>> [round(each.GM, 6) for each in margins_many(loops)]
    [6.283185, 3.141593]
    """
    verdicts = stability_many(loops) if verdicts is None else verdicts
    stable = [i for i, verdict in enumerate(verdicts) if verdict.verdict == "stable"]
    responses = [FactoredResponse(loops[i].L) for i in stable]
    found = [NOT_STABLE] * len(loops)
    for i, response, crossed in zip(stable, responses, search_many(responses), strict=True):
        found[i] = _with_bandwidth(loops[i], margins_from(response, crossed))
    return found


def bandwidth(loop: Loop | CascadeLoop | NestedLoops) -> Bandwidth:
    """Bandwidths of S and T, and the largest |KS|; all nan where the loop is not stable.

    Parameters
    ----------
    loop : Loop, CascadeLoop or NestedLoops
        Dead time exact. Of nested loops, the outermost one with the others closed.

    Returns
    -------
    Bandwidth
        Frequencies in rad per time unit. `margins` has the same numbers.

    References
    ----------
    [RMS86]

    Examples
    --------
    >>> from simc_core import Loop, Plant, SeriesPid, bandwidth
    >>> found = bandwidth(Loop(Plant(1, 1, (8,)), SeriesPid(4, 8)))
    >>> round(found.omega_bS, 4), round(found.omega_bT, 4)
    (0.3554, 1.1243)
    """
    return margins(loop).bandwidth


def _with_bandwidth(loop: Loop | NestedLoops, found: Margins) -> Margins:
    marks = (found.omega_c, found.omega_180, found.omega_Ms, found.omega_Mt)
    Later(bandwidth_of, loop, marks).attach([found])
    return found
