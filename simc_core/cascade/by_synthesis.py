"""Direct synthesis inside and outside [PSB], for given speeds lambda or given peaks Ms."""

from dataclasses import replace
from typing import Any

from simc_core.cascade.design import CascadeDesign, on_inner_loop, speed_of_loop
from simc_core.controllers.forms import ParallelPid
from simc_core.errors import InvalidParameter
from simc_core.loops.nested import CascadeLoop, NestedLoops
from simc_core.plants.plant import Plant
from simc_core.rules.direct_synthesis import direct_synthesis, numerator
from simc_core.wording import joined, said

DOMINANT = 1.0  # dead time above this times the slowest time constant: direct synthesis is not meant for it


def synthesis_cascade(
    primary: Plant,
    secondary: Plant,
    Ms_inner: float = 2.0,
    Ms_outer: float = 2.0,
    inner: str = "PID",
    outer: str = "PID",
    N_inner: float = 20.0,
    N_outer: float | None = 20.0,
    lambda_inner: float | None = None,
    lambda_outer: float | None = None,
    b: float = 1.0,
) -> CascadeDesign:
    """Direct synthesis of both loops of a cascade, for given peaks Ms.

    Parameters
    ----------
    primary, secondary : Plant
        Ga, the block of the outer loop, and Gb, the block of the inner one.
    Ms_inner, Ms_outer : float
        Peaks that the loops are to have.
    inner, outer : str
        "PI" or "PID".
    N_inner, N_outer : float or None
        tau_F = lambda/N of a PID. N_outer=None: tau_F = eta_1 of the inner loop, which cancels its zero.
    lambda_inner, lambda_outer : float, optional
        In the user's time unit. One that is given goes before the Ms of that loop.
    b : float
        Set-point weight.

    Returns
    -------
    CascadeDesign
        The loop, and how it came about.

    Raises
    ------
    InvalidParameter
        No lambda gives a stable loop with the Ms asked for, or a number is out of bounds.

    References
    ----------
    [PSB].

    Examples
    --------
    Pair 1 of [PSB], where Kp = 3.3928 is printed for the inner loop:

    >>> from simc_core import Plant, synthesis_cascade
    >>> design = synthesis_cascade(Plant(2, 2, (5,)), Plant(1, 1, (2, 3)))
    >>> round(design.loop.inner.Kp, 4)
    3.3928
    """

    asked: dict[str, Any] = {
        "Ms_inner": Ms_inner, "Ms_outer": Ms_outer, "inner": inner, "outer": outer, "N_inner": N_inner,
        "N_outer": N_outer, "lambda_inner": lambda_inner, "lambda_outer": lambda_outer, "b": b,
    }  # fmt: skip
    design = _synthesised(primary, secondary, **asked)
    notes = [
        *_on_filter("inner", design, primary, secondary, asked),
        *_on_filter("outer", design, primary, secondary, asked),
        *_on_dead_time("secondary", secondary, secondary.theta),
        *_on_dead_time("primary", primary, primary.theta + secondary.theta),
        *on_inner_loop(design.loop),
    ]
    return replace(design, notes=tuple(notes))


def _synthesised(
    primary: Plant,
    secondary: Plant,
    *,
    Ms_inner: float,
    Ms_outer: float,
    inner: str,
    outer: str,
    N_inner: float,
    N_outer: float | None,
    lambda_inner: float | None,
    lambda_outer: float | None,
    b: float,
) -> CascadeDesign:
    """As `synthesis_cascade`, without notes."""

    def inside(lambda_: float) -> NestedLoops:
        return NestedLoops((secondary,), (direct_synthesis(secondary, lambda_, inner, N_inner),))

    lambda_b = speed_of_loop("lambda_inner", lambda_inner, "Ms_inner", Ms_inner, inside, secondary.total_time or 1.0)
    closed = inside(lambda_b)
    Cb = closed.outermost
    tau_F = float(numerator(secondary, lambda_b)[1]) if N_outer is None and secondary.order else None
    N = 20.0 if N_outer is None else N_outer

    def outside(lambda_: float) -> NestedLoops:
        Ca = direct_synthesis(primary, lambda_, outer, N, closed, tau_F, b)
        return NestedLoops((secondary, primary), (Cb, Ca))

    lambda_a = speed_of_loop(
        "lambda_outer",
        lambda_outer,
        "Ms_outer",
        Ms_outer,
        outside,
        (primary.total_time or 1.0) + secondary.theta + lambda_b,
    )
    Ca = outside(lambda_a).outermost
    loop = CascadeLoop(primary, secondary, Ca, Cb)
    return CascadeDesign(loop, Cb, Ca, lambda_inner=lambda_b, lambda_outer=lambda_a)


WRONG_SIGN = {
    "inner": said(
        "Kd of the inner controller should have the sign of Ki = {Ki:.4g}, found {Kd:.4g} with tau_F = {tau_F:.4g}: "
        "take {cures}",
        Ki=0.0,
        Kd=0.0,
        tau_F=0.0,
        cures="",
    ),
    "outer": said(
        "Kd of the outer controller should have the sign of Ki = {Ki:.4g}, found {Kd:.4g} with tau_F = {tau_F:.4g}: "
        "take {cures}",
        Ki=0.0,
        Kd=0.0,
        tau_F=0.0,
        cures="",
    ),
}
FILTERS = {
    "inner": (("N_inner = 1", {"N_inner": 1.0}),),
    "outer": (("N_outer = 1", {"N_outer": 1.0}), (said("the filter that cancels the inner zero"), {"N_outer": None})),
}


def _on_filter(loop: str, design: CascadeDesign, primary: Plant, secondary: Plant, asked: dict[str, Any]) -> list[str]:
    """A derivative gain of the wrong sign, and the filters with which it has the right one; without D there is none."""
    controller = getattr(design, loop)
    if _signs_agree(controller):
        return []
    cures = []
    for cure, change in FILTERS[loop]:
        try:
            changed = _synthesised(primary, secondary, **asked | change)
        except InvalidParameter:
            continue
        if _signs_agree(getattr(changed, loop)):
            cures.append(cure)
    cures.append(said("a PI inside") if loop == "inner" else said("a PI outside"))
    found = {"Ki": controller.Ki, "Kd": controller.Kd, "tau_F": controller.tau_F, "cures": joined(cures, said(", or "))}
    return [WRONG_SIGN[loop].put(**found)]


def _signs_agree(controller: ParallelPid) -> bool:
    return controller.Kd == 0 or controller.Kd * controller.Ki > 0


def _on_dead_time(name: str, block: Plant, theta: float) -> list[str]:
    if block.integrators or theta <= DOMINANT * block.slowest:
        return []
    return [
        said(
            "theta = {theta:.4g} in the loop of the {block} block should be <= {slowest:.4g}, its slowest time "
            "constant: direct synthesis is not meant for dominating dead time, compare with SIMC",
            theta=theta,
            block=name,
            slowest=block.slowest,
        )
    ]
