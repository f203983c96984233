"""The design of this session: the only place for st.session_state and st.query_params.

One list of loops is the truth, and one Design of it is in use. Widgets show it and write to it (`bound`); the address
always shows it (`begin`). It survives page changes, and every page can be opened first or run alone, since defaults
are inside.

    design = state.begin()                                at the top of a page; header.show does it
    order = st.segmented_control("Model", (1, 2), **state.bound("order"))
    state.plant(), state.tuning(), state.cascade()        what is decided so far
    state.change(tau_c=7.5)                               from a button's callback, or before st.rerun()
"""

import threading
from collections.abc import Callable, Mapping
from dataclasses import replace
from time import monotonic
from typing import Any
from urllib.parse import urlencode

import streamlit as st
from streamlit.runtime.memory_uploaded_file_manager import MemoryUploadedFileManager
from streamlit.runtime.scriptrunner import get_script_run_ctx

from pages.common.session import links
from pages.common.session.cascade import Cascade
from pages.common.session.design import Design
from pages.common.session.fields import get, put
from pages.common.session.links import Ignored
from pages.common.session.loops import Loops
from pages.common.session.tuning import Tuning
from pages.common.words import language_is_told_by
from pages.common.words.catalogues import ENGLISH, OFFERED
from simc_core import Plant
from simc_core.wording import joined, said

# Seconds in which the browser has heard what a run put into a widget; nobody types the old value anew in it.
ANSWERED = 1.0
ON_ITS_WAY = 2.0  # seconds an address takes to reach the browser at most
_heard = threading.local()  # session and its language: asked for hundreds of times a run
SENT_AGAIN = 5.0  # seconds for which a value put into a widget may be overtaken; the first run of a server is slow


def begin(beside: tuple[str, ...] = ()) -> Design:
    """Read the address if it is new, then make it show the design. May be called more than once a run.

    beside: parameters that this page has beside those of the design, see `place`; on other pages they are unknown.
    """
    given, view, panel, lecture = _given()
    if view:
        st.session_state["asked_view"] = view
    if lecture:
        make_last("asked_lecture", {"view": view, "panel": panel, "on": "yes"})
    if beside != st.session_state.get("beside", ()):  # another page
        st.session_state["beside"] = beside
        st.session_state["place"], st.session_state["stands_for"] = {}, None
    if _is_new(given):
        st.session_state["ignored"] = _take_language(given)
        if beside:
            st.session_state["place"] = {name: given.pop(name) for name in beside if name in given}
        if given:
            design, ignored = links.decode(given)
            _keep(loops().with_design(design))
            st.session_state["ignored"] += ignored
            st.session_state.setdefault("opened", True)  # this visit began with a link
    st.session_state.setdefault("opened", False)
    _show_in_address()
    return design_now()


def begin_language() -> None:
    """Take the language of a new address into use: the router names the pages before one of them begins."""
    given, *_ = _given()
    if _is_new(given):
        _take_language(given)


def _given() -> tuple[dict[str, str], str, str, str]:
    """The address without what others have put there; and what it names beside the design: view, panel, lecture."""
    given = links.without_trackers(st.query_params.to_dict())
    return given, *(given.pop(name, "") for name in ("view", "panel", "lecture"))


def _is_new(given: dict[str, str]) -> bool:
    return bool(given) and given != st.session_state.get("address") and not _late(given)


def language() -> str:
    """The language of this session."""
    context = get_script_run_ctx(suppress_warning=True)
    if context is None:
        return ENGLISH
    if getattr(_heard, "session", None) != context.session_id:
        _heard.session, _heard.language = context.session_id, lasting("language", lambda: ENGLISH)
    return _heard.language


language_is_told_by(language)


def _take_language(given: dict[str, str]) -> list[Ignored]:
    """Take the language out of an address and into use; one that is not offered is ignored."""
    asked = given.pop("lang", "")
    if asked in OFFERED:
        _use(asked)
    elif asked:
        return [Ignored("lang", asked, said("the languages are {all}", all=joined(OFFERED)))]
    return []


def speak(chosen: str) -> None:
    """Another of the languages that are offered, from now on."""
    _use(chosen)
    _show_in_address()


def _use(chosen: str) -> None:
    make_last("language", chosen)
    _heard.session = None


def _language_in_address() -> dict[str, str]:
    return {} if language() == ENGLISH else {"lang": language()}


def place() -> dict[str, str]:
    """Where a page is, beside the design: the parameters that it told `begin`, as far as there are any."""
    return st.session_state.setdefault("place", {})


