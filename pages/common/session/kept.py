"""The loops that the browser keeps from one visit to the next: joined to those of the session, and told what is new."""

from pages.common.session import project, state
from pages.common.session.loops import Loops


def asked_browser() -> bool:
    """Whether the browser has told what it keeps."""
    return _kept_ids() is not None


def join_kept(text: str) -> None:
    """The loops that the browser has kept from earlier visits, once a session; what cannot be read is left alone."""
    if asked_browser():
        return
    kept, _ = project.load(text.encode(errors="surrogatepass"))  # half a character is refused there
    state.make_last("kept_ids", frozenset() if kept is None else kept.ids)
    if kept is not None:
        state.take_loops(state.loops().joined(kept, state.opened_by_link()))


def to_keep() -> tuple[str, list[str]]:
    """What the browser is to keep, as a project, and the ids that this session has had; once it was asked.

    A loop that was only opened by a link, or is the one every visit begins with, is not kept before it is changed.
    """
    loops, ids, first = state.loops(), _kept_ids() or frozenset(), state.first_seen()
    for entry in loops.entries:
        first.setdefault(entry.id, entry.design)
    mine = tuple(entry for entry in loops.entries if entry.id in ids or entry.design != first[entry.id])
    state.make_last("kept_ids", ids | {entry.id for entry in mine})
    current = next((i for i, entry in enumerate(mine) if entry.id == loops.entries[loops.current].id), 0)
    return (project.dump(Loops(mine, current)) if mine else ""), sorted(ids | loops.ids)


def _kept_ids() -> frozenset[str] | None:
    """Of the loops that the browser keeps; None before it was asked."""
    return state.lasting("kept_ids", lambda: None)
