"""What the record of an identified plant leaves open: Ms and responses as bands, and the tau_c that is safe."""

import numpy as np
import streamlit as st

from pages.common.parts.panel import show
from pages.common.parts.structures import NAMES
from pages.common.parts.symbols import sentence
from pages.common.parts.units import time_text
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.studies.single import Study
from pages.common.studies.uncertain import FEWEST, bands, fastest, peaks_of, sensitivity
from pages.common.words import number, numeral, words
from simc_core import NotIdentifiable, SimcError
from simc_core.figures import palette
from simc_core.figures.uncertain import peak_band_figure, response_band_figure
from simc_core.notation import rounded_up
from simc_core.reduction.records import LARGEST_MS
from simc_core.wording import joined

LIMITS = (1.4, 1.59, 1.7, 1.8, 2.0)
USUAL_LIMIT = 1.8
PROBABILITY = 0.95
IN_USE = 0.01  # relative: a tau_c so near is the one in use
HEIGHT = 300  # px


def measured_error_view(study: Study, design: Design) -> None:
    """Probabilities, a button that makes the loop safe, and the bands."""
    uncertainty = design.uncertainty
    Ms = peaks_of(uncertainty, study.controller)
    st.markdown(summary(Ms, [NAMES[each.structure] for each in uncertainty]))
    if study.tuned:
        _safe_tau_c(study, design)
    omega, S = sensitivity(uncertainty, study.controller)
    stable = np.isfinite(Ms)
    try:
        with st.spinner(words("Simulating plants that the record leaves open")):
            found = bands(study.loop, uncertainty, design.excitation)
    except SimcError as error:
        st.caption(sentence(str(error)))
        return
    if found.lost:
        st.caption(
            words(
                "{lost} of {n} plants give a loop that is not stable; they spoil the bands.",
                lost=found.lost,
                n=Ms.size,
            )
        )
    if len(found.family) < FEWEST:
        st.caption(words("The plants that the record leaves open are too far apart to draw bands."))
        return
    t, nominal = found.nominal.t, found.nominal
    family = [each.y for each in found.family]
    left, right = st.columns(2, gap="small")
    with left:
        figure = response_band_figure(t, nominal.y, family, palette.OUTPUT, palette.Y, nominal.r, height=HEIGHT)
        alt = words("Output y with the band in which it lies for the plants that the record leaves open")
        show(figure, "y_band", alt)
    with right:
        moves = [each.u for each in found.family]
        figure = response_band_figure(t, nominal.u, moves, palette.INPUT, palette.U, height=HEIGHT)
        show(figure, "u_band", words("Controller output u with its band"))
    if stable.sum() >= FEWEST:
        limit = float(state.widget("uncertain_limit", USUAL_LIMIT) or USUAL_LIMIT)
        figure = peak_band_figure(omega, S[0], S[stable], limit, HEIGHT)
        show(figure, "S_band", words("Sensitivity |S| with its band"))
    st.caption(words("Line: the model. Shaded: 9 of 10 plants drawn from the errors of the model at each instant."))


def summary(Ms: np.ndarray, titles: list[str]) -> str:
    """Ms and its probabilities in words.   titles: of the structures."""
    within = float(np.mean(Ms <= LARGEST_MS))
    high = float(np.quantile(Ms, PROBABILITY, method="higher"))
    probability = {"limit": LARGEST_MS, "probability": _per_cent(within)}
    lost = float(np.mean(~np.isfinite(Ms)))
    lines = [
        words(
            "$M_s$ ≤ {limit:g} with a probability of **{probability}**; not above **{high}** with 95 %.",
            high=number(high, 3),
            **probability,
        )
        if np.isfinite(high)
        else words("$M_s$ ≤ {limit:g} with a probability of **{probability}**.", **probability)
    ]
    if lost:
        lines.append(words("**Not stable** with a probability of {probability}.", probability=_per_cent(lost)))
    lines.append(words("Structures that fit the record: {structures}.", structures=joined(titles)))
    return " ".join(lines)


def _per_cent(share: float) -> str:
    """Of some hundred plants: nothing nearer than they can tell."""
    if share >= 0.995:
        return words("more than 99 %")
    if share <= 0.005:
        return words("less than 1 %") if share else "0 %"
    return f"{100 * share:.0f} %"


def _safe_tau_c(study: Study, design: Design) -> None:
    """A limit to choose, and the fastest tau_c that keeps it with 95 %."""
    place, act = st.columns([1, 3], gap="medium", vertical_alignment="bottom")
    limit = place.selectbox(
        words("Ms at most"),
        LIMITS,
        index=LIMITS.index(USUAL_LIMIT),
        key="uncertain_limit",
        format_func=lambda limit: numeral(f"{limit:g}"),
    )
    with act:
        try:
            tau_c = fastest(design.plant, design.tuning, design.uncertainty, limit, PROBABILITY)
        except NotIdentifiable as error:
            st.warning(sentence(str(error)))
            return
        except SimcError as error:
            st.caption(sentence(str(error)))
            return
        rounded = rounded_up(tau_c)
        told = {"tau_c": time_text(rounded, design.sheet), "limit": limit}
        if study.tau_c and abs(study.tau_c / rounded - 1) < IN_USE:
            st.caption(words("τc = {tau_c} keeps Ms ≤ {limit:g} with 95 %: it is in use.", **told))
            return
        st.button(
            words("τc = {tau_c}: Ms ≤ {limit:g} with 95 %", **told),
            key="safe_tau_c",
            on_click=lambda: state.change(tau_c=rounded),
        )
