"""Where the record comes from: a file, a paste, or an example that the program makes."""

import streamlit as st

from pages.common.from_data.examples import EXAMPLES
from pages.common.from_data.record_view import BAD_PIECE
from pages.common.from_data.work import Work, work_on, work_on_example
from pages.common.parts.foreign_text import exact, told
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.session.record import Chosen
from pages.common.words import translated, words
from simc_core import SimcError
from simc_core.wording import said

LONGEST_PASTE = 500_000  # characters; what one message of a browser may hold is twice as much
LARGEST_MB = 20
KINDS = ["csv", "txt", "tsv", "log", "dat", "xlsx", "xls", "xlsb", "ods"]
WORK, REFUSED, TURN = "from_data", "from_data_refused", "from_data_turn"
ADD = "add_record"  # the switch that keeps what is there
MOST_RECORDS = 10


def choose(design: Design) -> Work | None:
    """Widgets for a file, a paste and examples; the record that is worked on, None for none."""
    _follow_link(design.record.example)
    work: Work | None = state.lasting(WORK, lambda: None)
    turn = state.lasting(TURN, lambda: 0)  # a fresh field each time: nothing of a file or a paste stays in it
    uploads = st.file_uploader(
        words("Files with time, PV, OP"),
        type=KINDS,
        key=f"trend_file_{turn}",
        accept_multiple_files=True,
        max_upload_size=LARGEST_MB,
        help=words(
            "With SP where there is one. Several tests of one process are fitted together. They are read on this "
            "server and forgotten with this session."
        ),
    )
    if work is not None:
        st.toggle(
            words("Add to the record that is here"),
            key=ADD,
            help=words("Records of one process are fitted together."),
        )
    if uploads:
        _read([(upload.name, upload.getvalue()) for upload in uploads])
        for upload in uploads:
            state.forget_upload(upload)
        state.make_last(TURN, turn + 1)
        st.rerun()
    with st.expander(words("Paste")), st.form("paste", border=False):
        pasted = st.text_area(
            words("Rows of a spreadsheet, with or without names above"),
            key=f"trend_paste_{turn}",
            height=120,
            max_chars=LONGEST_PASTE,
            placeholder="Time\tPV\tOP\n0\t20.5\t40\n1\t20.5\t45",
        )
        if st.form_submit_button(words("Read", context="button"), width="stretch"):
            if _read([(said("pasted rows"), (pasted or "") + "\n")]):
                state.make_last(TURN, turn + 1)
            st.rerun()
    state.set_widget("example", work.example if work and work.example else None)
    st.selectbox(
        words("Or an example"),
        list(EXAMPLES),
        format_func=lambda key: translated(EXAMPLES[key].title),
        index=None,
        placeholder=words("Choose one to try"),
        key="example",
        on_change=_take_example,
    )
    _refusal()
    return state.lasting(WORK, lambda: None)


def _follow_link(example: str) -> None:
    """A link names an example: it is made, unless it is there."""
    work: Work | None = state.lasting(WORK, lambda: None)
    if example and (work is None or work.example != example):
        try:
            state.make_last(WORK, work_on_example(example))
        except SimcError as error:
            state.make_last(REFUSED, [(said("the link"), str(error))])
            state.change(example="")


def _take_example() -> None:
    if state.overtaken("example"):
        return
    key = state.widget("example")
    if key:
        _begin_example(key)


def _begin_example(key: str) -> None:
    state.make_last(REFUSED, [])
    state.make_last(WORK, work_on_example(key))
    state.make_last(BAD_PIECE, {})
    state.change(example=key, begin=None, end=None, bad=(), structure="")


def _read(given: list[tuple[str, bytes | str]]) -> bool:
    """Work on these; what is no trend changes nothing, and the reason stays. Returns whether one was read."""
    here: Work | None = state.lasting(WORK, lambda: None)
    found: list[Work] = []
    refused: list[tuple[str, str]] = []
    kept = [here, *here.beside] if here is not None and state.widget(ADD) else []
    for name, content in given:
        try:
            if len(kept) + len(found) >= MOST_RECORDS:
                raise SimcError(said("at most {most} records are fitted together", most=MOST_RECORDS))
            found.append(work_on(name, content))
        except SimcError as error:
            refused.append((name, str(error)))
    state.make_last(REFUSED, refused)
    if not found:
        return False
    state.make_last(BAD_PIECE, {})
    if kept:
        kept[0].beside += found
        return True
    first, *others = found
    first.beside = others
    state.make_last(WORK, first)
    state.change(example="", begin=None, end=None, bad=(), structure="")
    return True


def beside(work: Work, design: Design) -> None:
    """The records that are fitted along: each can be shown instead, or taken out."""
    if not work.beside:
        return
    st.markdown(words("**Fitted together with** (record 1 is the one that is shown)"))
    along = work.along()
    for i, other in enumerate(along):
        with st.container(key=f"beside_{i}", horizontal=True, gap="small", vertical_alignment="center"):
            name = exact(translated(other.name))
            shown = words("Record {i}: {name}", i=other.number, name=name) if other.number else name
            st.markdown(shown, width="stretch")
            st.button(words("Show"), key=f"show_{i}", on_click=_show, args=(work, i, design.record))
            st.button(words("Remove"), key=f"remove_{i}", on_click=work.beside.pop, args=(i,))
    for other in along:
        if other.part is None:
            st.warning(
                words("{name} is not fitted along: {why}", name=exact(translated(other.name)), why=told(other.why))
            )


def _show(work: Work, i: int, chosen: Chosen) -> None:
    other = work.shown_instead(i, chosen)
    state.make_last(WORK, other)
    state.make_last(BAD_PIECE, {})
    of = other.chosen
    state.change(example=other.example, begin=None, end=None, bad=of.bad)
    state.change(begin=of.begin, end=of.end)


def _refusal() -> None:
    for name, why in state.lasting(REFUSED, list) or ():
        st.error(words("{name} was not read, nothing changed: {why}", name=exact(translated(name)), why=told(why)))


def empty() -> None:
    """What to do where there is no record yet."""
    st.info(
        words(
            "Upload or paste a record of a step test: time, the measurement (PV) and the controller output (OP). A "
            "record in closed loop serves too, if the set point moved. Or choose an example to try:"
        )
    )
    with st.container(key="some_examples"):
        for key, example in EXAMPLES.items():
            with st.container(border=True, gap="xsmall"):
                st.button(
                    translated(example.title), key=f"try_{key}", on_click=_begin_example, args=(key,), width="stretch"
                )
                st.caption(
                    words("{note} Made with {truth}.", note=translated(example.note), truth=translated(example.truth))
                )
