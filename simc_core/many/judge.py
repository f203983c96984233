"""Margins and responses in numbers of many loops, each with its own plant; an error of one is that one's alone."""

from collections.abc import Sequence

from simc_core.certificate.verdict import Stability, all_faster, stability_many
from simc_core.errors import SimcError
from simc_core.loops.loop import Loop
from simc_core.many.result import Judged, said
from simc_core.metrics.performance import Performance, performance_many
from simc_core.sensitivity.margins import margins_many
from simc_core.sensitivity.margins_of_response import Margins

Performed = Performance | SimcError
STABLE = Stability("stable", 0)
SURE = 0.01  # of 1/theta: tight loops have no slower mode, and what a faster one adds after the end is nothing


def judge(loops: Sequence[Loop]) -> list[Judged | Exception]:
    """Each loop judged; an exception in the place of one that cannot be.

    All poles to the left of a line a little to the left of the imaginary axis: that is stability, and that no slow mode
    hides behind the end of the responses, in one count. Where it fails, both are asked for apart.
    """
    rates = _rates(loops)
    found = _margins(loops, rates)
    stable = [i for i, each in enumerate(found) if isinstance(each, Margins) and each.stable]
    performed = dict(zip(stable, _performance([loops[i] for i in stable], [rates[i] for i in stable]), strict=True))
    return [
        each if isinstance(each, Exception) else _judged(loop, each, performed.get(i))
        for i, (loop, each) in enumerate(zip(loops, found, strict=True))
    ]


def _judged(loop: Loop, found: Margins, performed: Performed | Exception | None) -> Judged:
    if isinstance(performed, Performance):
        return Judged(loop.controller, found, performed)
    why_not = "the loop is not stable" if performed is None else said(performed)
    return Judged(loop.controller, found, None, why_not)


def _rates(loops: Sequence[Loop]) -> list[float]:
    """A rate that all modes of a loop exceed, by the certificate; 0 where it is not known."""
    rates = [SURE / loop.plant.theta if loop.plant.theta else 0.0 for loop in loops]
    asked = [i for i, loop in enumerate(loops) if rates[i] and loop.L.relative_degree > 0]
    fast = dict(zip(asked, all_faster([loops[i] for i in asked], [rates[i] for i in asked]), strict=True))
    return [rate if fast.get(i) else 0.0 for i, rate in enumerate(rates)]


def _margins(loops: Sequence[Loop], rates: Sequence[float]) -> list[Margins | Exception]:
    """Together; where one of them fails, one by one."""
    try:
        asked = [i for i, rate in enumerate(rates) if not rate]
        verdicts = dict(zip(asked, stability_many([loops[i] for i in asked]), strict=True))
        return list(margins_many(loops, [verdicts.get(i, STABLE) for i in range(len(loops))]))
    except Exception as error:
        pairs = zip(loops, rates, strict=True)
        return [error] if len(loops) == 1 else [_margins([loop], [rate])[0] for loop, rate in pairs]


def _performance(loops: Sequence[Loop], rates: Sequence[float]) -> list[Performed | Exception]:
    try:
        return list(performance_many(loops, rates))
    except Exception as error:
        pairs = zip(loops, rates, strict=True)
        return [error] if len(loops) == 1 else [_performance([loop], [rate])[0] for loop, rate in pairs]
