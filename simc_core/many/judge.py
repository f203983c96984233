"""Margins and responses in numbers of many loops, each with its own plant; an error of one is that one's alone."""

from collections.abc import Sequence

from simc_core.certificate.verdict import Stability, stability_many
from simc_core.errors import SimcError
from simc_core.loops.loop import Loop
from simc_core.many.result import Judged, told
from simc_core.metrics.performance import Performance, performance_many
from simc_core.sensitivity.margins import margins_many
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.wording import said

Performed = Performance | SimcError


def judge(loops: Sequence[Loop]) -> list[Judged | Exception]:
    """Each loop judged; an exception in the place of one that cannot be."""
    found = _margins(loops)
    stable = {i: each[1] for i, each in enumerate(found) if not isinstance(each, Exception) and each[0].stable}
    performed = dict(zip(stable, _performance([loops[i] for i in stable], list(stable.values())), strict=True))
    return [
        each if isinstance(each, Exception) else _judged(loop, each[0], performed.get(i))
        for i, (loop, each) in enumerate(zip(loops, found, strict=True))
    ]


def _judged(loop: Loop, found: Margins, performed: Performed | Exception | None) -> Judged:
    if isinstance(performed, Performance):
        return Judged(loop.controller, found, performed)
    why_not = said("the loop is not stable") if performed is None else told(performed)
    return Judged(loop.controller, found, None, why_not)


def _margins(loops: Sequence[Loop]) -> list[tuple[Margins, Stability] | Exception]:
    """With the verdict; together, and where one of them fails one by one."""
    try:
        verdicts = stability_many(loops)
        return list(zip(margins_many(loops, verdicts), verdicts, strict=True))
    except Exception as error:
        return [error] if len(loops) == 1 else [_margins([loop])[0] for loop in loops]


def _performance(loops: Sequence[Loop], verdicts: Sequence[Stability]) -> list[Performed | Exception]:
    try:
        return list(performance_many(loops, verdicts))
    except Exception as error:
        if len(loops) == 1:
            return [error]
        return [_performance([loop], [verdict])[0] for loop, verdict in zip(loops, verdicts, strict=True)]
