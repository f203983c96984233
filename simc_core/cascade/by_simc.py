"""SIMC inside and outside, and the single loop that a cascade is compared with.

Inner loop: half rule on Gb, tau_c = theta unless given. It then behaves as e^{-theta s}/(tau_c s + 1), theta and tau_c
those of the inner design: behind Ga that is the outer plant, reduced and tuned the same way. A PID gets the filter
tau_F = tau_c/20. The loops separate where tau_c_outer >= SEPARATE tau_c_inner.
"""

from collections.abc import Callable
from dataclasses import replace

from simc_core import checks
from simc_core.cascade.design import CascadeDesign, on_inner_loop, speed_of_loop
from simc_core.controllers.forms import Controller, IController, IdealPid, SeriesPid
from simc_core.errors import InvalidParameter
from simc_core.loops.nested import CascadeLoop, NestedLoops
from simc_core.notation import DIGITS, number, rounded_up
from simc_core.optimal.speed_for_peak import smallest_speed_with_peak
from simc_core.plants.models import Model
from simc_core.plants.plant import Plant
from simc_core.reduction.half_rule import reduced_model
from simc_core.rules.direct_synthesis import KINDS, direct_synthesis
from simc_core.rules.simc import default_tau_c, simc
from simc_core.wording import counted, said

SEPARATE = 5.0
FILTER = 20.0  # tau_c/tau_F of the PID controllers of simc_cascade


def simc_cascade(
    primary: Plant,
    secondary: Plant,
    tau_c_inner: float | None = None,
    tau_c_outer: float | None = None,
    inner: str = "PI",
    outer: str = "PI",
    Ms_inner: float | None = None,
    Ms_outer: float | None = None,
    b: float = 1.0,
) -> CascadeDesign:
    """SIMC settings of both loops of a cascade; the module docstring has the method.

    Parameters
    ----------
    primary, secondary : Plant
        Ga, the block of the outer loop, and Gb, the block of the inner one.
    tau_c_inner, tau_c_outer : float, optional
        Closed-loop time constants > 0, in the user's time unit. None, and no Ms: theta of that loop.
    inner, outer : str
        "PI" or "PID".
    Ms_inner, Ms_outer : float, optional
        Peaks that the loops are to have, in place of tau_c.
    b : float
        Set-point weight.

    Returns
    -------
    CascadeDesign
        The loop, and how it came about.

    Raises
    ------
    InvalidParameter
        An unstable block, tau_c together with Ms, or an Ms that cannot be met.
    NotReducible
        A block has no SIMC model.

    Examples
    --------
    >>> from simc_core import Plant, simc_cascade
    >>> design = simc_cascade(Plant(2, 2, (5,)), Plant(1, 1, (2, 3)), inner="PID")
    >>> design.loop.inner.Kc, design.loop.inner.tau_I, design.loop.inner.tau_D
    (1.5, 3.0, 2.0)
    """
    for name, block in (("primary", primary), ("secondary", secondary)):
        if block.unstable_poles:
            raise InvalidParameter(
                counted(
                    "{name} must be stable or integrating for a SIMC cascade, found {n} unstable pole: use direct "
                    "synthesis, which is made for them",
                    "{name} must be stable or integrating for a SIMC cascade, found {n} unstable poles: use direct "
                    "synthesis, which is made for them",
                    block.unstable_poles,
                    name=name,
                )
            )
    model = reduced_model(secondary, _order("inner", inner))
    Cb, tau_cb = _tuned(model, tau_c_inner, "inner", Ms_inner, lambda C: NestedLoops((secondary,), (C,)))
    effective = replace(primary, theta=primary.theta + model.theta, lags=(*primary.lags, tau_cb))
    reduced = reduced_model(effective, _order("outer", outer))
    Ca, tau_ca = _tuned(reduced, tau_c_outer, "outer", Ms_outer, lambda C: NestedLoops((secondary, primary), (Cb, C)))
    Ca = Ca.with_weight(b)
    notes = []
    if tau_ca < SEPARATE * tau_cb:
        notes.append(
            said(
                "tau_c_outer is {ratio:.3g} times tau_c_inner, {usual:g} times is usual for the loops to separate: "
                "take tau_c_outer = {speed}",
                ratio=tau_ca / tau_cb,
                usual=SEPARATE,
                speed=number(rounded_up(SEPARATE * tau_cb, DIGITS)),
            )
        )
    loop = CascadeLoop(primary, secondary, Ca, Cb)
    return CascadeDesign(loop, Cb, Ca, tau_cb, tau_ca, models=(model, reduced), notes=(*notes, *on_inner_loop(loop)))


def single_loop(primary: Plant, secondary: Plant, kind: str = "PID", Ms: float = 2.0) -> CascadeLoop:
    """The alternative without an inner loop: one controller for Ga Gb, SIMC with tau_c = theta.

    Where SIMC has no rule for the product, direct synthesis with the peak Ms. Raises SimcError where neither works.
    """
    product = Plant(
        primary.k * secondary.k,
        primary.theta + secondary.theta,
        primary.lags + secondary.lags,
        primary.leads + secondary.leads,
        primary.integrators + secondary.integrators,
        primary.lag_pairs + secondary.lag_pairs,
        primary.lead_pairs + secondary.lead_pairs,
    )
    if not product.unstable_poles and product.integrators <= 2:
        model = reduced_model(product, _order("kind", kind))
        tau_c = default_tau_c(model)
        return CascadeLoop(primary, secondary, _filtered(simc(model, tau_c), tau_c), None)

    def at(lambda_: float) -> NestedLoops:
        return NestedLoops((product,), (direct_synthesis(product, lambda_, kind),))

    lambda_ = smallest_speed_with_peak(at, Ms, product.total_time or 1.0, "lambda", "Ms")
    return CascadeLoop(primary, secondary, at(lambda_).outermost, None)


def _order(name: str, kind: str) -> int:
    return KINDS.index(checks.one_of(name, kind, KINDS)) + 1


def _tuned(
    model: Model, tau_c: float | None, loop: str, Ms: float | None, closed: Callable[[Controller], NestedLoops]
) -> tuple[Controller, float]:
    """SIMC controller of one loop, and its tau_c."""
    if tau_c is not None and Ms is not None:
        raise InvalidParameter(
            said(
                "only one of {speed} and {peak} may be given, found {tau_c:g} and {Ms:g}",
                speed=f"tau_c_{loop}",
                peak=f"Ms_{loop}",
                tau_c=tau_c,
                Ms=Ms,
            )
        )
    scale = default_tau_c(model)
    if Ms is None and tau_c is None:
        tau_c = scale

    def at(speed: float) -> NestedLoops:
        return closed(_filtered(simc(model, speed), speed))

    found = speed_of_loop(f"tau_c_{loop}", tau_c, f"Ms_{loop}", Ms, at, scale)
    return at(found).outermost, found


def _filtered(controller: SeriesPid | IdealPid | IController, tau_c: float) -> Controller:
    """With the filter of a PID."""
    if isinstance(controller, IController) or controller.tau_D == 0:
        return controller
    return replace(controller, tau_F=tau_c / FILTER)
