"""A designed cascade, and what both ways to design one share: a speed that is given or follows from a peak Ms.

Where Ms is given, the smallest tau_c (or lambda) is taken at which the loop is stable and has it.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

from simc_core import checks
from simc_core.certificate.verdict import NestedStability, Stability, stability
from simc_core.controllers.forms import Controller
from simc_core.loops.nested import CascadeLoop, NestedLoops
from simc_core.optimal.speed_for_peak import smallest_speed_with_peak
from simc_core.plants.models import Model
from simc_core.wording import counted, said

LOWEST_MS, HIGHEST_MS = 1.05, 10.0


@dataclass(frozen=True, slots=True)
class CascadeDesign:
    """A cascade and how it came about.

    Attributes
    ----------
    loop : CascadeLoop
        Both loops.
    inner, outer : controller
        The controllers in it.
    tau_c_inner, tau_c_outer : float or None
        Of SIMC, in the user's time unit; None for direct synthesis.
    lambda_inner, lambda_outer : float or None
        Of direct synthesis, in the user's time unit; None for SIMC.
    models : tuple of two reduced models, or None
        Of SIMC: those of Gb and of the outer plant.
    notes : tuple of str
        What the designer should know, in words.
    """

    loop: CascadeLoop
    inner: Controller
    outer: Controller
    tau_c_inner: float | None = None
    tau_c_outer: float | None = None
    lambda_inner: float | None = None
    lambda_outer: float | None = None
    models: tuple[Model, Model] | None = None
    notes: tuple[str, ...] = ()

    @property
    def stability(self) -> NestedStability | Stability:
        """Of both loops."""
        return stability(self.loop)


def speed_of_loop(
    name: str, given: float | None, Ms_name: str, Ms: float | None, at: Callable[[float], NestedLoops], scale: float
) -> float:
    """lambda or tau_c as given, else the one Ms asks for."""
    if given is not None:
        return checks.positive_time(name, given)
    Ms = checks.real(Ms_name, Ms, LOWEST_MS, HIGHEST_MS)
    return smallest_speed_with_peak(at, Ms, scale, name, Ms_name)


def on_inner_loop(loop: CascadeLoop) -> list[str]:
    """What the designer should know of an inner loop that is not stable on its own."""
    inside = loop.nested.inside
    assert inside is not None  # both methods design an inner loop
    found = stability(inside)
    if found.verdict == "stable":
        return []
    if found.verdict == "marginal":
        return [
            counted(
                "the inner loop is marginal on its own, with {n} unstable pole: its margins mean nothing, and it runs "
                "away when the outer loop saturates or is in manual; give the inner loop a larger tau_c or lambda",
                "the inner loop is marginal on its own, with {n} unstable poles: its margins mean nothing, and it runs "
                "away when the outer loop saturates or is in manual; give the inner loop a larger tau_c or lambda",
                int(found.unstable_poles),
            )
        ]
    if math.isinf(found.unstable_poles):
        return [
            said(
                "the inner loop is unstable on its own, with infinitely many unstable poles: its margins mean nothing, "
                "and it runs away when the outer loop saturates or is in manual; give the inner loop a larger tau_c or "
                "lambda"
            )
        ]
    return [
        counted(
            "the inner loop is unstable on its own, with {n} unstable pole: its margins mean nothing, and it runs "
            "away when the outer loop saturates or is in manual; give the inner loop a larger tau_c or lambda",
            "the inner loop is unstable on its own, with {n} unstable poles: its margins mean nothing, and it runs "
            "away when the outer loop saturates or is in manual; give the inner loop a larger tau_c or lambda",
            int(found.unstable_poles),
        )
    ]
