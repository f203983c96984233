"""From the model to its tuning: how fast the loop may be for what is known of the plant, and the way there."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import streamlit as st

from pages.common.from_data.record_view import in_units
from pages.common.from_data.work import Fits, Work
from pages.common.parts.figure_words import in_words
from pages.common.parts.refusals import explain_refusal
from pages.common.parts.symbols import sentence
from pages.common.session import state
from pages.common.session.record import PARAMETERS, Origin
from pages.common.session.sheet import LONGEST, TIME_UNITS
from pages.common.shell import header
from simc_core import Identified, SimcError, Trend, checks, ms_of_cloud, robust_tau_c
from simc_core.figures import config
from simc_core.figures.trend import tau_c_figure
from simc_core.notation import number, rounded_up
from simc_core.studies.bands import ROBUST

LIMITS = (1.4, 1.59, ROBUST, 1.8, 2.0)
PROBABILITY = 0.95
NEAR = 6.0  # of the criterion: structures that fit nearly as well are part of what is not known
HEIGHT = 230  # px


def show(work: Work, trend: Trend, part: Trend, fits: Fits, model: Identified) -> None:
    """tau_c for the limit of Ms, and the buttons that begin a loop with the plant."""
    several = (replace(model, criterion=0.0), *(each for each in fits.found if each is not model and _near(each)))
    st.markdown("**How fast may the loop be?**")
    limit_place, said = st.columns([1, 3], gap="medium", vertical_alignment="bottom")
    limit = limit_place.selectbox(
        "Ms at most", LIMITS, index=LIMITS.index(ROBUST), key="Ms_limit", format_func="{:g}".format
    )
    tau_c, why = _kept(fits, (model.structure, limit), lambda: robust_tau_c(several, limit, PROBABILITY))
    with said:
        if tau_c is None:
            st.warning(sentence(why))
        else:
            _say(tau_c, limit, model, trend, len(several))
    slower = tau_c is not None and tau_c > 1.001 * model.model.theta
    with st.container(key="send", horizontal=True, gap="small"):
        if slower and tau_c is not None:
            slow = rounded_up(tau_c)
            label = f"Tune this model, τc = {number(slow)} {_plain(trend)}".rstrip()
            if st.button(label, type="primary", key="tune_robust"):
                _send(work, trend, part, model, slow)
        label = "Tune this model, τc = θ" if slower else "Tune this model"
        if st.button(label, type="secondary" if slower else "primary", key="tune"):
            _send(work, trend, part, model, None)
    with st.expander("Ms against τc"):
        _curve(fits, several, limit, tau_c, trend)


def _near(each: Identified) -> bool:
    return each.criterion <= NEAR


def _say(tau_c: float, limit: float, model: Identified, trend: Trend, structures: int) -> None:
    theta = model.model.theta
    size = f"{number(tau_c)} {_plain(trend)}".rstrip()
    many = number(tau_c / theta, 3) if theta > 0.01 * tau_c else ""
    times = f" = {many} θ" if many not in ("", "1") else " = θ" if many else ""
    others = {1: "", 2: ", and another structure that fits nearly as well"}
    besides = others.get(structures, f", and {structures - 1} other structures that fit nearly as well")
    st.markdown(
        f"With $\\tau_c$ = {size}{times} or slower, $M_s \\le$ {limit:g} holds with a probability of 95 % for "
        f"all that the record leaves open: the errors of the model{besides}."
    )


def _curve(fits: Fits, several: tuple[Identified, ...], limit: float, tau_c: float | None, trend: Trend) -> None:
    found, why = _kept(fits, (several[0].structure, "curve"), lambda: ms_of_cloud(several))
    if found is None:
        st.caption(sentence(why))
        return
    theta = several[0].model.theta
    marked = [("θ", theta)] if theta else []
    marked += [("95 %", tau_c)] if tau_c and tau_c > 1.05 * theta else []
    figure = tau_c_figure(found.tau_c, found.quantile(0.5), found.quantile(PROBABILITY), limit, marked, HEIGHT)
    alt = "Ms against tau_c: median and the value that is not passed with 95 %"
    figure = in_units(figure, trend)
    st.plotly_chart(figure, key="figure_tau_c", config=config("Ms of tau_c"), alt=in_words(alt, figure))
    st.caption("SIMC settings of the model, on plants drawn from its errors. Dashed: not passed with 95 %.")


def _kept(fits: Fits, key: tuple[Any, ...], make: Callable[[], Any]) -> tuple[Any, str]:
    """What was computed for these fits already, else now; and why there is nothing."""
    if key not in fits.known:
        try:
            fits.known[key] = (make(), "")
        except SimcError as error:
            fits.known[key] = (None, str(error))
    return fits.known[key]


def _plain(trend: Trend) -> str:
    unit = trend.units.get("t", "")
    return unit if unit in TIME_UNITS else ""


def _send(work: Work, trend: Trend, part: Trend, model: Identified, tau_c: float | None) -> None:
    """A loop of its own with this plant, its units and where it comes from."""
    errors = tuple(min(model.standard_errors[name], checks.LARGEST_GAIN) for name in PARAMETERS[model.structure])
    chosen = state.design_now().record
    with explain_refusal():
        state.begin_loop(model.plant, mine=True)
        origin = Origin(state.plant(), model.structure, errors, min(model.fit, 1.0), int(part.t.size), work.name)
        units = {
            "unit": _plain(trend),
            "PV_unit": trend.units.get("y", "")[: LONGEST["PV_unit"]],
            "OP_unit": trend.units.get("u", "")[: LONGEST["OP_unit"]],
            "PV": trend.names.get("y", "")[: LONGEST["PV"]],
            "OP": trend.names.get("u", "")[: LONGEST["OP"]],
        }
        kept = {name: getattr(chosen, name) for name in ("example", "structure", "begin", "end", "bad")}
        state.change(origin=origin, **units, **kept, **({"tau_c": tau_c} if tau_c else {}))
        header.go("tuning")
