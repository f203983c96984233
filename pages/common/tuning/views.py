"""The views of the tuning page: what they are called, and which one is open."""

from pages.common.parts.tabs import open_tab
from pages.common.session import state
from simc_core.wording import said

LIVE, AS_BUILT = said("Live"), said("As built")
VIEWS = (LIVE, said("Bode of L"), said("Model error"), AS_BUILT, said("Compare"))
KEY = "views"


def opened() -> str:
    """The one that is open, by its name in English."""
    return open_tab(VIEWS, KEY)


def open_view(name: str) -> None:
    """Have this one open."""
    state.set_widget(KEY, name)
