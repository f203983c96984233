"""What a row comes to."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from simc_core.controllers.forms import Controller
from simc_core.errors import SimcError
from simc_core.implementation.boxes.convert import Typed
from simc_core.many.worker import WorkFailed
from simc_core.metrics.performance import Performance
from simc_core.plants.models import Model
from simc_core.plants.plant import Plant
from simc_core.reduction.records import LARGEST_MS
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.studies.advice import Advice
from simc_core.studies.bands import exceeds
from simc_core.studies.own_settings import DAMPING
from simc_core.wording import said

LONGEST_REFUSAL = 600  # characters


@dataclass(frozen=True, slots=True)
class Judged:
    """A controller in the loop.

    Attributes
    ----------
    controller : Controller
        Its settings.
    margins : Margins
        Of the loop; all nan where it is not stable.
    performance : Performance or None
        Of unit steps; None where there is none.
    why_not : str
        Why there is no performance, "" where there is one.
    """

    controller: Controller
    margins: Margins
    performance: Performance | None
    why_not: str = ""


@dataclass(frozen=True, slots=True)
class Robust:
    """New settings on n plants that differ a little from the one known.

    stable: share of stable loops.   Ms_median, Ms_95: of Ms; a loop that is not stable counts as infinite.
    """

    n: int
    stable: float
    Ms_median: float
    Ms_95: float


@dataclass(frozen=True, slots=True)
class Result:
    """One row of a list, tuned; or the reason why not.

    Attributes
    ----------
    row : mapping
        As it was given.
    controller : Controller or None
        The new settings.
    margins : Margins or None
        Of the loop round the full plant; all nan where it is not stable.
    performance : Performance or None
        Of unit steps; None where the loop is not stable or does not come to rest, advice then says so.
    advice : tuple of Advice
        What to look at, the gravest first: of the new settings, then of the present ones.
    refusal : str
        Why the row has no settings, "" where it has.
    plant : Plant or None
        As it was read.
    model : Model or None
        The reduced model that was tuned; None for rules and bounds that use another.
    present : Judged or None
        The settings that are in the controller now.
    typed : Typed or None
        The new settings as they are typed into the box, rounded.
    robust : Robust or None
        The new settings on variants of the plant, where they were asked for.
    """

    row: Mapping[str, Any]
    controller: Controller | None = None
    margins: Margins | None = None
    performance: Performance | None = None
    advice: tuple[Advice, ...] = ()
    refusal: str = ""
    plant: Plant | None = None
    model: Model | None = None
    present: Judged | None = None
    typed: Typed | None = None
    robust: Robust | None = None

    @property
    def tag(self) -> str:
        """Name of the loop, "" where it has none."""
        value = self.row.get("tag")
        return "" if value is None or value != value else str(value).strip()

    @property
    def load_ratio(self) -> float:
        """Load IAE of the present settings over that of the new ones; nan where one of the two has none."""
        if self.present is None or self.present.performance is None or self.performance is None:
            return math.nan
        new = self.performance.disturbance.IAE
        return self.present.performance.disturbance.IAE / new if new else math.nan

    @property
    def trouble(self) -> str:
        """What is wrong with the present settings: "not stable", "fragile", "slow oscillation", or ""."""
        if self.present is None:
            return ""
        if not self.present.margins.stable:
            return "not stable"
        if exceeds(self.present.margins.Ms, LARGEST_MS):
            return "fragile"
        return "slow oscillation" if any(each.quantity == SLOW for each in self.advice) else ""


NOW = said("{quantity} now", quantity="")  # of the present settings
SLOW = NOW.put(quantity=DAMPING)
TROUBLES = ("not stable", "fragile", "slow oscillation", "")


def refused(row: Mapping[str, Any], error: BaseException | str) -> Result:
    """A row without settings."""
    return Result(row, refusal=told(error))


def told(error: BaseException | str) -> str:
    """An error in words. What is no refusal is a fault of this program, or of a tune of one's own."""
    text = str(error)
    if isinstance(error, BaseException) and not isinstance(error, SimcError):
        text = said("a fault of this program, not of the row: {error}", error=_named(error))
    return text if len(text) <= LONGEST_REFUSAL else text[: LONGEST_REFUSAL - 3] + "..."


def _named(error: BaseException) -> str:
    return str(error) if isinstance(error, WorkFailed) else f"{type(error).__name__}: {error}"
