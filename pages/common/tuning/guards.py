"""What must not be overlooked, in words: advice on a design, and where the loop's poles lie."""

import streamlit as st

from pages.common.parts.structures import gains_apart
from pages.common.parts.symbols import spoken, symbols
from pages.common.parts.units import with_plain_unit
from pages.common.session import state
from pages.common.studies.single import Study
from pages.common.words import number, words
from simc_core.certificate.poles import ClosedLoopPole, dominant_poles
from simc_core.studies.advice import Advice, advice, in_words
from simc_core.studies.own_settings import advice_on_settings
from simc_core.wording import joined

PLACES = {"error": st.error, "warning": st.warning, "note": st.caption}


def show(study: Study) -> None:
    """Advice on the design, the gravest first; what it proposes is a button."""
    with st.container(key="guards", gap="xsmall"):
        origin = state.design_now().origin
        if origin is not None and origin.gains:
            st.warning(gains_apart(origin))
        for item in advice(study.tuned) if study.tuned else advice_on_settings(study.loop, study.margins):
            proposal(item)


def proposal(item: Advice) -> None:
    """One piece of advice; what it proposes is a button."""
    PLACES[item.level](told(item))
    if item.change:
        st.button(
            words("Take these settings") if "own" in item.change else spoken(in_words(item.change)),
            key=f"remedy_{item.quantity}",
            type="tertiary",
            icon=":material/arrow_forward:",
            on_click=state.change,
            kwargs=item.change,
        )


def told(item: Advice) -> str:
    """What is wrong, and what to do, for st.markdown."""
    remedy = (" *", item.remedy, "*") if item.remedy else ()
    return symbols(joined(("**", item.headline, ".** ", item.text, *remedy), ""))


def poles(study: Study) -> None:
    """Dominant closed-loop poles with their damping."""
    with st.expander(words("Dominant closed-loop poles")):
        unit = state.design_now().sheet.time_unit
        rows = [pole_row(pole, unit) for pole in dominant_poles(study.loop)]
        if rows:
            st.dataframe(rows, hide_index=True, width="content")
        else:
            st.caption(words("None can be shown of which it is certain that no other is further to the right."))
        st.caption(
            words(
                "Roots of $1 + L(s) = 0$, the rightmost of infinitely many; damping $\\zeta = -\\mathrm{Re}\\,s/|s|$. "
                "A pole that a zero of the controller cancels for set-point changes is still excited by load "
                "disturbances."
            )
        )


def pole_row(pole: ClosedLoopPole, unit: str = "") -> dict[str, str]:
    """A line of the table of poles; unit: of time."""
    s = pole.s
    return {
        words("pole"): number(s.real) + (f" ± {number(s.imag)} i" if s.imag else ""),
        words("damping ζ"): number(pole.zeta),
        with_plain_unit(words("frequency |s|"), unit and f"rad/{unit}"): number(pole.omega_n),
        with_plain_unit(words("time constant"), unit): number(-1 / s.real) if s.real < 0 else words("does not decay"),
        words("cancelled for set-point changes"): words("yes") if pole.cancelled else "",
    }
