"""Guards for settings that no rule has made: not stable, fragile, slow oscillation, derivative without a filter.

Slow oscillation. Under PI the process k'/s has the damping zeta = 0.5 sqrt(Kc k' tau_I), hence Kc k' tau_I >= 4
[SK98; SK03 eq. 22; SG12]. The process k/(tau1 s + 1) leans on itself as well:

    zeta = 0.5 (1 + Kc k) sqrt(tau_I/(Kc k tau1)),    real poles from tau_I = 4 Kc k tau1/(1 + Kc k)^2 <= tau1 on

From there on the integral action is not to blame. Below, the poles of the exact loop decide: nothing is said unless
they show the oscillation, and more gain or a longer integral time takes it away.
"""

import math
from collections.abc import Iterator
from dataclasses import replace

from simc_core.certificate.poles import ClosedLoopPole, dominant_poles
from simc_core.controllers.forms import Controller, IController, IdealPid, ParallelPid, SeriesPid
from simc_core.errors import FormError, NotReducible
from simc_core.loops.loop import Loop
from simc_core.notation import number
from simc_core.plants.models import FirstOrderDelay, IntegratingDelay, Model
from simc_core.plants.plant import Plant
from simc_core.reduction.half_rule import reduced_model
from simc_core.reduction.records import LARGEST_MS
from simc_core.rules.simc import simc
from simc_core.sensitivity.margins import margins
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.studies.advice import FRAGILE, NOT_STABLE, UNFILTERED, UNSTABLE, Advice, equation
from simc_core.studies.bands import exceeds
from simc_core.wording import joined, said

LEAST_DAMPING = 0.5  # zeta; below it each swing is more than 16 % of the one before
SLOW = 8.0  # periods from so many dead times on; 4 at the limit of stability, 6 before it [SK98]
DAMPING = said("Damping")


def advice_on_settings(loop: Loop, found: Margins) -> tuple[Advice, ...]:
    """What applies to settings that no rule has made, the gravest first. found: margins of the loop."""
    return tuple(_applies(loop, found))


def _applies(loop: Loop, found: Margins) -> Iterator[Advice]:
    if not found.stable:
        yield Advice("error", UNSTABLE, NOT_STABLE)
    elif exceeds(found.Ms, LARGEST_MS):
        yield Advice("warning", "Ms", FRAGILE, found.Ms, LARGEST_MS)
    if found.stable and (slow := slow_oscillation(loop.plant, loop.controller)):
        yield slow
    if unfiltered := no_filter(loop.controller):
        yield unfiltered


def no_filter(controller: Controller) -> Advice | None:
    """Derivative action without a filter."""
    if isinstance(controller, IController) or not controller.derivative or controller.tau_F:
        return None
    return Advice("warning", "tau_F = 0", UNFILTERED)


def slow_oscillation(plant: Plant, controller: Controller) -> Advice | None:
    """Integral action that is too strong for the gain of a stable loop. The change is {"own": settings that end it}."""
    try:
        model, series = reduced_model(plant), controller.to_series()
    except (NotReducible, FormError):
        return None
    needed = real_poles_from(model, series.Kc)
    if not series.tau_I < needed:
        return None
    slow = _slow_pair(Loop(plant, controller), model.theta)
    if slow is None or not 0 < slow.zeta < LEAST_DAMPING:
        return None
    for better in _better(controller, series, model, needed):
        after = _damped(Loop(plant, better), model.theta)
        if after:
            break
    else:
        return None
    text = [
        said(
            "The loop oscillates slowly, period {period}: the integral action is too strong for this gain.",
            period=number(2 * math.pi / slow.s.imag, 3),
        )
    ]
    if isinstance(model, IntegratingDelay):
        product = number(series.Kc * model.k_prime * series.tau_I, 3)
        text.append(said("Kc k' tau_I is {product}, should be at least 4.", product=product))
    remedy = said("{order}: {gives}.", order=settings_changed(controller, better), gives=after)
    return Advice("warning", DAMPING, joined(text, " "), slow.zeta, LEAST_DAMPING, True, remedy, {"own": better})


def real_poles_from(model: Model, Kc: float) -> float:
    """The integral time from which PI round the model without its dead time does not oscillate; 0 if none is known."""
    match model:
        case IntegratingDelay():
            K, tau1 = Kc * model.k_prime, math.inf
        case FirstOrderDelay() if model.tau1:
            K, tau1 = Kc * model.k, model.tau1
        case _:
            return 0.0
    if K <= 0:
        return 0.0
    return 4 / K if tau1 == math.inf else 4 * K * tau1 / (1 + K) ** 2


def _better(controller: Controller, series: SeriesPid, model: Model, needed: float) -> Iterator[Controller]:
    """Settings with which the poles of the model without its dead time are real.

    By more gain alone, by the gain of SIMC and the integral time for it, by a longer integral time alone.
    """
    gain = needed / series.tau_I
    if isinstance(model, FirstOrderDelay):
        r = model.tau1 / series.tau_I  # > 1: needed is never above tau1
        gain = (2 * r - 1 + 2 * math.sqrt(r * (r - 1))) / (series.Kc * model.k)
    yield times(controller, gain, 1.0)
    if model.theta and (Kc := simc(model).to_series().Kc) / series.Kc > 1:
        yield times(controller, Kc / series.Kc, real_poles_from(model, Kc) / series.tau_I)
    yield times(controller, 1.0, needed / series.tau_I)


def times(controller: Controller, gain: float, integral: float) -> Controller:
    """The controller with another gain, and another integral time, in its own form."""
    match controller:
        case SeriesPid() | IdealPid():
            return replace(controller, Kc=controller.Kc * gain, tau_I=controller.tau_I * integral)
        case ParallelPid():
            Kp, Ki, Kd = controller.Kp * gain, controller.Ki * gain / integral, controller.Kd * gain
            return replace(controller, Kp=Kp, Ki=Ki, Kd=Kd)
        case IController():
            return replace(controller, K_I=controller.K_I * gain / integral)


def _slow_pair(loop: Loop, theta: float) -> ClosedLoopPole | None:
    """The rightmost pair of closed-loop poles with a period that is long against the dead time."""
    for pole in dominant_poles(loop):
        if pole.s.imag and not pole.cancelled and 2 * math.pi / pole.s.imag >= SLOW * theta:
            return pole
    return None


def _damped(loop: Loop, theta: float) -> str:
    """What a loop is, in words, if it is robust and damped; "" if not."""
    found = margins(loop)
    if not found.stable or exceeds(found.Ms, LARGEST_MS):
        return ""
    slow = _slow_pair(loop, theta)
    if slow is None:
        return said("the oscillation is gone, with Ms {Ms}", Ms=number(found.Ms, 3))
    if not slow.zeta >= LEAST_DAMPING:
        return ""
    return said("damping becomes {zeta}, Ms {Ms}", zeta=number(slow.zeta, 2), Ms=number(found.Ms, 3))


def settings_changed(before: Controller, after: Controller) -> str:
    """As an order: "Take Kc = 0.8"."""
    former = before.settings
    changed = [equation(name, number(v, 3)) for name, v in after.settings.items() if v != former[name]]
    return said("Take {what}", what=joined(changed))
