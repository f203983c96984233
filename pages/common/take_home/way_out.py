"""A design that has no numbers in the form of a box: which boxes take it, and a design that this one takes."""

import streamlit as st

from pages.common.parts.refusals import explain_refusal
from pages.common.parts.sources import cited
from pages.common.parts.symbols import sentence
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.studies.single import Study
from pages.common.take_home.typed import typed_into
from pages.common.words import number, words
from simc_core import BOXES, Loop, SeriesPid, margins
from simc_core.controllers.forms import Controller, IController
from simc_core.errors import FormError, SimcError
from simc_core.studies.bands import band_of
from simc_core.wording import joined

MOST_NAMED = 4  # boxes; the others are in the list


def way_out(design: Design, present: Study, error: FormError) -> None:
    """Why the box does not take the design, and what can be done."""
    box, controller = BOXES[design.box], present.controller
    st.error(words("**{box} has no numbers for this controller.** {error}", box=box.title, error=sentence(str(error))))
    found = takers(controller, design)
    if found:
        boxes = joined([BOXES[key].title for key in found[:MOST_NAMED]], "; ")
        st.markdown(
            words("Boxes that take it as it is: {boxes}; and more.", boxes=boxes)
            if len(found) > MOST_NAMED
            else words("Boxes that take it as it is: {boxes}.", boxes=boxes)
        )
    theta = present.model.theta if present.model else design.plant.theta
    if not isinstance(controller, IController) or not theta:
        return
    instead = as_pi(controller, theta)
    with explain_refusal():
        Ms = margins(Loop(design.plant, instead)).Ms
        if band_of(Ms).tone == "alarm":
            return
        st.markdown(
            words(
                "Or a PI controller with the same integral gain and $\\tau_I = \\theta/3$, as in improved SIMC "
                "{source}: $M_s$ = {Ms} instead of {designed}.",
                source=cited("SG12"),
                Ms=number(Ms),
                designed=number(present.margins.Ms),
            )
        )
        st.button(
            words("Take this PI as my settings"),
            key="take_pi",
            on_click=state.change,
            kwargs={"own": instead.to_ideal(), "controller": "own"},
        )


def takers(controller: Controller, design: Design) -> list[str]:
    """Boxes that take the controller as it is."""
    return [key for key in BOXES if _takes(key, controller, design)]


def _takes(key: str, controller: Controller, design: Design) -> bool:
    try:
        typed_into(key, controller, design.sheet, False)
    except SimcError:
        return False
    return True


def as_pi(controller: IController, theta: float) -> SeriesPid:
    """A PI controller for pure dead time of the same integral gain: tau_I = theta/3, Kc = K_I theta/3 [SG12]."""
    return SeriesPid(controller.K_I * theta / 3, theta / 3)
