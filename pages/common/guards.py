"""What must not be overlooked, in words: errors of the core, advice on a design, where the loop's poles lie."""

from collections.abc import Iterator
from contextlib import contextmanager

import streamlit as st

from pages.common.study import Study
from pages.common.symbols import sentence, symbols
from simc_core.certificate.poles import ClosedLoopPole, dominant_poles
from simc_core.errors import NotReducible, SimcError
from simc_core.notation import number
from simc_core.studies.advice import advice

STYLE = """<style>
.st-key-guards [data-testid="stAlertContainer"] {padding: 0.4rem 0.6rem}
.st-key-guards p {font-size: 0.85rem; line-height: 1.35}
</style>"""


@contextmanager
def spoken() -> Iterator[None]:
    """A SimcError raised inside is told in words, in place of the rest of the page."""
    try:
        yield
    except NotReducible as error:
        st.error(f"**The half rule does not cover this plant.** {sentence(str(error))}")
    except SimcError as error:
        st.error(f"**This design is not possible.** {sentence(str(error))}")


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
