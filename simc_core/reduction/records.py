"""Records of a model reduction: the model, how it came about, and what became of every time constant."""

import math
from dataclasses import dataclass, field

from simc_core.plants.models import Model

PAYS = 1.5  # two lags with tau2 = theta, the limit of [SK03 sect. 3.1]: order 1 has 1.5 times the delay of order 2
LARGEST_MS = 2.0  # [SK03]: Ms should be below about 2; 1.4 to 1.7 is usual


@dataclass(frozen=True, slots=True)
class Step:
    """One line of the reduction.

    Attributes
    ----------
    rule : str
        Its short name, such as "T3" or "half rule".
    text : str
        A sentence in words.
    equation : str
        LaTeX.
    amounts : dict of str to float
        The numbers in it by name, times in the user's unit.
    """

    rule: str
    text: str
    equation: str = ""
    amounts: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class BudgetEntry:
    """What became of one lag, zero or delay of the plant.

    Attributes
    ----------
    label : str
        Such as "lag 6".
    kind : {"lag", "pair", "lead", "inverse", "dead time", "sampling", "filter", "integrator", "unstable"}
        What it is.
    amount : float
        Its time, in the user's unit; math.inf for an integrator.
    parts : tuple of (str, float)
        Where each part of it went, and its time; the times of a lag add up to it. Kept in the model: "tau1", "tau2",
        "tau0", "theta", "slope" (an integrator), "a" (an unstable pole). Gone: by the rule "T1", "T1a", "T1b", "T2",
        "T3", "1998 small", "1998 large", "1998 cancel", by exact cancellation "=", or absorbed by an "integrator".
    """

    label: str
    kind: str
    amount: float
    parts: tuple[tuple[str, float], ...]


@dataclass(frozen=True, slots=True)
class Candidate:
    """A self-consistent effective delay, and what its model is worth.

    Attributes
    ----------
    theta : float
        The effective delay, in the user's time unit.
    model : a reduced model
        With this delay.
    Ms : float
        Of its tight SIMC loop round the original plant; math.nan where that loop is not stable, where there is no such
        controller, or where only one candidate exists and nothing had to be decided.
    load_error : float
        tau_I/Kc of its SIMC loop with Ms = 1.6 round the original plant, math.nan where there is none.
    chosen : bool
        Whether it is the one of the reduction.
    """

    theta: float
    model: Model
    Ms: float
    load_error: float
    chosen: bool


@dataclass(frozen=True, slots=True)
class Orders:
    """Load errors tau_I/Kc of the SIMC loops of both orders round the full plant, each with Ms = 1.6.

    math.inf where no tau_c gives that Ms.
    """

    first: float
    second: float

    @property
    def ratio(self) -> float:
        """How many times smaller the load error is with order 2; math.nan where neither loop has that Ms."""
        if math.isinf(self.first) and math.isinf(self.second):
            return math.nan
        return self.first / self.second

    @property
    def second_pays(self) -> bool:
        """Whether derivative action (order 2) makes the load error at least 1.5 times smaller."""
        return self.ratio >= PAYS


@dataclass(frozen=True, slots=True)
class Reduction:
    """Result of the half rule.

    Attributes
    ----------
    model : a reduced model
        What SIMC is applied to.
    steps : tuple of Step
        What was done, in order.
    alternatives : tuple of reduced models
        The other self-consistent ones.
    budget : tuple of BudgetEntry
        One for each time constant.
    candidates : tuple of Candidate
        All self-consistent delays, smallest first.
    notes : tuple of str
        Advice.
    orders : Orders or None
        What order 1 and order 2 are worth; None where the model has one form whatever the order, or an unstable pole.
    """

    model: Model
    steps: tuple[Step, ...]
    alternatives: tuple[Model, ...]
    budget: tuple[BudgetEntry, ...]
    candidates: tuple[Candidate, ...]
    notes: tuple[str, ...]
    orders: Orders | None
