"""Settings and plants that are dragged by hand: knobs, figures and panels; exact on release."""

from pages.common.live.hand import table
from pages.common.live.hand.turned import Turned, moved, shown
from pages.common.session import state
from pages.common.studies.single import Study, study_of_settings

KEYS = {True: "live_settings", False: "live_plant"}


def hand_instrument(present: Study, behind: list[tuple[str, Study]], settings: bool) -> Study:
    """Knobs of the controller's settings, or of the plant with its controller kept.

    behind: designs that are drawn behind, by name. Returns the study of where the knobs are.
    Settings that are dragged become my settings; a plant that is dragged is a question and changes nothing.
    """
    key = KEYS[settings]
    held = state.memory(key, Turned)
    if not held.stands_on(present.loop.plant, present.controller):
        held.put(table.Subject(present.loop.plant, present.controller, settings))
    excitation = state.design_now().excitation
    shown("hand", key, behind, excitation, lambda release: moved(key, release, settings))
    return study_of_settings(held.loop.plant, held.loop.controller)


def put_back() -> None:
    """The plant as it is."""
    held = state.memory(KEYS[False], Turned)
    if held.subject is not None:
        held.values = table.values_of(held.subject)
