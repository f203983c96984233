"""Settings of both controllers in all forms, to copy with all their digits."""

import streamlit as st

from pages.common.parts.copyable import copyable
from pages.common.parts.settings_text import FORMS_NAMED, NO_FORM, STRUCTURE, as_text
from pages.common.parts.symbols import symbols
from pages.common.session import state
from pages.common.studies.cascade import CascadeStudy
from pages.common.words import translated, words
from simc_core.controllers.forms import FORMS, Controller
from simc_core.errors import FormError
from simc_core.wording import said

OUTER = said("**Outer controller** $C_a$, {kind}, acts on $y_1$", kind="")
INNER = said("**Inner controller** $C_b$, {kind}, acts on $y_2$", kind="")


def settings(study: CascadeStudy) -> None:
    """A row for each controller, a column for each form."""
    for name, title, controller in (
        ("outer", OUTER.put(kind=study.cascade.outer), study.loop.outer),
        ("inner", INNER.put(kind=study.cascade.inner), study.loop.inner),
    ):
        st.markdown(translated(title))
        for place, form in zip(st.columns(len(FORMS), gap="small"), FORMS, strict=True):
            with place:
                _in_form(name, controller, form)
    st.caption(
        words(
            "$\\tau_F$ is the filter over the whole controller, as in $C(s)/(\\tau_F s+1)$. The inner controller acts "
            "on its error $r_2 - y_2$, so it has no set-point weight."
        )
    )


def _in_form(name: str, controller: Controller, form: str) -> None:
    st.markdown(f"{translated(FORMS_NAMED[form])}: ${STRUCTURE[form]}$")
    try:
        copyable(as_text(controller, form, state.design_now().sheet), f"settings_{name}_{form}")
    except FormError as error:
        st.info(symbols(NO_FORM[form].put(error=str(error))))
