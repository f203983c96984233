"""What is said of a row: guards of the tuning page that cost little, and the same questions to the present settings."""

from collections.abc import Callable, Iterable
from dataclasses import replace

from simc_core.loops.loop import Loop
from simc_core.many.request import Request
from simc_core.many.result import NOW, Judged
from simc_core.plants.models import Model
from simc_core.plants.plant import Plant
from simc_core.reduction.records import Reduction
from simc_core.studies.advice import (
    LEVELS,
    Advice,
    faster_than_dead_time,
    large_Ms,
    not_stable,
    oscillating_plant,
    other_than_chosen,
    slower_than_plant,
)
from simc_core.studies.own_settings import advice_on_settings, no_filter
from simc_core.studies.tuned import USUAL, Tuned
from simc_core.wording import said

Guard = Callable[[Tuned], Advice | None]
GUARDS: tuple[Guard, ...] = (not_stable, large_Ms, other_than_chosen, oscillating_plant)
ON_TAU_C: tuple[Guard, ...] = (faster_than_dead_time, slower_than_plant)  # silent where tau_c is left to be theta


def on_simc(request: Request, model: Model, tau_c: float, made: Judged, loop: Loop) -> tuple[Advice, ...]:
    """On settings by SIMC, with remedies that were tried."""
    chosen = {"order": 2 if request.kind == "PID" else 1, "tau_c": request.tau_c, "filter": request.filter}
    alone = Reduction(model, (), (), (), (), (), None)
    of = Tuned(request.plant, USUAL | chosen, alone, tau_c, loop, made.margins)
    guards = GUARDS if request.tau_c is None else (*GUARDS, *ON_TAU_C)
    found = (*(guard(of) for guard in guards), no_filter(made.controller), _no_error(made))
    return gravest_first(item for item in found if item)


def on_any(plant: Plant, made: Judged) -> tuple[Advice, ...]:
    """On settings that another rule than SIMC, or nobody, has made."""
    found = (*advice_on_settings(Loop(plant, made.controller), made.margins), _no_error(made))
    return gravest_first(item for item in found if item)


def on_present(plant: Plant, made: Judged) -> tuple[Advice, ...]:
    """On the settings that are in the controller now."""
    return tuple(replace(item, quantity=NOW.put(quantity=item.quantity)) for item in on_any(plant, made))


def _no_error(made: Judged) -> Advice | None:
    """Why there is no IAE of a stable loop."""
    if not made.margins.stable or not made.why_not:
        return None
    return Advice("note", said("No IAE"), said("{why}.", why=made.why_not))


def gravest_first(found: Iterable[Advice]) -> tuple[Advice, ...]:
    """Sorted by level."""
    return tuple(sorted(found, key=lambda item: LEVELS.index(item.level)))
