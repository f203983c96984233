"""Both blocks of a cascade and how it is designed: the record behind the cascade page. Pure: no streamlit."""

from dataclasses import dataclass, field

from pages.common.session.facts import of_plant
from pages.common.session.tuning import KINDS
from simc_core import Plant, checks
from simc_core.cascade.design import HIGHEST_MS, LOWEST_MS
from simc_core.plants.step_facts import StepFacts

METHODS = ("simc", "synthesis")
FILTERS = ("N", "zero")
LOWEST_N, HIGHEST_N = 0.1, 1000.0


@dataclass(frozen=True, slots=True)
class Cascade:
    """Both blocks and how their controllers are designed; None for what the method chooses itself.

    primary: Ga, the block of the outer loop.   secondary: Gb, the block of the inner loop.
    tau_c_inner, tau_c_outer: also serve as lambda of the direct synthesis; they go before the Ms of the same loop.
    N_inner, N_outer: lambda/tau_F of a PID by direct synthesis.
    filter_outer: "zero" where tau_F of the outer one is to cancel the zero of the inner loop instead.
    primary_facts, secondary_facts: as Design.facts.
    """

    primary: Plant = field(default_factory=lambda: Plant(2.0, 2.0, (5.0,)))
    secondary: Plant = field(default_factory=lambda: Plant(1.0, 1.0, (2.0, 3.0)))
    method: str = "simc"
    inner: str = "PID"
    outer: str = "PID"
    tau_c_inner: float | None = None
    tau_c_outer: float | None = None
    Ms_inner: float | None = None
    Ms_outer: float | None = None
    b: float = 1.0
    N_inner: float = 20.0
    N_outer: float = 20.0
    filter_outer: str = "N"
    primary_facts: StepFacts | None = None
    secondary_facts: StepFacts | None = None

    def __post_init__(self):
        put = object.__setattr__
        for block in ("primary", "secondary"):
            put(self, f"{block}_facts", of_plant(getattr(self, f"{block}_facts"), getattr(self, block)))
        checks.one_of("filter_outer", self.filter_outer, FILTERS)
        checks.one_of("method", self.method, METHODS)
        checks.one_of("inner", self.inner, KINDS)
        checks.one_of("outer", self.outer, KINDS)
        for name in ("tau_c_inner", "tau_c_outer"):
            if getattr(self, name) is not None:
                put(self, name, checks.positive_time(name, getattr(self, name)))
        for name in ("Ms_inner", "Ms_outer"):
            if getattr(self, name) is not None:
                put(self, name, checks.real(name, getattr(self, name), LOWEST_MS, HIGHEST_MS))
        for name in ("N_inner", "N_outer"):
            put(self, name, checks.real(name, getattr(self, name), LOWEST_N, HIGHEST_N))
        put(self, "b", checks.real("b", self.b, 0.0, 2.0))