def go_to_place(**parameters: str) -> None:
    """Another place of the same page, which the address shows; none for its beginning."""
    st.session_state["place"] = parameters
    _show_in_address()


def place_stands_for(design: Design) -> None:
    """The design that the place opens by itself, so that an address need not hold it."""
    st.session_state["stands_for"] = design


def design_now() -> Design:
    """The whole design in use."""
    return loops().design


def loops() -> Loops:
    """All loops of this session."""
    if "loops" not in st.session_state:
        st.session_state["loops"] = Loops()
    return st.session_state["loops"]


def take_loops(changed: Loops) -> None:
    """Another list of loops, perhaps with another one in use; what pages remember of another design is forgotten."""
    if changed.design != loops().design:
        for name in [name for name in st.session_state if str(name).startswith("memory_")]:
            del st.session_state[name]
    _keep(changed)
    _show_in_address()


def begin_loop(plant: Plant, mine: bool) -> None:
    """A fresh design for this plant: instead of the present loop where nobody has changed that, else as another loop.

    mine: the plant was typed, so the loop is kept; an example is kept once it is changed.
    Raises InvalidParameter where the list is full.
    """
    fresh = replace(Design(), plant=plant, form=value("form"))
    take_loops(loops().with_design(fresh) if _untouched() else loops().added(fresh))
    first_seen()[loops().entries[loops().current].id] = Design() if mine else fresh


def add_loop(design: Design) -> None:
    """Another loop of the list, in use from now on, which is kept. Raises InvalidParameter where the list is full."""
    take_loops(loops().added(design))
    first_seen()[loops().entries[loops().current].id] = Design()


def first_seen() -> dict[str, Design]:
    """Each loop by its id, as this session first had it."""
    return st.session_state.setdefault("first_seen", {})


def opened_by_link() -> bool:
    """Whether this visit began with a link to a design."""
    return st.session_state.get("opened", False)


def _untouched() -> bool:
    entry = loops().entries[loops().current]
    return entry.design in (first_seen().get(entry.id), Design())


def _keep(changed: Loops) -> None:
    st.session_state["loops"] = changed


def plant() -> Plant:
    """The plant."""
    return design_now().plant


def tuning() -> Tuning:
    """order, h, tau_c, b, filter, rules."""
    return design_now().tuning


def cascade() -> Cascade:
    """Blocks and settings of the cascade page."""
    return design_now().cascade


def change(**values) -> None:
    """Change fields by their names in design.py: plant, order, tau_c, b, form, pins, Ga, Gb, method, and the others.

    Raises InvalidParameter and then changes nothing.
    """
    replace_design(with_changes(**values))


def with_changes(**values) -> Design:
    """The design with other fields, which is not yet in use. Raises InvalidParameter."""
    design = design_now()
    for name, value in values.items():
        design = put(design, name, value)
    return design


def replace_design(design: Design) -> None:
    """Take another design, for example from a project file."""
    _keep(loops().with_design(design))
    _show_in_address()


def value(name: str) -> Any:
    """A field by its name in design.py."""
    return get(design_now(), name)


def bound(
    name: str,
    show: Callable = lambda value: value,
    read: Callable = lambda value: value,
    key: str | None = None,
    optional: bool = False,
) -> dict[str, Any]:
    """Keyword arguments that tie a widget to a field: it shows the field and changes it.

    show: from the field to what the widget holds; read: back. A widget that gives None (an emptied selection)
    leaves the field as it is, or sets it to None where that is one of its values: optional. Values a widget can give
    must be within the field's bounds.   key: of the widget, where one field has several.
    """
    key = key or f"widget_{name}"
    set_widget(key, show(value(name)))
    return {"key": key, "on_change": _take, "args": (key, name, read, optional)}


def _take(key: str, name: str, read: Callable, optional: bool) -> None:
    given = st.session_state[key]
    if overtaken(key):
        return
    if given is not None:
        change(**{name: read(given)})
    elif optional:
        change(**{name: None})


def memory(name: str, start: Callable[[], Any]) -> Any:
    """Something a page remembers that is not part of the design, such as text being typed; `start` makes the first."""
    key = f"memory_{name}"
    if key not in st.session_state:
        st.session_state[key] = start()
    return st.session_state[key]


def remember(name: str, thing: Any) -> None:
    """Replace what `memory(name)` gives."""
    st.session_state[f"memory_{name}"] = thing


