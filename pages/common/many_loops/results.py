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
from pages.common.words import number, translated, typeset, words
from simc_core import Result
from simc_core.controllers.forms import Controller
from simc_core.many.report import summary, worth
from simc_core.many.results_csv import SOUND, cells, typed_text
from simc_core.notation import latex
from simc_core.wording import counted, joined, said

EVERY = 0.5  # seconds between two looks at the progress
SHOWN = {
    "all": said("All"),
    "not stable": said("Not stable now"),
    "fragile": said("Fragile now"),
    "slow oscillation": said("Slow oscillation now"),
    SOUND: said("Sound now"),
    "": said("No settings now"),
    "refused": said("Refused"),
}
NOW = {
    "not stable": said("not stable"),
    "fragile": said("fragile"),
    "slow oscillation": said("slow oscillation"),
    SOUND: said("sound"),
    "": said("not told"),
    "refused": said("refused"),
}
NUMBERS = {
    "load_ratio": said("load IAE now/new"),
    "Ms_now": said("Ms now"),
    "Ms": said("Ms new"),
    "Kc": "Kc",
    "tau_I": "τI",
    "tau_D": "τD",
}


def progress(work: Work) -> None:
    """The button, then how far it is, with a button to stop; the page runs again when it has ended."""
    job = work.job
    if job is None:
        st.button(
            translated(counted("Tune {n} loop", "Tune {n} loops", len(work.loops.rows))),
            type="primary",
            key="loops_begin",
            on_click=begin,
            args=(work,),
        )
    elif job.going:
        st.fragment(partial(_going, work), run_every=EVERY)()
    elif job.state == "stopped":
        st.warning(words("Stopped after {done} of {total} loops.", done=len(job.results), total=len(job.rows)))
        st.button(words("Begin again"), key="loops_begin", on_click=begin, args=(work,))
    elif job.state == "failed":
        st.error(
            words(
                "Something went wrong in this program after {done} of {total} loops.",
                done=len(job.results),
                total=len(job.rows),
            )
        )
        st.button(words("Begin again"), key="loops_begin", on_click=begin, args=(work,))


def _going(work: Work) -> None:
    job = work.job
    if job is None or not job.going:
        st.rerun()
    done, all_ = len(job.results), len(job.rows)
    if done == all_:
        waiting = words("Writing the report")
    elif job.state == "waiting":
        waiting = words("Waiting for another list to end")
    else:
        waiting = words("{done} of {total} loops", done=done, total=all_)
    st.progress(done / all_, waiting)
    st.button(words("Stop"), key="loops_stop", on_click=job.stop)


def browse(work: Work) -> None:
    """The results that are there."""
    if work.job is None or not work.job.results:
        return
    pairs = [(cells(result), result) for result in tuple(work.job.results)]
    pairs.sort(key=lambda pair: worth(pair[0]))
    lines = [line for line, _ in pairs]
    st.markdown(f"**{translated(summary(lines))}**")
    with st.container(horizontal=True, vertical_alignment="bottom", gap="small"):
        there = [key for key in SHOWN if key == "all" or any(_group(line) == key for line in lines)]
        shown = st.selectbox(
            words("Show"), there, format_func=lambda key: translated(SHOWN[key]), key="loops_show", width=220
        )
        wanted = st.text_input(words("Tag contains"), key="loops_tag", max_chars=40, width=180)
        if work.job.files:
            table, html = work.job.files
            st.download_button(words("Results"), table, "results.csv", "text/csv", on_click="ignore")
            st.download_button(words("Report"), html, "report.html", "text/html", on_click="ignore")
    found = [
        (line, result)
        for line, result in pairs
        if shown in (None, "all", _group(line)) and wanted.lower() in line["tag"].lower()
    ]
    if not found:
        st.caption(words("No loop is like this."))
        return
    boxes = any(line["typed"] for line, _ in found)
    chosen = st.dataframe(
        [_shown(line, result, boxes) for line, result in found],
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
        st.caption(words("Select a row to see all of a loop and to go on with it."))


def _group(line: dict[str, str]) -> str:
    return "refused" if line["refusal"] else line["now"]


def _shown(line: dict[str, str], result: Result, boxes: bool) -> dict[str, str | float | None]:
    """A row of the table."""
    found: dict[str, str | float | None] = {words("loop"): _name(line)}
    found[words("now")] = translated(NOW[_group(line)])
    found |= {
        translated(heading): float(f"{float(line[name]):.3g}") if line[name] else None
        for name, heading in NUMBERS.items()
    }
    look_at = result.refusal or (result.advice[0].headline if result.advice else "")
    found[words("look at")] = translated(look_at)
    return found | ({words("typed into the box"): translated(typed_text(result))} if boxes else {})


def _name(line: dict[str, str]) -> str:
    return line["tag"] or words("row {row}", row=line["row"])


def _sheet(line: dict[str, str], result: Result) -> None:
    """One loop: what was found, and the way to its tuning."""
    with st.container(border=True, key="loop_sheet"):
        st.markdown(f"**{exact(_name(line))}**")
        if result.refusal:
            st.error(told(result.refusal))
        if result.plant is not None:
            st.markdown(f"$G(s) = {typeset(latex(result.plant))}$")
        if result.controller is not None:
            st.markdown(words("New: {settings}", settings=_settings(result)))
        if result.present is not None:
            st.markdown(words("Now: {settings}", settings=_listed(result.present.controller)))
        if line["typed"]:
            typed = exact(line["typed"])
            st.markdown(
                words("In the box: {typed}, reverse acting", typed=typed)
                if line["action"] == "reverse"
                else words("In the box: {typed}, direct acting", typed=typed)
            )
        for each in result.advice:
            text = joined(filter(None, (each.text, each.remedy)), " ")
            st.caption(f"{symbols(told(each.headline))}: {sentence(told(text))}")
        if result.plant is not None and st.button(words("Open on the tuning page"), type="primary", key="loop_open"):
            with explain_refusal():
                state.add_loop(design_of(result))
                header.go("tuning")


def _settings(result: Result) -> str:
    assert result.controller is not None
    settings = _listed(result.controller)
    if result.margins is None or not result.margins.stable:
        return settings
    settings += f", $M_s$ = {number(result.margins.Ms, 3)}"
    if result.performance is None:
        return settings
    error = number(result.performance.disturbance.IAE, 3)
    return words("{settings}, load IAE {error}", settings=settings, error=error)


def _listed(controller: Controller) -> str:
    return symbols(", ".join(f"{name} = {number(value)}" for name, value in controller.settings.items()))
