"""What must not be overlooked, in words: advice on a design, and where the loop's poles lie."""

import streamlit as st

from pages.common.parts.refusals import STYLE
from pages.common.parts.symbols import symbols
from pages.common.studies.single import Study
from simc_core.certificate.poles import ClosedLoopPole, dominant_poles
from simc_core.notation import number
from simc_core.studies.advice import advice


def show(study: Study) -> None:
    """Advice on the design: warnings open, notes folded below them."""
    judged = study.margins
    found = advice(study.model, study.controller, judged.Ms, judged.PM_deg, study.tau_c, study.reduction)
    st.html(STYLE)
    with st.container(key="guards", gap="xsmall"):
        if not study.stable:
            st.error("**The loop is not stable**, so it has neither margins nor metrics. *Increase $\\tau_c$.*")
        for item in found:
            text = symbols(f"**{item.quantity}**, limit {item.limit}. {item.text} *{item.remedy}*")
            (st.warning if item.level == "warning" else st.caption)(text)


def poles(study: Study) -> None:
    """Dominant closed-loop poles with their damping."""
    with st.expander("Dominant closed-loop poles"):
        rows = [pole_row(pole) for pole in dominant_poles(study.loop)]
        st.dataframe(rows, hide_index=True, width="content")
        st.caption(
            "Roots of $1 + L(s) = 0$, the rightmost of infinitely many; damping $\\zeta = -\\mathrm{Re}\\,s/|s|$. "
            "A pole that a zero of the controller hides from set-point steps is still excited by load disturbances."
        )


def pole_row(pole: ClosedLoopPole) -> dict[str, str]:
    """A line of the table of poles."""
    s = pole.s
    return {
        "pole": number(s.real) + (f" ± {number(s.imag)} i" if s.imag else ""),
        "damping ζ": number(pole.zeta),
        "frequency |s|": number(pole.omega_n),
        "time constant": number(-1 / s.real) if s.real < 0 else "does not decay",
        "hidden from r": "yes" if pole.cancelled else "",
    }
