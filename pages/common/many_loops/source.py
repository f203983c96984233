"""Where the list comes from, what was understood of it, and the button that begins."""

from dataclasses import dataclass

import streamlit as st

from pages.common.many_loops.job import Job
from pages.common.parts.foreign_text import exact, told
from pages.common.session import state
from simc_core import LoopList, SimcError, read_list
from simc_core.many.columns import BY_NAME
from simc_core.many.example import example
from simc_core.many.read_list import template

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
        f"A list of up to {MOST_ROWS} loops",
        type=KINDS,
        key=f"loops_file_{turn}",
        max_upload_size=LARGEST_MB,
        help="One row a loop. It is read here and forgotten with this session.",
    )
    if upload is not None:
        _take(upload.name, upload.getvalue())
        state.make_last(TURN, turn + 1)
        st.rerun()
    with st.container(horizontal=True, gap="small"):
        st.button("Try an example", key="loops_example", on_click=_take_example)
        st.download_button(
            "Template", template(), "loops.csv", "text/csv", help="Headings, units and five loops", on_click="ignore"
        )
    refused = state.lasting(REFUSED, lambda: None)
    if refused:
        name, why = refused
        st.error(f"{exact(name)} was not read, nothing changed: {told(why)}")
    return state.lasting(WORK, lambda: None)


def understood(work: Work) -> None:
    """Which columns were taken for what."""
    taken = {heading: name for heading, name in work.loops.columns.items() if name}
    left = [heading for heading, name in work.loops.columns.items() if not name]
    st.markdown(f"**{len(work.loops.rows)} loops** in {exact(work.name)}")
    rows = [{"column": heading, "taken as": name, "which is": BY_NAME[name].meaning} for heading, name in taken.items()]
    with st.expander(f"{len(taken)} columns understood", expanded=work.job is None):
        st.dataframe(rows, hide_index=True, width="stretch", height="content")
        if left:
            st.caption(f"Not used: {', '.join(map(exact, left))}")
        for note in work.loops.notes:
            st.caption(f"{note[0].upper()}{note[1:]}.")


def empty() -> None:
    """What to do where there is no list yet."""
    st.info(
        "Drop a list of loops: one row a loop, with k, theta and tau1, or a transfer function, and the settings it has "
        "now, where they are known. Out come new settings, what they bring, and a report, the most urgent loop first. "
        "Or try the example."
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
