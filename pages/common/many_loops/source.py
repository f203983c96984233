"""Where the list comes from, what was understood of it, and the button that begins."""

from dataclasses import dataclass

import streamlit as st

from pages.common.many_loops.job import Job
from pages.common.parts.foreign_text import exact, told
from pages.common.session import state
from pages.common.words import capitalised, translated, words
from simc_core import LoopList, SimcError, read_list
from simc_core.many.columns import BY_NAME
from simc_core.many.example import example
from simc_core.many.read_list import template
from simc_core.wording import counted

MOST_ROWS = 2000
LARGEST_MB = 5
KINDS = ["csv", "txt", "tsv", "xlsx", "xls", "ods"]
WORK, REFUSED, TURN = "many", "many_refused", "many_turn"


@dataclass(slots=True)
class Work:
    """A list that was read, and the job on it once that has begun."""

    name: str
    loops: LoopList
    job: Job | None = None


def choose() -> Work | None:
    """Widgets for a file and the example; the list that is worked on, None for none."""
    turn = state.lasting(TURN, lambda: 0)  # a fresh field each time: the file is read once and then forgotten
    upload = st.file_uploader(
        words("A list of up to {most} loops", most=MOST_ROWS),
        type=KINDS,
        key=f"loops_file_{turn}",
        max_upload_size=LARGEST_MB,
        help=words("One row a loop. It is read here and forgotten with this session."),
    )
    if upload is not None:
        _take(upload.name, upload.getvalue())
        state.make_last(TURN, turn + 1)
        st.rerun()
    with st.container(horizontal=True, gap="small"):
        st.button(words("Try an example"), key="loops_example", on_click=_take_example)
        st.download_button(
            words("Template"),
            template(),
            "loops.csv",
            "text/csv",
            help=words("Headings, units and five loops"),
            on_click="ignore",
        )
    refused = state.lasting(REFUSED, lambda: None)
    if refused:
        name, why = refused
        st.error(words("{file} was not read, nothing changed: {why}", file=exact(name), why=told(why)))
    return state.lasting(WORK, lambda: None)


def understood(work: Work) -> None:
    """Which columns were taken for what."""
    taken = {heading: name for heading, name in work.loops.columns.items() if name}
    left = [heading for heading, name in work.loops.columns.items() if not name]
    st.markdown(
        translated(
            counted("**{n} loop** in {file}", "**{n} loops** in {file}", len(work.loops.rows), file=exact(work.name))
        )
    )
    rows = [
        {words("column"): heading, words("taken as"): name, words("which is"): translated(BY_NAME[name].meaning)}
        for heading, name in taken.items()
    ]
    columns = translated(counted("{n} column understood", "{n} columns understood", len(taken)))
    with st.expander(columns, expanded=work.job is None):
        st.dataframe(rows, hide_index=True, width="stretch", height="content")
        if left:
            st.caption(words("Not used: {headings}", headings=", ".join(map(exact, left))))
        for note in work.loops.notes:
            st.caption(f"{capitalised(translated(note))}.")


def empty() -> None:
    """What to do where there is no list yet."""
    st.info(
        words(
            "Drop a list of loops: one row a loop, with k, theta and tau1, or a transfer function, and the settings it "
            "has now, where they are known. Out come new settings, what they bring, and a report, the most urgent loop "
            "first. Or try the example."
        )
    )


def _take(name: str, content: bytes) -> None:
    """Work on this; what is no list changes nothing, and the reason stays."""
    try:
        loops = read_list(content, MOST_ROWS)
    except SimcError as error:
        state.make_last(REFUSED, (name, str(error)))
        return
    former: Work | None = state.lasting(WORK, lambda: None)
    if former is not None and former.job is not None:
        former.job.stop()
    state.make_last(WORK, Work(name, loops))
    state.make_last(REFUSED, None)


def _take_example() -> None:
    _take("example.csv", example().encode())
    begin(state.lasting(WORK, lambda: None))


def begin(work: Work) -> None:
    """Start the job."""
    work.job = Job(work.loops.rows, work.name)
