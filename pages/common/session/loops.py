"""The loops a person works on: a list of designs, one of them in use. Pure: no streamlit.

A loop has an id that nobody sees, so that two tabs of a browser can keep their loops in one storage.
"""

import secrets
from dataclasses import dataclass, field, replace

from pages.common.session.design import Design
from simc_core.errors import InvalidParameter
from simc_core.wording import said

MOST_LOOPS = 50


def new_id() -> str:
    """An id that no other loop has."""
    return secrets.token_hex(6)


@dataclass(frozen=True, slots=True)
class Entry:
    """A loop of the list."""

    design: Design
    id: str = field(default_factory=new_id)


@dataclass(frozen=True, slots=True)
class Loops:
    """entries, and the place of the one in use. Raises InvalidParameter for none, too many, or a place outside."""

    entries: tuple[Entry, ...] = field(default_factory=lambda: (Entry(Design()),))
    current: int = 0

    def __post_init__(self):
        if not 1 <= len(self.entries) <= MOST_LOOPS:
            raise InvalidParameter(
                said(
                    "a list holds 1 to {most} loops, found {n}: delete one first", most=MOST_LOOPS, n=len(self.entries)
                )
            )
        if not 0 <= self.current < len(self.entries):
            raise InvalidParameter(
                said("the loop in use must be one of {most}, found {n}", most=len(self.entries), n=self.current + 1)
            )

    @property
    def design(self) -> Design:
        """The design in use."""
        return self.entries[self.current].design

    @property
    def ids(self) -> frozenset[str]:
        """Of all loops."""
        return frozenset(entry.id for entry in self.entries)

    @property
    def names(self) -> list[str]:
        """What the loops are called: their tags; without one, by number."""
        return [entry.design.sheet.tag or said("Loop {i}", i=i) for i, entry in enumerate(self.entries, 1)]

    def with_design(self, design: Design) -> "Loops":
        """The design in use replaced."""
        entries = list(self.entries)
        entries[self.current] = replace(entries[self.current], design=design)
        return replace(self, entries=tuple(entries))

    def added(self, design: Design) -> "Loops":
        """Another loop at the end, in use from now on."""
        return Loops((*self.entries, Entry(design)), len(self.entries))

    def duplicated(self) -> "Loops":
        """A copy of the loop in use, which then is in use; its tag says that it is one."""
        sheet = self.design.sheet
        tag = f"{sheet.tag[:33]} (copy)" if sheet.tag else ""
        return self.added(replace(self.design, sheet=replace(sheet, tag=tag)))

    def removed(self) -> "Loops":
        """Without the loop in use; where it was the only one, a fresh one takes its place."""
        left = self.entries[: self.current] + self.entries[self.current + 1 :]
        return Loops(left or (Entry(Design()),), min(self.current, max(len(left) - 1, 0)))

    def switched(self, current: int) -> "Loops":
        """Another loop in use."""
        return replace(self, current=current)

    def joined(self, kept: "Loops", opened: bool) -> "Loops":
        """Loops kept from an earlier visit, and those of this one.

        opened: whether this visit began with a link; its loop is then one more, unless a kept one is the same design.
        """
        if not opened:
            return kept
        same = next((i for i, entry in enumerate(kept.entries) if entry.design == self.design), None)
        if same is not None:
            return kept.switched(same)
        mine = self.entries[: MOST_LOOPS - len(kept.entries)]
        entries = (*kept.entries, *mine) if mine else (*kept.entries[1:], self.entries[self.current])
        return Loops(entries, len(entries) - 1)
