"""Design of cascades: SIMC inside and outside, or direct synthesis, with given speeds or given peaks Ms.

SIMC inner loop: half rule on Gb, tau_c = theta unless given. It then behaves as e^{-theta s}/(tau_c s + 1), theta and
tau_c those of the inner design: behind Ga that is the outer plant, reduced and tuned the same way. A PID gets the
filter tau_F = tau_c/20. The loops separate where tau_c_outer >= SEPARATE tau_c_inner.

Where Ms is given instead, the smallest tau_c (or lambda) is taken at which the loop is stable and has it.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from simc_core import checks
from simc_core.certificate.verdict import NestedStability, Stability, stability
from simc_core.controllers.forms import Controller, IController, IdealPid, ParallelPid, SeriesPid
from simc_core.errors import InvalidParameter
from simc_core.loops.nested import CascadeLoop, NestedLoops
from simc_core.notation import DIGITS, number, rounded_up
from simc_core.optimal.speed_for_peak import smallest_speed_with_peak
from simc_core.plants.models import Model
from simc_core.plants.plant import Plant
from simc_core.reduction.half_rule import reduced_model
from simc_core.rules.direct_synthesis import KINDS, direct_synthesis, numerator
from simc_core.rules.simc import default_tau_c, simc

SEPARATE = 5.0
FILTER = 20.0  # tau_c/tau_F of the PID controllers of simc_cascade
DOMINANT = 1.0  # dead time above this times the slowest time constant: direct synthesis is not meant for it
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
                f"{name} must be stable or integrating for a SIMC cascade, found {block.unstable_poles} unstable "
                "poles: use direct synthesis, which is made for them"
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
            f"tau_c_outer is {tau_ca / tau_cb:.3g} times tau_c_inner, {SEPARATE:g} times is usual for the loops to "
            f"separate: take tau_c_outer = {number(rounded_up(SEPARATE * tau_cb, DIGITS))}"
        )
    loop = CascadeLoop(primary, secondary, Ca, Cb)
    return CascadeDesign(loop, Cb, Ca, tau_cb, tau_ca, models=(model, reduced), notes=(*notes, *_on_inner(loop)))


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
        *_on_inner(design.loop),
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

    lambda_b = _speed("lambda_inner", lambda_inner, "Ms_inner", Ms_inner, inside, secondary.total_time or 1.0)
    closed = inside(lambda_b)
    Cb = closed.outermost
    tau_F = float(numerator(secondary, lambda_b)[1]) if N_outer is None and secondary.order else None
    N = 20.0 if N_outer is None else N_outer

    def outside(lambda_: float) -> NestedLoops:
        Ca = direct_synthesis(primary, lambda_, outer, N, closed, tau_F, b)
        return NestedLoops((secondary, primary), (Cb, Ca))

    lambda_a = _speed(
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


def _order(name: str, kind: str) -> int:
    if kind not in KINDS:
        raise InvalidParameter(f"{name} must be PI or PID, found {str(kind)[:20]}")
    return KINDS.index(kind) + 1


def _tuned(
    model: Model, tau_c: float | None, loop: str, Ms: float | None, closed: Callable[[Controller], NestedLoops]
) -> tuple[Controller, float]:
    """SIMC controller of one loop, and its tau_c."""
    if tau_c is not None and Ms is not None:
        raise InvalidParameter(f"only one of tau_c_{loop} and Ms_{loop} may be given, found {tau_c:g} and {Ms:g}")
    scale = default_tau_c(model)
    if Ms is None and tau_c is None:
        tau_c = scale

    def at(speed: float) -> NestedLoops:
        return closed(_filtered(simc(model, speed), speed))

    found = _speed(f"tau_c_{loop}", tau_c, f"Ms_{loop}", Ms, at, scale)
    return at(found).outermost, found


def _filtered(controller: SeriesPid | IdealPid | IController, tau_c: float) -> Controller:
    """With the filter of a PID."""
    if isinstance(controller, IController) or controller.tau_D == 0:
        return controller
    return replace(controller, tau_F=tau_c / FILTER)


def _speed(
    name: str, given: float | None, Ms_name: str, Ms: float | None, at: Callable[[float], NestedLoops], scale: float
) -> float:
    """lambda or tau_c as given, else the one Ms asks for."""
    if given is not None:
        return checks.positive_time(name, given)
    Ms = checks.real(Ms_name, Ms, LOWEST_MS, HIGHEST_MS)
    return smallest_speed_with_peak(at, Ms, scale, name, Ms_name)


FILTERS = {
    "inner": (("N_inner = 1", {"N_inner": 1.0}),),
    "outer": (("N_outer = 1", {"N_outer": 1.0}), ("the filter that cancels the inner zero", {"N_outer": None})),
}


def _on_filter(loop: str, design: CascadeDesign, primary: Plant, secondary: Plant, asked: dict[str, Any]) -> list[str]:
    """A derivative gain of the wrong sign, and the filters with which it has the right one; without D there is none."""
    controller = getattr(design, loop)
    if _signs_agree(controller):
        return []
    cures = []
    for words, change in FILTERS[loop]:
        try:
            changed = _synthesised(primary, secondary, **asked | change)
        except InvalidParameter:
            continue
        if _signs_agree(getattr(changed, loop)):
            cures.append(words)
    cures.append(f"a PI {'inside' if loop == 'inner' else 'outside'}")
    return [
        f"Kd of the {loop} controller should have the sign of Ki = {controller.Ki:.4g}, found {controller.Kd:.4g} "
        f"with tau_F = {controller.tau_F:.4g}: take {', or '.join(cures)}"
    ]


def _signs_agree(controller: ParallelPid) -> bool:
    return controller.Kd == 0 or controller.Kd * controller.Ki > 0


def _on_dead_time(name: str, block: Plant, theta: float) -> list[str]:
    if block.integrators or theta <= DOMINANT * block.slowest:
        return []
    return [
        f"theta = {theta:.4g} in the loop of the {name} block should be <= {block.slowest:.4g}, its slowest time "
        "constant: direct synthesis is not meant for dominating dead time, compare with SIMC"
    ]


def _on_inner(loop: CascadeLoop) -> list[str]:
    inside = loop.nested.inside
    assert inside is not None  # both methods design an inner loop
    found = stability(inside)
    if found.verdict == "stable":
        return []
    return [
        f"the inner loop is {found.verdict} on its own, with {found.unstable_poles} unstable poles: its margins mean "
        "nothing, and it runs away when the outer loop saturates or is in manual; give the inner loop a larger "
        "tau_c or lambda"
    ]


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
