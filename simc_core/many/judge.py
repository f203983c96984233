"""Margins and responses in numbers of many loops, each with its own plant; an error of one is that one's alone."""

from collections.abc import Sequence

from simc_core.errors import NotStable
from simc_core.loops.loop import Loop
from simc_core.many.result import Judged, said
from simc_core.metrics.performance import performance
from simc_core.sensitivity.margins import margins
from simc_core.sensitivity.margins_of_response import Margins


def judge(loops: Sequence[Loop]) -> list[Judged | Exception]:
    """Each loop judged; an exception in the place of one that cannot be."""
    return [_alone(loop) for loop in loops]


def _alone(loop: Loop) -> Judged | Exception:
    try:
        return _with_performance(loop, margins(loop))
    except Exception as error:
        return error


def _with_performance(loop: Loop, found: Margins) -> Judged:
    if not found.stable:
        return Judged(loop.controller, found, None, "the loop is not stable")
    try:
        return Judged(loop.controller, found, performance(loop))
    except NotStable as error:
        return Judged(loop.controller, found, None, said(error))
    except ValueError as error:
        return Judged(loop.controller, found, None, said(error))
