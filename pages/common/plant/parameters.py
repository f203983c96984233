"""Gain, dead time and time constants typed one by one, for the models that most loops are described by."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial

import streamlit as st

from pages.common.parts.number_field import number_field
from pages.common.parts.symbols import symbols
from pages.common.session import state
from simc_core import Plant, checks, read_back


@dataclass(frozen=True, slots=True)
class _Field:
    """empty: what no number means, None where there must be one."""

    label: str
    check: Callable[[str, float], float]
    empty: float | None = None


FIELDS = {
    "k": _Field("Gain k", checks.gain),
    "slope": _Field("Gain k′ (slope of y for u = 1)", checks.gain),
    "theta": _Field("Dead time θ", checks.optional_time, 0.0),
    "tau1": _Field("Time constant τ₁", checks.optional_time),
    "tau2": _Field("Time constant τ₂", checks.optional_time, 0.0),
}
KINDS = {
    "First order": ("k", "theta", "tau1"),
    "Second order": ("k", "theta", "tau1", "tau2"),
    "Integrating": ("slope", "theta", "tau2"),
}


@dataclass(slots=True)
class _Parameters:
    """The numbers typed so far, and the plant they were begun from or have made."""

    plant: Plant
    kind: str | None
    given: dict[str, float] = field(default_factory=dict)


def parameters(name: str) -> None:
    """Number fields of one kind of model; the plant follows as soon as all that is needed is there."""
    plant = state.value(name)
    typed = state.memory(f"{name}_parameters", lambda: _begun(plant))
    if typed.plant != plant:
        fresh = _begun(plant)
        typed.plant, typed.kind, typed.given = plant, fresh.kind or typed.kind, fresh.given
    key = f"{name}_kind"
    state.set_widget(key, typed.kind or next(iter(KINDS)))
    kind = st.segmented_control(
        "Model", list(KINDS), key=key, required=True, on_change=_take_kind, args=(name, typed, key)
    )
    for part in KINDS[kind]:
        _field(name, kind, part, typed)
    missing = [FIELDS[part].label for part in KINDS[kind] if _missing(part, typed.given)]
    if missing:
        st.caption(f"Still to fill in: {', '.join(missing)}. Until then the plant stays as it is.")
    else:
        st.caption(f"Read: {symbols(read_back(plant))}.")


def kind_of(plant: Plant) -> str | None:
    """The kind of model that a plant is, None if none of these."""
    if plant.leads or plant.lag_pairs or plant.lead_pairs or any(tau < 0 for tau in plant.lags):
        return None
    counts = plant.integrators, len(plant.lags)
    return {
        (0, 0): "First order",
        (0, 1): "First order",
        (0, 2): "Second order",
        (1, 0): "Integrating",
        (1, 1): "Integrating",
    }.get(counts)


def plant_of(kind: str, given: dict[str, float]) -> Plant:
    """The plant of the numbers of one kind; all that have no default must be given."""
    values = {part: given.get(part, FIELDS[part].empty) for part in KINDS[kind]}
    lags = tuple(tau for tau in (values.get("tau1"), values.get("tau2")) if tau)
    if kind == "Integrating":
        return Plant(values["slope"], values["theta"], lags, integrators=1)
    return Plant(values["k"], values["theta"], lags)


def _begun(plant: Plant) -> _Parameters:
    kind = kind_of(plant)
    if kind is None:
        return _Parameters(plant, None)
    gain = "slope" if kind == "Integrating" else "k"
    times = [part for part in KINDS[kind] if part.startswith("tau")]
    lags = dict(zip(times, (*plant.lags, 0.0), strict=False))
    return _Parameters(plant, kind, {gain: plant.k, "theta": plant.theta, **lags})


def _field(name: str, kind: str, part: str, typed: _Parameters) -> None:
    about = FIELDS[part]
    number_field(
        about.label,
        typed.given.get(part),
        lambda value: value is None or about.check(about.label, value),
        partial(_take, name, kind, part, typed),
        f"{name}_parameters_{part}",
        optional=True,
        placeholder="needed" if about.empty is None else f"{about.empty:g}",
    )


def _take(name: str, kind: str, part: str, typed: _Parameters, value: float | None) -> None:
    typed.given.pop(part, None)
    if value is not None:
        typed.given[part] = value
    _settle(name, kind, typed)


def _take_kind(name: str, typed: _Parameters, key: str) -> None:
    if state.overtaken(key):
        return
    _settle(name, state.widget(key), typed)


def _settle(name: str, kind: str, typed: _Parameters) -> None:
    """The plant of this kind, once nothing is missing; numbers that only another kind needs are kept for it."""
    typed.kind = kind
    if not any(_missing(each, typed.given) for each in KINDS[kind]):
        typed.plant = plant_of(kind, typed.given)
        state.change(**{name: typed.plant})


def _missing(part: str, given: dict[str, float]) -> bool:
    return part not in given and FIELDS[part].empty is None
