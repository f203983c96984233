"""What the page of rules compares: the record, its defaults and its bounds. Pure Python, no streamlit."""

from dataclasses import dataclass

from simc_core import RULES, IController, Plant, SeriesPid, checks
from simc_core.controllers.forms import Controller
from simc_core.optimal.criterion import CRITERIA
from simc_core.wording import said

KINDS = ("PI", "PID", "both")
PRESENT, OPTIMAL = "", "optimal"  # the plant of the design; the rule that is no rule
LOWEST_MS, HIGHEST_MS = 1.1, 5.0


@dataclass(frozen=True, slots=True)
class Usual:
    """A plant that rules are compared on in the literature. name: what it is.   printed: settings in [SK98]."""

    plant: Plant
    name: str
    printed: tuple[Controller, ...] = ()


USUAL = {
    "balanced": Usual(Plant(1, 1, (1,)), said("lag and dead time alike [SG12]")),
    "lag": Usual(Plant(1, 1, (8,)), said("lag dominant [SG12]")),
    "slow": Usual(Plant(1, 1, (20,)), said("slow lag")),
    "integrating": Usual(
        Plant(1, 1, integrators=1),
        said("integrating [SG12]; [SK98] examples 3, 8"),
        (SeriesPid(0.5, 8), SeriesPid(1, 2, 0.5)),
    ),
    "four": Usual(Plant(1, 0, (1, 1, 1, 1)), said("four lags")),
    "two": Usual(Plant(1, 1, (6, 2)), said("two lags")),
    "delay": Usual(
        Plant(1, 1), said("pure dead time [SG12]; [SK98] example 7"), (IController(0.5), SeriesPid(0.25, 0.5))
    ),
    "SK98-4": Usual(
        Plant(1, 1, integrators=2), said("double integrating; [SK98] example 4"), (SeriesPid(0.0625, 8, 8),)
    ),
    "SK98-5a": Usual(
        Plant(1, 1, (100,)), said("slow; [SK98] example 5, tau 100"), (SeriesPid(50, 100), SeriesPid(50, 8))
    ),
    "SK98-5b": Usual(Plant(1, 1, (10,)), said("[SK98] example 5, tau 10")),
    "SK98-5c": Usual(Plant(1, 1, (2,)), said("fast; [SK98] example 5, tau 2")),
    "SK98-6a": Usual(Plant(1, 1, (20, 5)), said("[SK98] example 6, lags 20 and 5")),
    "SK98-6b": Usual(Plant(1, 1, (3, 3)), said("[SK98] example 6, lags 3 and 3")),
    "SK98-9": Usual(Plant(-4, 1, (-4,)), said("unstable; [SK98] example 9, a theta 0.25"), (SeriesPid(0.5, 20),)),
}


@dataclass(frozen=True, slots=True)
class Compared:
    """What is compared, and how.

    plant: a key of USUAL, PRESENT for that of the design.   kind: of controllers.   tau_F: filter of those with
    derivative action, None for 0.1 theta.   Ms: peak at which all are compared, None for rules as published.
    criterion: what the optimum is best for.   rule: the one that is drawn, such as "simc-PI"; "" for SIMC.
    """

    plant: str = PRESENT
    kind: str = "PI"
    tau_F: float | None = None
    Ms: float | None = None
    criterion: str = "load"
    rule: str = ""

    def __post_init__(self):
        put = object.__setattr__
        if self.plant != PRESENT:
            checks.one_of("compared_plant", self.plant, USUAL)
        checks.one_of("compared_kind", self.kind, KINDS)
        checks.one_of("compared_criterion", self.criterion, CRITERIA)
        if self.rule:
            key, _, kind = self.rule.partition("-")
            checks.one_of("compared_rule", key, (OPTIMAL, *RULES))
            checks.one_of("the kind of compared_rule", kind, KINDS[:2])
        if self.tau_F is not None:
            put(self, "tau_F", checks.positive_time("tau_F", self.tau_F))
        if self.Ms is not None:
            put(self, "Ms", checks.real("Ms", self.Ms, LOWEST_MS, HIGHEST_MS))

    @property
    def kinds(self) -> tuple[str, ...]:
        """PI, PID or both."""
        return KINDS[:2] if self.kind == "both" else (self.kind,)
