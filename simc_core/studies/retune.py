"""What a change of settings brings and what it costs, in one sentence."""

import math

from simc_core.metrics.performance import Performance
from simc_core.notation import number
from simc_core.sensitivity.margins_of_response import Margins

UNSEEN_CHANGE = 0.02  # relative: a change that nobody would see
DIGITS = 3


def what_changes(
    before: tuple[Margins, Performance | None],
    after: tuple[Margins, Performance | None],
    new: str = "the new settings",
) -> str:
    """The change from one loop to another, for instance from the settings in the plant now to those of a design.

    Parameters
    ----------
    before, after : tuple of Margins and Performance
        Of the two loops; the performance is None where there is none, as of a loop that is not stable.
    new : str
        What is new in the second one.

    Returns
    -------
    str
        For instance "Load IAE 2.6 times smaller, set-point IAE 1.9 times smaller; Ms 1.29 → 1.60."
    """
    (old, was), (judged, will) = before, after
    if not judged.stable:
        return f"With {new} the loop is not stable" + ("; without it is." if old.stable else ", nor is it without.")
    if not old.stable:
        return f"The loop is not stable; with {new} it is, with Ms = {number(judged.Ms, DIGITS)}."
    parts = []
    if was is not None and will is not None:
        parts = [
            _times("Load IAE", was.disturbance.IAE, will.disturbance.IAE),
            _times("set-point IAE", was.setpoint.IAE, will.setpoint.IAE),
        ]
    found = ", ".join(part for part in parts if part) or "Integrals of the error cannot be compared"
    return f"{found}; Ms {number(old.Ms, DIGITS)} → {number(judged.Ms, DIGITS)}."


def _times(name: str, old: float, new: float) -> str:
    if not (math.isfinite(old) and math.isfinite(new) and old > 0 and new > 0):
        return ""
    if abs(old / new - 1) < UNSEEN_CHANGE:
        return f"{name} as before"
    return f"{name} {number(max(old / new, new / old), 2)} times {'smaller' if new < old else 'larger'}"
