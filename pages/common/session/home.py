"""How a design is taken home: what is decided beside the box itself. Pure: no streamlit."""

from dataclasses import dataclass

from pages.common.session.sheet import one_of
from simc_core.implementation.exports.export import LANGUAGES

ROUNDINGS = ("safe", "none")
EXPORTED = ("design", "typed")


@dataclass(frozen=True, slots=True)
class Home:
    """rounding: of what is typed into a box, to its safe side, or none.   language: of the exported controller.

    exported: whether that is the design, or what is typed into the box.
    """

    rounding: str = "safe"
    language: str = "python"
    exported: str = "design"

    def __post_init__(self):
        one_of("rounding", self.rounding, ROUNDINGS)
        one_of("language", self.language, LANGUAGES)
        one_of("exported", self.exported, EXPORTED)
