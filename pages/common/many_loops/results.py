"""Results to browse: what is urgent first, filtered, one loop opened, and both files to take home."""

from collections.abc import Sequence
from functools import partial

import streamlit as st

from pages.common.many_loops.as_design import design_of
from pages.common.many_loops.source import Work, begin
from pages.common.parts.foreign_text import exact, told
from pages.common.parts.large import roomy
from pages.common.parts.refusals import explain_refusal
from pages.common.parts.symbols import sentence, symbols
from pages.common.session import state
from pages.common.shell import header
from simc_core import Result
from simc_core.many.report import summary, worth
from simc_core.many.results_csv import SOUND, cells
from simc_core.notation import latex, number

EVERY = 0.5  # seconds between two looks at the progress
SHOWN = {
    "all": "All",
    "not stable": "Not stable now",
    "fragile": "Fragile now",
    "slow oscillation": "Slow oscillation now",
    SOUND: "Sound now",
    "": "No settings now",
    "refused": "Refused",
}
NUMBERS = {
    "load_ratio": "load IAE now/new",
    "Ms_now": "Ms now",
    "Ms": "Ms new",
    "Kc": "Kc",
    "tau_I": "τI",
    "tau_D": "τD",
}


def progress(work: Work) -> None:
    """The button, then how far it is, with a button to stop; the page runs again when it has ended."""
    job = work.job
    if job is None:
        st.button(f"Tune {len(work.loops.rows)} loops", type="primary", key="loops_begin", on_click=begin, args=(work,))
    elif job.going:
        st.fragment(partial(_going, work), run_every=EVERY)()
    elif job.state == "stopped":
        st.warning(f"Stopped after {len(job.results)} of {len(job.rows)} loops.")
        st.button("Begin again", key="loops_begin", on_click=begin, args=(work,))
    elif job.state == "failed":
        st.error(f"Something went wrong in this program after {len(job.results)} of {len(job.rows)} loops.")
        st.button("Begin again", key="loops_begin", on_click=begin, args=(work,))


def _going(work: Work) -> None:
    job = work.job
    if job is None or not job.going:
        st.rerun()
    done, all_ = len(job.results), len(job.rows)
    waiting = "Waiting for another list to end" if job.state == "waiting" else f"{done} of {all_} loops"
    waiting = "Writing the report" if done == all_ else waiting
    st.progress(done / all_, waiting)
    st.button("Stop", key="loops_stop", on_click=job.stop)


def browse(work: Work) -> None:
    """The results that are there."""
    if work.job is None or not work.job.results:
        return
    pairs = [(cells(result), result) for result in tuple(work.job.results)]
    pairs.sort(key=lambda pair: worth(pair[0]))
    lines = [line for line, _ in pairs]
    st.markdown(f"**{summary(lines)}**")
    with st.container(horizontal=True, vertical_alignment="bottom", gap="small"):
        there = [key for key in SHOWN if key == "all" or any(_group(line) == key for line in lines)]
        shown = st.selectbox("Show", there, format_func=SHOWN.get, key="loops_show", width=220)
        wanted = st.text_input("Tag contains", key="loops_tag", max_chars=40, width=180)
        if work.job.files:
            table, html = work.job.files
            st.download_button("Results", table, "results.csv", "text/csv", on_click="ignore")
            st.download_button("Report", html, "report.html", "text/html", on_click="ignore")
    found = [
        (line, result)
        for line, result in pairs
        if shown in (None, "all", _group(line)) and wanted.lower() in line["tag"].lower()
    ]
    if not found:
        st.caption("No loop is like this.")
        return
    boxes = any(line["typed"] for line, _ in found)
    chosen = st.dataframe(
        [_shown(line, boxes) for line, _ in found],
        placeholder="–",
        hide_index=True,
        width="stretch",
        height=roomy(min(36 * len(found) + 40, 420)),
        on_select="rerun",
        selection_mode="single-row",
        key=f"loops_table_{shown}_{wanted}_{len(found)}",
    )
    selected: Sequence[int] = chosen.selection.rows
    if selected and selected[0] < len(found):
        _sheet(*found[selected[0]])
    else:
        st.caption("Select a row to see all of a loop and to go on with it.")


def _group(line: dict[str, str]) -> str:
    return "refused" if line["refusal"] else line["now"]


def _shown(line: dict[str, str], boxes: bool) -> dict[str, str | float | None]:
    """A row of the table."""
    found: dict[str, str | float | None] = {"loop": line["tag"] or f"row {line['row']}"}
    found["now"] = "refused" if line["refusal"] else line["now"] or "not told"
    found |= {heading: float(f"{float(line[name]):.3g}") if line[name] else None for name, heading in NUMBERS.items()}
    found["look at"] = line["refusal"] or line["advice"].split(": ")[0]
    return found | ({"typed into the box": line["typed"]} if boxes else {})


def _sheet(line: dict[str, str], result: Result) -> None:
    """One loop: what was found, and the way to its tuning."""
    with st.container(border=True, key="loop_sheet"):
        st.markdown(f"**{exact(line['tag'] or 'row ' + line['row'])}**")
        if result.refusal:
            st.error(told(result.refusal))
        if result.plant is not None:
            st.markdown(f"$G(s) = {latex(result.plant)}$")
        if result.controller is not None:
            st.markdown(f"New: {_settings(result)}")
        if result.present is not None:
            values = result.present.controller.settings.items()
            st.markdown(symbols("Now: " + ", ".join(f"{name} = {number(value)}" for name, value in values)))
        if line["typed"]:
            st.markdown(f"In the box: {exact(line['typed'])}, {line['action']} acting")
        for each in result.advice:
            st.caption(f"{symbols(told(each.headline))}: {sentence(told(f'{each.text} {each.remedy}'))}")
        if result.plant is not None and st.button("Open on the tuning page", type="primary", key="loop_open"):
            with explain_refusal():
                state.add_loop(design_of(result))
                header.go("tuning")


def _settings(result: Result) -> str:
    assert result.controller is not None
    text = symbols(", ".join(f"{name} = {number(value)}" for name, value in result.controller.settings.items()))
    if result.margins is None or not result.margins.stable:
        return text
    text += f", $M_s$ = {number(result.margins.Ms, 3)}"
    if result.performance is not None:
        text += f", load IAE {number(result.performance.disturbance.IAE, 3)}"
    return text
