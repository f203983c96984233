"""The model begins a loop of its own on the tuning page, with its units, where it comes from and what is not known."""

from pages.common.from_data.work import Fits, Work, nearly
from pages.common.parts.refusals import explain_refusal
from pages.common.session import state
from pages.common.session.home import Point
from pages.common.session.record import PARAMETERS, Origin, kept_uncertainty
from pages.common.session.sheet import LONGEST, TIME_UNITS
from pages.common.shell import header
from simc_core import Identified, Trend, checks
from simc_core.controllers.forms import Controller
from simc_core.identification.judgement.gain_per_move import disagreement


def plain_unit(trend: Trend) -> str:
    """The unit of time where it is one that the loop sheet knows."""
    unit = trend.units.get("t", "")
    return unit if unit in TIME_UNITS else ""


def send(
    work: Work,
    trend: Trend,
    model: Identified,
    fits: Fits,
    tau_c: float | None = None,
    own: Controller | None = None,
    points: tuple[Point, ...] = (),
) -> None:
    """Begin the loop and go there.   tau_c: for SIMC, None for tight.   own: settings instead of SIMC's.

    points: of a gain schedule, where it goes instead.
    """
    errors = tuple(min(model.standard_errors[name], checks.LARGEST_GAIN) for name in PARAMETERS[model.structure])
    chosen = state.design_now().record
    with explain_refusal():
        state.begin_loop(model.plant, mine=True)
        apart = disagreement(model.gains)
        origin = Origin(
            state.plant(),
            model.structure,
            errors,
            min(model.fit, 1.0),
            int(model.predicted.size),
            _source(work),
            () if apart is None else tuple(float(f"{each.gain:.4g}") for each in (apart.low, apart.high)),
        )
        units = {
            "unit": plain_unit(trend),
            "PV_unit": trend.units.get("y", "")[: LONGEST["PV_unit"]],
            "OP_unit": trend.units.get("u", "")[: LONGEST["OP_unit"]],
            "PV": trend.names.get("y", "")[: LONGEST["PV"]],
            "OP": trend.names.get("u", "")[: LONGEST["OP"]],
        }
        kept = {name: getattr(chosen, name) for name in ("example", "structure", "begin", "end", "bad")}
        state.change(origin=origin, **units, **kept)
        state.change(uncertainty=kept_uncertainty(nearly(fits, model)))
        if own is not None:
            state.change(own=own, form="ideal")
            state.change(controller="own")
        elif tau_c:
            state.change(tau_c=tau_c)
        if points:
            state.change(points=points)
            state.set_widget("home_views", "Schedule")
        header.go("take_home" if points else "tuning")


def _source(work: Work) -> str:
    more = len(work.names()) - 1
    return f"{work.name} and {more} more" if more else work.name  # kept in links
