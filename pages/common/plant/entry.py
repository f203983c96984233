"""Entering a plant: one line of text, a table of factors, polynomials, or an example; all describe the same plant.

Each way keeps a draft of what is being typed. A draft that is a plant becomes the plant at once; one that is not
stays as typed with the reason below it, and the last good plant stays too. A plant that comes from elsewhere
(another way, an example, a link, a project file) replaces the draft.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

import pandas as pd
import streamlit as st

from pages.common.parts.foreign_text import block, told
from pages.common.plant import rows as entries
from pages.common.session import state
from simc_core import Plant, parse_plant
from simc_core.errors import ParseError, SimcError
from simc_core.notation import plain
from simc_core.plants.examples import EXAMPLES

WAYS = ("Text", "Factors", "Polynomials", "Examples")
PAUSE = "400ms"  # of typing, after which the text is read
SHOWN = "%.10g"


@dataclass(slots=True)
class _Draft:
    """What is typed in one way of entry. plant: the last good one it stood for; version: counts fresh tables."""

    plant: Plant
    fields: dict
    error: SimcError | None = None
    version: int = field(default=0)


def plant_entry(name: str = "plant", title: str = "plant") -> Plant:
    """Widgets to enter the plant called `name` in links.py (plant, Ga or Gb). Returns the last good one."""
    way = st.segmented_control(
        f"Enter the {title} as", WAYS, default=WAYS[0], required=True, key=f"{name}_way", persist_state="session"
    )
    {"Text": _text, "Factors": _factors, "Polynomials": _polynomials, "Examples": _examples}[way](name)
    return state.value(name)


def _text(name: str) -> None:
    draft = _draft(name, "text", lambda plant: {"text": plain(plant)})
    _typed(name, "text", draft, "text", st.text_input)(
        "Transfer function",
        live=PAUSE,
        help="As on paper: (1-2s)/((10s+1)(6s+1)(s+1)), exp(-3s)/((6s+1)(4s+1)), 2 e^{-0.5s}/(s(3s+1)^2), "
        "1/(s^2+0.6s+1). A decimal comma is understood.",
    )
    _complaint(draft)


def _polynomials(name: str) -> None:
    def start(plant: Plant) -> dict:
        num, den = entries.polynomials_of(plant)
        return {"num": num, "den": den, "theta": plant.theta}

    draft = _draft(name, "polynomials", start)
    how = "Coefficients in descending powers of s, separated by blanks: 1 3 2 is s² + 3s + 2."
    _typed(name, "polynomials", draft, "num", st.text_input)("Numerator", live=PAUSE, help=how)
    _typed(name, "polynomials", draft, "den", st.text_input)("Denominator", live=PAUSE, help=how)
    _typed(name, "polynomials", draft, "theta", st.number_input)("Dead time θ", format=SHOWN, step=None)
    _complaint(draft)


def _factors(name: str) -> None:
    def start(plant: Plant) -> dict:
        return {"k": plant.k, "theta": plant.theta, "rows": entries.rows_of(plant)}

    draft = _draft(name, "factors", start)
    gain, delay = st.columns(2)
    _typed(name, "factors", draft, "k", gain.number_input)("Gain k", format=SHOWN, step=None)
    _typed(name, "factors", draft, "theta", delay.number_input)("Dead time θ", format=SHOWN, step=None)
    key = _table_key(name, draft)
    if state.widget(key) is None:  # the table was not on the last page shown and has lost its edits: a fresh one
        draft.version += 1
        draft.fields["rows"] = entries.rows_of(draft.plant)
        key = _table_key(name, draft)
    st.data_editor(
        _frame(draft.fields["rows"]),
        key=key,
        num_rows="dynamic",
        hide_index=True,
        width="stretch",
        on_change=_take,
        args=(name, "factors"),
        column_config={
            "factor": st.column_config.SelectboxColumn("Factor", options=entries.FACTORS, width=170),
            "tau": st.column_config.NumberColumn("τ", format=SHOWN, width=70),
            "zeta": st.column_config.NumberColumn("ζ", format=SHOWN, width=60),
        },
    )
    st.caption("τ < 0: unstable pole, or a zero in the right half plane. ζ for pairs only.")
    _complaint(draft)


def _examples(name: str) -> None:
    titles = [example.name for example in EXAMPLES]
    key = f"{name}_example"
    here = next((i for i, example in enumerate(EXAMPLES) if example.plant == state.value(name)), None)
    state.set_widget(key, None if here is None else titles[here])
    st.selectbox(
        "From the literature", titles, key=key, placeholder="Choose one", on_change=_take_example, args=(name, key)
    )
    if here is not None:
        st.caption(EXAMPLES[here].source)


def _take_example(name: str, key: str) -> None:
    chosen = state.widget(key)
    plant = next(example.plant for example in EXAMPLES if example.name == chosen)
    state.change(**{name: plant})


def _draft(name: str, way: str, start: Callable[[Plant], dict]) -> _Draft:
    """The draft of this way, made anew if the plant has changed elsewhere."""
    plant = state.value(name)
    draft = state.memory(f"{name}_{way}", lambda: _Draft(plant, start(plant)))
    if draft.plant != plant:
        draft.plant, draft.fields, draft.error, draft.version = plant, start(plant), None, draft.version + 1
    return draft


def _typed(name: str, way: str, draft: _Draft, part: str, make: Callable) -> Callable:
    """`make` with the arguments that tie it to one field of the draft."""
    key = f"{name}_{way}_{part}"
    state.set_widget(key, draft.fields[part])

    def widget(label: str, **options) -> None:
        make(label, key=key, on_change=_take, args=(name, way, part, key), **options)

    return widget


def _take(name: str, way: str, part: str | None = None, key: str | None = None) -> None:
    """Callback: read the draft after a change of one field, or of the table."""
    draft = state.memory(f"{name}_{way}", lambda: None)
    if part is not None:
        draft.fields[part] = state.widget(key)
    try:
        plant = _read(name, way, draft)
    except SimcError as error:
        draft.error = error
    else:
        draft.plant, draft.error = plant, None
        state.change(**{name: plant})


def _read(name: str, way: str, draft: _Draft) -> Plant:
    fields = draft.fields
    if way == "text":
        return parse_plant(fields["text"] or "")
    if way == "polynomials":
        return entries.plant_of_polynomials(fields["num"] or "", fields["den"] or "", fields["theta"])
    edits = state.widget(_table_key(name, draft)) or {}
    return entries.plant_of_rows(fields["k"], fields["theta"], entries.edited(fields["rows"], edits))


def _table_key(name: str, draft: _Draft) -> str:
    return f"{name}_table_{draft.version}"


def _frame(rows: Iterable[dict]) -> pd.DataFrame:
    frame = pd.DataFrame(list(rows), columns=["factor", "tau", "zeta"])
    return frame.astype({"factor": object, "tau": float, "zeta": float})


def _complaint(draft: _Draft) -> None:
    """What is wrong with the draft, beside its field; the last good plant stays in use."""
    if draft.error is None:
        return
    where = ""
    if isinstance(draft.error, ParseError) and "\n" not in draft.error.text and len(draft.error.text) <= 200:
        where = block(draft.error.text, f"{' ' * draft.error.position}^")
    st.error(told(str(draft.error)) + where)
    st.caption("The last good plant stays in use until this can be read.")
