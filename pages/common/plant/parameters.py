"""Gain, dead time and time constants typed one by one, for the models that most loops are described by."""

from pages.common.plant.number_form import Field, NumberForm
from pages.common.session import state
from simc_core import Plant, checks
from simc_core.wording import said

FIELDS = {
    "k": Field(said("Gain k"), checks.gain, unit="PV/OP"),
    "slope": Field(said("Gain k′ (slope of y for u = 1)"), checks.gain, unit="PV/(OP time)"),
    "theta": Field(said("Dead time θ"), checks.optional_time, 0.0),
    "tau1": Field(said("Time constant τ₁"), checks.optional_time),
    "tau2": Field(said("Time constant τ₂"), checks.optional_time, 0.0),
}
FIRST_ORDER, SECOND_ORDER, INTEGRATING = said("First order"), said("Second order"), said("Integrating")
KINDS = {
    FIRST_ORDER: ("k", "theta", "tau1"),
    SECOND_ORDER: ("k", "theta", "tau1", "tau2"),
    INTEGRATING: ("slope", "theta", "tau2"),
}


def kind_of(plant: Plant) -> str | None:
    """The kind of model that a plant is, None if none of these."""
    if plant.leads or plant.lag_pairs or plant.lead_pairs or any(tau < 0 for tau in plant.lags):
        return None
    counts = plant.integrators, len(plant.lags)
    return {
        (0, 0): FIRST_ORDER,
        (0, 1): FIRST_ORDER,
        (0, 2): SECOND_ORDER,
        (1, 0): INTEGRATING,
        (1, 1): INTEGRATING,
    }.get(counts)


def plant_of(kind: str, values: dict[str, float]) -> Plant:
    """The plant of the numbers of one kind."""
    lags = tuple(tau for tau in (values.get("tau1"), values.get("tau2")) if tau)
    if kind == INTEGRATING:
        return Plant(values["slope"], values["theta"], lags, integrators=1)
    return Plant(values["k"], values["theta"], lags)


def _begun(name: str) -> tuple[str | None, dict[str, float]]:
    plant = state.value(name)
    kind = kind_of(plant)
    if kind is None:
        return None, {}
    gain = "slope" if kind == INTEGRATING else "k"
    times = [part for part in KINDS[kind] if part.startswith("tau")]
    lags = dict(zip(times, (*plant.lags, 0.0), strict=False))
    return kind, {gain: plant.k, "theta": plant.theta, **lags}


PARAMETERS = NumberForm(
    "parameters", said("Model"), FIELDS, KINDS, _begun, lambda name, kind, values: {name: plant_of(kind, values)}
)
