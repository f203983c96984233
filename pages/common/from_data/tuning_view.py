"""From the model to its tuning: how fast the loop may be for what is known of the plant, and the way there."""

import streamlit as st

from pages.common.from_data import figure
from pages.common.from_data.send import plain_unit, send
from pages.common.from_data.work import Fits, Work, kept, nearly
from pages.common.parts.symbols import sentence
from pages.common.words import number, translated, words
from simc_core import Identified, Trend, ms_of_cloud, robust_tau_c
from simc_core.figures.trend import tau_c_figure
from simc_core.identification.judgement.gain_per_move import disagreement
from simc_core.notation import rounded_up
from simc_core.studies.bands import ROBUST
from simc_core.wording import counted

LIMITS = (1.4, 1.59, ROBUST, 1.8, 2.0)
PROBABILITY = 0.95
HEIGHT = 230  # px


def show(work: Work, trend: Trend, fits: Fits, model: Identified) -> None:
    """tau_c for the limit of Ms, and the buttons that begin a loop with the plant."""
    several = nearly(fits, model)
    limit_place, beside = st.columns([1, 3], gap="medium", vertical_alignment="bottom")
    limit = limit_place.selectbox(
        words("Ms at most"), LIMITS, index=LIMITS.index(ROBUST), key="Ms_limit", format_func=number
    )
    tau_c, why = kept(fits, (model.structure, limit), lambda: robust_tau_c(several, limit, PROBABILITY))
    with beside:
        if tau_c is None:
            st.warning(sentence(why))
        else:
            _say(tau_c, limit, model, trend, len(several))
    slower = tau_c is not None and tau_c > 1.001 * model.model.theta
    with st.container(key="send", horizontal=True, gap="small"):
        if slower and tau_c is not None:
            slow = rounded_up(tau_c)
            label = words("Tune this model, τc = {tau_c}", tau_c=f"{number(slow)} {plain_unit(trend)}".rstrip())
            if st.button(label, type="primary", key="tune_robust"):
                send(work, trend, model, fits, slow)
        label = words("Tune this model, τc = θ") if slower else words("Tune this model")
        if not (slower and model.model.theta == 0) and st.button(
            label, type="secondary" if slower else "primary", key="tune"
        ):
            send(work, trend, model, fits)
    folded = st.expander(words("Ms against τc"), key="Ms_against_tau_c", on_change="rerun")
    if folded.open:
        with folded:
            _curve(fits, several, limit, tau_c, trend)


def _say(tau_c: float, limit: float, model: Identified, trend: Trend, structures: int) -> None:
    theta = model.model.theta
    size = f"{number(tau_c)} {plain_unit(trend)}".rstrip()
    many = number(tau_c / theta, 3) if theta > 0.01 * tau_c else ""
    times = f" = {many} θ" if many not in ("", "1") else " = θ" if many else ""
    tau_c_text, Ms = f"{size}{times}", number(limit)
    if structures == 1:
        told = words(
            "With $\\tau_c$ = {tau_c} or slower, $M_s \\le$ {Ms} holds with a probability of 95 % for all that the "
            "record leaves open: the errors of the model.",
            tau_c=tau_c_text,
            Ms=Ms,
        )
    else:
        told = translated(
            counted(
                "With $\\tau_c$ = {tau_c} or slower, $M_s \\le$ {Ms} holds with a probability of 95 % for all that the "
                "record leaves open: the errors of the model, and another structure that fits nearly as well.",
                "With $\\tau_c$ = {tau_c} or slower, $M_s \\le$ {Ms} holds with a probability of 95 % for all that the "
                "record leaves open: the errors of the model, and {n} other structures that fit nearly as well.",
                structures - 1,
                tau_c=tau_c_text,
                Ms=Ms,
            )
        )
    apart = f" {words('Not for gains that differ from move to move.')}" if disagreement(model.gains) else ""
    st.markdown(f"{told}{apart}")


def _curve(fits: Fits, several: tuple[Identified, ...], limit: float, tau_c: float | None, trend: Trend) -> None:
    found, why = kept(fits, (several[0].structure, "curve"), lambda: ms_of_cloud(several))
    if found is None:
        st.caption(sentence(why))
        return
    theta = several[0].model.theta
    marked = [("θ", theta)] if theta else []
    marked += [("95 %", tau_c)] if tau_c and tau_c > 1.05 * theta else []
    drawn = tau_c_figure(found.tau_c, found.quantile(0.5), found.quantile(PROBABILITY), limit, marked, HEIGHT)
    alt = words("Ms against tau_c: median and the value that is not passed with 95 %")
    figure.show(drawn, trend, "figure_tau_c", "Ms of tau_c", alt)
    st.caption(words("SIMC settings of the model, on plants drawn from its errors. Dashed: not passed with 95 %."))
