"""The record: PV, SP and OP, which part of it is fitted, and what is left out."""

from typing import Any

import streamlit as st

from pages.common.from_data.figure import show
from pages.common.from_data.work import ends_of, moves_of
from pages.common.parts.number_field import number_field
from pages.common.parts.symbols import symbols
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.session.record import MOST_BAD
from pages.common.words import number, translated, words
from simc_core import Identified, SimcError, Trend, checks
from simc_core.figures.trend import trend_figure
from simc_core.wording import said

HEIGHT, TALL = 360, 460  # px
BAD_PIECE = "bad_piece"
TURN = "from_data_drawn"
SHOWN = "from_data_shown"  # the ends of the record, and of what is drawn of it
ZOOM, CUT, LEAVE_OUT = DRAGS = (
    said("zooms", context="dragging on the record"),
    said("cuts to the range", context="dragging on the record"),
    said("leaves the range out", context="dragging on the record"),
)
ENDS = {"begin": said("From"), "end": said("To")}
BAD = {"from": said("Bad from"), "to": said("Bad to")}


def figure(trend: Trend, design: Design, part: Trend | None, model: Identified | None) -> None:
    """PV over OP, with the model and its residuals where there is one."""
    chosen = design.record
    cut = None if chosen.begin is None and chosen.end is None else _part(trend, design)
    fitted = None
    if model is not None and part is not None:  # of several records this one comes first
        fitted = part.t, model.predicted[: part.t.size], model.residuals[: part.t.size]
    of, shown = state.lasting(SHOWN, lambda: (None, None))
    shown = shown if of == ends_of(trend) else None
    moves = [move.t for move in moves_of(trend)]
    found = trend_figure(trend, cut, chosen.bad, moves, fitted, HEIGHT if fitted is None else TALL, shown)
    series = "PV, OP" if trend.r is None else "PV, SP, OP"
    span = f"{number(trend.span)} {trend.units.get('t', '')}"
    alt = (
        words("Record of {series} over {span} and the model with its residuals", series=series, span=span)
        if fitted
        else words("Record of {series} over {span}", series=series, span=span)
    )
    turn = state.lasting(TURN, lambda: 0)  # a fresh figure after each range that was drawn: nothing stays selected
    key = f"figure_trend_{turn}"
    drag = state.widget("drag_does", ZOOM)
    found["layout"] |= {"dragmode": "select", "selectdirection": "h"}
    pick: dict[str, Any] = {"on_select": lambda: _drawn(trend, key, turn, drag), "selection_mode": "box"}
    with st.container(key="figure_trend"):
        show(found, trend, key, "trend", alt, **pick)
    with st.container(horizontal=True, vertical_alignment="bottom"):
        st.segmented_control(
            words("Dragging on the record"),
            DRAGS,
            format_func=translated,
            default=ZOOM,
            required=True,
            key="drag_does",
        )
        if shown:
            st.button(words("Whole record"), key="whole_record", on_click=state.make_last, args=(SHOWN, (None, None)))


def choose_part(trend: Trend, design: Design) -> None:
    """From where to where: a slider to drag, and two fields to type."""
    low, high = ends_of(trend)
    begin, end = _part(trend, design)
    unit = trend.units.get("t", "")
    state.set_widget("part", (begin, end))
    places = st.columns([4, 1, 1], gap="small", vertical_alignment="bottom")
    places[0].slider(
        words("Part that is fitted"),
        low,
        high,
        key="part",
        step=(high - low) / 1000,
        format="%.5g",
        on_change=_take_part,
        args=(low, high),
    )
    for name, place, value in (("begin", places[1], begin), ("end", places[2], end)):
        number_field(
            translated(ENDS[name]),
            float(f"{value:.6g}"),
            lambda value, name=name: _check(trend, name, value),
            lambda value, name=name: state.change(**{name: value}),
            f"part_{name}",
            unit=unit,
            place=place,
            under=st.container(),
        )


def bad_pieces(trend: Trend, design: Design) -> None:
    """Stretches that are left out: two fields and a list to take them back from."""
    unit = trend.units.get("t", "")
    bad = design.record.bad
    title = words("Left out: {n}", n=len(bad)) if bad else words("Leave out a bad piece")
    with st.expander(title):
        given: dict[str, float] = state.lasting(BAD_PIECE, dict)
        places = st.columns([1, 1, 1], gap="small", vertical_alignment="bottom")
        for name, place in (("from", places[0]), ("to", places[1])):
            number_field(
                translated(BAD[name]),
                given.get(name),
                lambda value: None if value is None else checks.real(said("It"), value, *ends_of(trend)),
                lambda value, name=name: given.__setitem__(name, value),
                f"bad_{name}",
                unit=unit,
                optional=True,
                place=places[0] if name == "from" else place,
                under=st.container(),
            )
        full = len(bad) >= MOST_BAD
        places[2].button(
            words("Leave out"),
            key="leave_out",
            on_click=_leave_out,
            args=(trend, given),
            disabled=full,
            width="stretch",
        )
        why = state.lasting("bad_refused", str)
        if why:
            st.error(symbols(why))
        for i, (low, high) in enumerate(bad):
            label = words("Take back {low} to {high}", low=number(low), high=f"{number(high)} {unit}".rstrip())
            st.button(label, key=f"take_back_{i}", on_click=_take_back, args=(i,))


def _part(trend: Trend, design: Design) -> tuple[float, float]:
    low, high = ends_of(trend)
    begin, end = design.record.begin, design.record.end
    begin = low if begin is None else min(max(begin, low), high)
    end = high if end is None else min(max(end, low), high)
    return (begin, end) if begin < end else (low, high)


def _drawn(trend: Trend, key: str, turn: int, drag: str) -> None:
    """Callback: take the range that was drawn on the record."""
    boxes = state.widget(key)["selection"]["box"]
    if not boxes:
        return
    first, last = ends_of(trend)
    low, high = sorted(min(max(float(x), first), last) for x in boxes[0]["x"])
    if not low < high:
        return
    state.make_last(TURN, turn + 1)
    if drag == ZOOM:  # drawn anew, with all that the record has there
        state.make_last(SHOWN, ((first, last), (low, high)))
    elif drag == CUT:
        state.change(begin=None, end=None)
        state.change(begin=low if low > first else None, end=high if high < last else None)
    elif len(state.value("bad")) < MOST_BAD:
        _leave_out(trend, {"from": low, "to": high})


def _take_part(low: float, high: float) -> None:
    if state.overtaken("part"):
        return
    begin, end = state.widget("part")
    if begin < end:
        state.change(begin=None, end=None)
        state.change(begin=begin if begin > low else None, end=end if end < high else None)


def _check(trend: Trend, name: str, value: float | None) -> None:
    low, high = ends_of(trend)
    checks.real(ENDS[name], value, low, high)
    state.with_changes(**{name: value})


def _leave_out(trend: Trend, given: dict[str, float]) -> None:
    why = ""
    low, high = given.get("from"), given.get("to")
    try:
        if low is None or high is None or not low < high:
            raise SimcError(said("both ends are needed, the second after the first"))
        bad = (*state.value("bad"), (low, high))
        trend.without(low, high)
        state.change(bad=bad)
        given.clear()
    except SimcError as error:
        why = str(error)
    state.make_last("bad_refused", why)


def _take_back(i: int) -> None:
    bad = state.value("bad")
    state.change(bad=bad[:i] + bad[i + 1 :])
