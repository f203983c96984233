"""What a change of settings brings and what it costs, in one sentence."""

import math
from dataclasses import dataclass

from simc_core.metrics.performance import Performance
from simc_core.notation import number
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.wording import Text, joined, said

UNSEEN_CHANGE = 0.02  # relative: a change that nobody would see
DIGITS = 3


@dataclass(frozen=True, slots=True)
class Stability:
    """What is said where one of the two loops is not stable. lost, never: the second one; gained: it alone is."""

    lost: Text
    never: Text
    gained: Text


@dataclass(frozen=True, slots=True)
class Compared:
    """What is said of two numbers."""

    same: Text
    smaller: Text
    larger: Text


NEW_SETTINGS, CHANGED_PLANT = "the new settings", "this change of the plant"
STABILITY = {
    NEW_SETTINGS: Stability(
        said("With the new settings the loop is not stable; without it is."),
        said("With the new settings the loop is not stable, nor is it without."),
        said("The loop is not stable; with the new settings it is, with Ms = {Ms}.", Ms=""),
    ),
    CHANGED_PLANT: Stability(
        said("With this change of the plant the loop is not stable; without it is."),
        said("With this change of the plant the loop is not stable, nor is it without."),
        said("The loop is not stable; with this change of the plant it is, with Ms = {Ms}.", Ms=""),
    ),
}
LOAD = Compared(
    said("Load IAE as before"),
    said("Load IAE {times} times smaller", times=""),
    said("Load IAE {times} times larger", times=""),
)
SETPOINT = Compared(
    said("set-point IAE as before"),
    said("set-point IAE {times} times smaller", times=""),
    said("set-point IAE {times} times larger", times=""),
)


def what_changes(
    before: tuple[Margins, Performance | None],
    after: tuple[Margins, Performance | None],
    new: str = NEW_SETTINGS,
) -> Text:
    """The change from one loop to another, for instance from the settings in the plant now to those of a design.

    Parameters
    ----------
    before, after : tuple of Margins and Performance
        Of the two loops; the performance is None where there is none, as of a loop that is not stable.
    new : {NEW_SETTINGS, CHANGED_PLANT}
        What is new in the second one.

    Returns
    -------
    str
        For instance "Load IAE 2.6 times smaller, set-point IAE 1.9 times smaller; Ms 1.29 → 1.60."
    """
    (old, was), (judged, will) = before, after
    if not judged.stable:
        return STABILITY[new].lost if old.stable else STABILITY[new].never
    if not old.stable:
        return STABILITY[new].gained.put(Ms=number(judged.Ms, DIGITS))
    parts: list[str] = []
    if was is not None and will is not None:
        parts += _compared(LOAD, was.disturbance.IAE, will.disturbance.IAE)
        parts += _compared(SETPOINT, was.setpoint.IAE, will.setpoint.IAE)
    return said(
        "{found}; Ms {old} → {new}.",
        found=joined(parts) if parts else said("Integrals of the error cannot be compared"),
        old=number(old.Ms, DIGITS),
        new=number(judged.Ms, DIGITS),
    )


def _compared(words: Compared, old: float, new: float) -> list[Text]:
    """One sentence; none where there are no numbers to compare."""
    if not (math.isfinite(old) and math.isfinite(new) and old > 0 and new > 0):
        return []
    if abs(old / new - 1) < UNSEEN_CHANGE:
        return [words.same]
    return [(words.smaller if new < old else words.larger).put(times=number(max(old / new, new / old), 2))]
