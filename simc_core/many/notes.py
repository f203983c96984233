"""What is said of a row: guards of the tuning page that cost little, and the same questions to the present settings."""

from collections.abc import Callable, Iterator
from dataclasses import replace

from simc_core.controllers.forms import Controller
from simc_core.errors import NotReducible
from simc_core.loops.loop import Loop
from simc_core.many.request import Request
from simc_core.many.result import SLOW, Judged
from simc_core.plants.models import Model
from simc_core.reduction.half_rule import reduced_model
from simc_core.reduction.records import LARGEST_MS, Reduction
from simc_core.studies.advice import (
    LEVELS,
    Advice,
    faster_than_dead_time,
    large_Ms,
    not_stable,
    oscillating_plant,
    other_than_chosen,
    slow_oscillation,
    slower_than_plant,
)
from simc_core.studies.bands import exceeds
from simc_core.studies.tuned import USUAL, Tuned

Guard = Callable[[Tuned], Advice | None]
GUARDS: tuple[Guard, ...] = (not_stable, large_Ms, other_than_chosen, oscillating_plant)
ON_TAU_C: tuple[Guard, ...] = (faster_than_dead_time, slower_than_plant)  # silent where tau_c is left to be theta


def on_simc(request: Request, model: Model, tau_c: float, made: Judged, loop: Loop) -> tuple[Advice, ...]:
    """On settings by SIMC, with remedies that were tried."""
    chosen = {"order": 2 if request.kind == "PID" else 1, "tau_c": request.tau_c, "filter": request.filter}
    alone = Reduction(model, (), (), (), (), (), None)
    of = Tuned(request.plant, USUAL | chosen, alone, tau_c, loop, made.margins)
    guards = GUARDS if request.tau_c is None else (*GUARDS, *ON_TAU_C)
    return tuple(found for guard in guards if (found := guard(of)))


def on_any(made: Judged, which: str = "") -> Iterator[Advice]:
    """On settings that another rule, or nobody, has made. which: " now" for those in the plant."""
    if not made.margins.stable:
        yield Advice("error", f"Not stable{which}", "The loop is not stable, so it has neither margins nor IAE.")
    elif exceeds(made.margins.Ms, LARGEST_MS):
        text = "L passes close to -1: small errors of the model can make the loop unstable."
        yield Advice("warning", f"Ms{which}", text, made.margins.Ms, LARGEST_MS)


def on_responses(made: Judged, which: str = "") -> Iterator[Advice]:
    """Why there is no IAE of a stable loop, and a derivative without a filter."""
    if made.margins.stable and made.why_not:
        yield Advice("note", f"No IAE{which}", f"{made.why_not[0].upper()}{made.why_not[1:]}.")
    form = made.controller.to_parallel()
    if form.Kd and not form.tau_F:
        text = "The derivative has no filter: measurement noise passes without limit."
        yield Advice("warning", f"tau_F = 0{which}", text)


def on_present(request: Request, made: Judged) -> Iterator[Advice]:
    """On the settings that are in the controller now."""
    yield from on_any(made, " now")
    yield from on_responses(made, " now")
    slow = _slow(request, made.controller) if made.margins.stable else None
    if slow is not None:
        yield replace(slow, quantity=SLOW)


def gravest_first(found: Iterator[Advice] | tuple[Advice, ...]) -> tuple[Advice, ...]:
    """Sorted by level."""
    return tuple(sorted(found, key=lambda item: LEVELS.index(item.level)))


def _slow(request: Request, controller: Controller) -> Advice | None:
    try:
        return slow_oscillation(reduced_model(request.plant), controller)
    except NotReducible:
        return None