def lasting(name: str, start: Callable[[], Any]) -> Any:
    """As `memory`, for what belongs to this session and to no loop: another loop does not end it."""
    return st.session_state.setdefault(f"lasting_{name}", start())


def make_last(name: str, thing: Any) -> None:
    """Replace what `lasting(name)` gives."""
    st.session_state[f"lasting_{name}"] = thing


def forget_upload(upload: Any) -> None:
    """Give an uploaded file's memory back; Streamlit itself keeps every file until its session ends."""
    context = get_script_run_ctx()
    if context is not None and isinstance(context.uploaded_file_mgr, MemoryUploadedFileManager):
        context.uploaded_file_mgr.remove_file(context.session_id, upload.file_id)


def widget(key: str, default: Any = None) -> Any:
    """What the widget of this key holds now, for use in its callback."""
    return st.session_state.get(key, default)


def set_widget(key: str, thing: Any) -> None:
    """Put a value into the widget of this key, before it is made.

    Where the widget holds it already nothing is sent, so that typing that goes on is not overwritten. Only a value that
    was put in a moment ago is sent again: a run that overtook that one may have kept it from the browser. Not so that a
    field is empty at first: sent again, that would take away what somebody has begun to type.
    """
    sent = st.session_state.setdefault("sent", {})
    if key not in st.session_state or st.session_state[key] != thing:
        former = st.session_state.get(key, "")
        if key in st.session_state:
            replaced = st.session_state.setdefault("replaced", {})
            replaced[key] = former, monotonic() + ANSWERED
        st.session_state[key] = thing
        if former or thing:
            sent[key] = thing, monotonic() + SENT_AGAIN
    elif key in sent:
        first, until = sent[key]
        if first == thing and monotonic() < until:
            st.session_state[key] = thing
        else:
            del sent[key]


def begin_widget(key: str, thing: Any) -> None:
    """What the widget of this key holds at first. Streamlit objects to a `default` beside `set_widget`."""
    if key not in st.session_state:
        set_widget(key, thing)


def run_ended() -> None:
    """The router tells that a run has ended: what it put into widgets was sent, what they report now is new."""
    st.session_state["replaced"] = {}


def overtaken(key: str) -> bool:
    """Whether the widget of this key reports what a run has just replaced: the browser spoke before it heard of it.

    So it is where two messages come close together, and the second one ends the run that answers the first. For
    callbacks: to take such a report for an edit would undo what was decided in between.
    """
    former, until = st.session_state.get("replaced", {}).get(key, (None, 0.0))
    return monotonic() < until and st.session_state.get(key) == former


def asked_view() -> str:
    """The view that a link asked for, told once; empty for none."""
    return st.session_state.pop("asked_view", "")


def ignored() -> list[Ignored]:
    """What the last address held that could not be used."""
    return st.session_state.get("ignored", [])


def dismiss_ignored() -> None:
    """The user has read it."""
    st.session_state["ignored"] = []


def address(**more: str) -> str:
    """The address of this page with the design in it.   more: what else it names, such as a view."""
    base = (st.context.url or "").split("?")[0]
    own = [] if _is_told_by_place() else [links.query(design_now())]
    beside = urlencode(place() | _language_in_address() | more)
    return f"{base}?{'&'.join([*own, *([beside] if beside else [])])}"


def parameters() -> dict[str, str]:
    """The query parameters of the design, for links to other pages."""
    return links.encode(design_now()) | _language_in_address()


def offer_pages(pages: Mapping[str, Any]) -> None:
    """The router tells which pages there are."""
    st.session_state["pages"] = dict(pages)


def page(name: str) -> Any | None:
    """The page of this name, None if the present page runs alone, without the router."""
    return st.session_state.get("pages", {}).get(name)


def _late(given: dict[str, str]) -> bool:
    """Whether the browser still showed our former address when it asked, because the new one was on its way."""
    former, until = st.session_state.get("former_address", ({}, 0.0))
    return given == former and monotonic() < until


def _is_told_by_place() -> bool:
    return bool(place()) and st.session_state.get("stands_for") == design_now()


def _show_in_address() -> None:
    wanted = ({} if _is_told_by_place() else links.encode(design_now())) | place() | _language_in_address()
    if st.query_params.to_dict() != wanted:
        st.query_params.from_dict(wanted)
    shown = st.session_state.get("address")
    if shown != wanted:
        st.session_state["former_address"] = (shown, monotonic() + ON_ITS_WAY)
        st.session_state["address"] = wanted
