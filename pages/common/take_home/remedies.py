"""What makes good again what filter and sampling of the box cost: changes of the design that were tried. Pure."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from pages.common.parts.units import measured
from pages.common.session.design import Design
from pages.common.session.fields import put
from pages.common.studies.single import Study, judged_settings, present_study
from pages.common.take_home.proof import longest_period, sampled
from pages.common.take_home.typed import typed_into
from simc_core import Loop, Typed
from simc_core.errors import SimcError
from simc_core.notation import number
from simc_core.wording import Text, said

HELPS = 0.98  # of Ms; a remedy that lowers it by less is not worth a click
SMALL = 0.02  # of tau_c + theta; half a filter time below it changes little


@dataclass(frozen=True, slots=True)
class Remedy:
    """label: on its button.   change: of the design, by the names of PLACES.   Ms: of the loop in the end."""

    label: Text
    change: dict[str, Any]
    Ms: float


def remedies(design: Design, present: Study, found: Typed) -> list[Remedy]:
    """Changes that lower Ms of the loop as it will be, with that Ms; the one that lowers it most first."""
    now = _Ms(design, found)
    offered = []
    for label, change in [*_retuned(design, present, found), *_faster(design, found)]:
        try:
            Ms = _after(design, change)
        except SimcError:
            continue
        if Ms < HELPS * now or (now != now and Ms == Ms):  # nan: not stable
            offered.append(Remedy(said("{change}: Ms {Ms}", change=label, Ms=number(Ms, 3)), change, Ms))
    return sorted(offered, key=lambda remedy: remedy.Ms)


def _retuned(design: Design, present: Study, found: Typed) -> Iterator[tuple[Text, dict[str, Any]]]:
    """Half of the filter time, half of the sampling period, or both, allowed for in theta."""
    if design.source == "own" or present.tuned is None:
        return
    tau_F, h = found.effective.to_parallel().tau_F, design.actuator.h
    known = present.tau_c + present.model.theta
    changes: dict[str, dict[str, Any]] = {}
    if tau_F - design.tuning.tau_F > 2 * SMALL * known:
        changes["τF/2"] = {"tau_F": tau_F} | _same_filter(present, found)
    if h and not design.tuning.h:
        changes["h/2"] = {"h": h}
    for added, change in changes.items():
        yield said("Retune with θ + {added}", added=added), change
    if len(changes) == 2:
        yield said("Retune with θ + τF/2 + h/2"), changes["τF/2"] | changes["h/2"]


def _same_filter(present: Study, found: Typed) -> dict[str, float]:
    """tau_F/tau_D that the box makes, for the design: its margins are then those of the box."""
    tau_D = present.controller.settings.get("tau_D", 0.0)
    return {"filter": float(f"{found.effective.to_parallel().tau_F / tau_D:.6g}")} if tau_D else {}


def _faster(design: Design, found: Typed) -> Iterator[tuple[Text, dict[str, Any]]]:
    """The longest sampling period that costs 5 % of Ms."""
    h = design.actuator.h
    loop = Loop(design.plant, found.effective)
    longest = longest_period(loop, design.actuator.law, design.actuator.delay_scans) if h else h
    if 0 < longest < h:
        yield said("Sample every {time}", time=measured(longest, design.sheet.time_unit)), {"sampling": longest}


def _after(design: Design, change: dict[str, Any]) -> float:
    """Ms of the loop as it will be, with the change. Raises SimcError."""
    for name, value in change.items():
        design = put(design, name, value)
    controller = present_study(design).controller
    return _Ms(design, typed_into(design.box, controller, design.sheet, design.home.rounding == "safe"))


def _Ms(design: Design, found: Typed) -> float:
    """As typed and, with a sampling period, sampled."""
    study = judged_settings(design.plant, found.effective)
    return sampled(study.loop, design)[1].Ms if design.actuator.h else study.margins.Ms
