"""Records of a model reduction: the model, how it came about, and what became of every time constant."""

from dataclasses import dataclass, field

from simc_core.plants.models import Model

LARGEST_MS = 2.0  # [SK03]: Ms should be below about 2; 1.4 to 1.7 is usual


@dataclass(frozen=True, slots=True)
class Step:
    """One line of the reduction.

    rule: its short name, e.g. "T3", "half rule".   text: a sentence in words.   equation: LaTeX.
    amounts: the numbers in it by name.
    """

    rule: str
    text: str
    equation: str = ""
    amounts: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Share:
    """What became of one lag, zero or delay of the plant.

    label: e.g. "lag 6".   kind: "lag", "pair", "lead", "inverse", "dead time", "sampling", "integrator", "unstable".
    amount: its time; math.inf for an integrator.
    parts: (where, time). Kept in the model: "tau1", "tau2", "tau0", "theta", "slope" (an integrator), "a" (an unstable
    pole). Gone: by the rule "T1", "T1a", "T1b", "T2", "T3", "1998 small", "1998 large", "1998 cancel", by exact
    cancellation "=", or absorbed by an "integrator". The times of a lag add up to it.
    """

    label: str
    kind: str
    amount: float
    parts: tuple[tuple[str, float], ...]


@dataclass(frozen=True, slots=True)
class Candidate:
    """A self-consistent effective delay, its model, and Ms of its tight SIMC loop round the original plant.

    Ms: math.nan where that loop is not stable, where there is no such controller, or where only one candidate
    exists and nothing had to be decided.
    """

    theta: float
    model: Model
    Ms: float
    chosen: bool


@dataclass(frozen=True, slots=True)
class Reduction:
    """Result of the half rule.

    model: the reduced model.   steps: what was done, in order.   alternatives: the other self-consistent models.
    budget: one Share per time constant.   candidates: all self-consistent delays, smallest first.   notes: advice.
    order_two_pays: tau2 of the second-order model > theta of it; None where the model has a form of its own.
    """

    model: Model
    steps: tuple[Step, ...]
    alternatives: tuple[Model, ...]
    budget: tuple[Share, ...]
    candidates: tuple[Candidate, ...]
    notes: tuple[str, ...]
    order_two_pays: bool | None
