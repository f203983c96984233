"""What the browser of one session holds: the time axis on the screen, and messages by what they tell. No streamlit."""

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field

from pages.common.shared import Shared
from pages.common.words import language

MOST_BYTES = 64_000_000  # a table has 0.1 to 1 MB
TABLES: Shared[bytes] = Shared(MOST_BYTES, len)
SHORT_OF, BEYOND = 0.35, 1.25  # of the horizon on the screen: a design that needs as much is still well shown on it


@dataclass(slots=True)
class Held:
    """subject: what is tuned.   end: of the time axis.   messages: name and bytes of each kind."""

    subject: Hashable = None
    end: float | None = None
    messages: dict[str, tuple[str, bytes]] = field(default_factory=dict)

    def end_for(self, subject: Hashable) -> float | None:
        """The end of the time axis on the screen, if it is this subject that stands there."""
        return self.end if self.subject == subject else None

    def message(self, kind: str, name: str, make: Callable[[], bytes]) -> bytes:
        """The message of this kind and name in the language in use; a release must not make the same again."""
        name = f"{name} {language()}"
        if self.messages.get(kind, ("",))[0] != name:
            self.messages[kind] = (name, TABLES.get(f"{kind} {name}", make))
        return self.messages[kind][1]


def kept_end(wanted: float, shown: float | None) -> float:
    """The end of the time axis: the one on the screen as long as what is wanted is still well shown on it."""
    return shown if shown and SHORT_OF <= wanted / shown <= BEYOND else wanted
