"""Gain, dead time and time constants typed one by one, for the models that most loops are described by."""

from pages.common.plant.number_form import Field, NumberForm
from pages.common.session import state
from simc_core import Plant, checks

FIELDS = {
    "k": Field("Gain k", checks.gain, unit="PV/OP"),
    "slope": Field("Gain k′ (slope of y for u = 1)", checks.gain, unit="PV/(OP time)"),
    "theta": Field("Dead time θ", checks.optional_time, 0.0),
    "tau1": Field("Time constant τ₁", checks.optional_time),
    "tau2": Field("Time constant τ₂", checks.optional_time, 0.0),
}
KINDS = {
    "First order": ("k", "theta", "tau1"),
    "Second order": ("k", "theta", "tau1", "tau2"),
    "Integrating": ("slope", "theta", "tau2"),
}


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


def plant_of(kind: str, values: dict[str, float]) -> Plant:
    """The plant of the numbers of one kind."""
    lags = tuple(tau for tau in (values.get("tau1"), values.get("tau2")) if tau)
    if kind == "Integrating":
        return Plant(values["slope"], values["theta"], lags, integrators=1)
    return Plant(values["k"], values["theta"], lags)


def _begun(name: str) -> tuple[str | None, dict[str, float]]:
    plant = state.value(name)
    kind = kind_of(plant)
    if kind is None:
        return None, {}
    gain = "slope" if kind == "Integrating" else "k"
    times = [part for part in KINDS[kind] if part.startswith("tau")]
    lags = dict(zip(times, (*plant.lags, 0.0), strict=False))
    return kind, {gain: plant.k, "theta": plant.theta, **lags}


PARAMETERS = NumberForm(
    "parameters", "Model", FIELDS, KINDS, _begun, lambda name, kind, values: {name: plant_of(kind, values)}
)
