"""The lecture view: the one that a link or a button asks for, and the one that is on."""

from collections.abc import Callable

from pages.common.session import state


def ask_lecture() -> None:
    """As a link that says lecture=1."""
    state.make_last("asked_lecture", {"view": "", "panel": "", "on": "yes"})


def asked_lecture(leave: Callable[[str], bool] = lambda view: False) -> dict[str, str]:
    """View and panel of the lecture that was asked for, told once; empty for none.

    leave: whether a lecture of this view is for somebody else, who asks later.
    """
    asked = state.lasting("asked_lecture", dict)
    if not asked or leave(asked["view"]):
        return {}
    state.make_last("asked_lecture", {})
    return asked


def lecturing() -> dict[str, str]:
    """The lecture view of a page without an instrument: which page, view and panel; empty where there is none."""
    return state.lasting("lecture_on", dict)


def lecture_is(on: dict[str, str]) -> None:
    """Begin or, with nothing, end it."""
    state.make_last("lecture_on", on)
