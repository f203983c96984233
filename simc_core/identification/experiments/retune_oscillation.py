"""Retuning from an oscillation of the running PI loop, by its period alone [SK98; SG12].

A period of about 4 theta (the limit) to 6 theta, short against tau_I: the gain is too high. A slow one, long against
tau_I: Kc tau_I is too small, and must be multiplied by about F = 0.1 (P0/tau_I)^2. All of F on tau_I is always safer;
raising Kc is not: with Kc k' = 0.5/theta and tau_I = 2 theta it makes the loop unstable.
"""

from dataclasses import dataclass
from math import inf, pi

from simc_core import checks
from simc_core.controllers.forms import IdealPid, SeriesPid
from simc_core.errors import InvalidParameter, WrongType
from simc_core.wording import said

SLOW = 3.0  # P0/tau_I from which the integral action makes the oscillation
FAST = 1.0  # and below which the gain makes it
SLOW_IN_THETA = 25.0  # P0/theta from which the gain may take its share
FAST_IN_THETA = 8.0


@dataclass(frozen=True, slots=True)
class Retuned:
    """Advice and settings.

    Parameters
    ----------
    cause : str
        "integral" (Kc tau_I too small), "gain" (Kc too large) or "unclear".
    advice : str
    controller : SeriesPid or IdealPid
        The new settings; those given where the cause is unclear.
    factor : float
        On Kc tau_I.
    """

    cause: str
    advice: str
    controller: SeriesPid | IdealPid
    factor: float


def retune_oscillation(controller: SeriesPid | IdealPid, period: float, theta: float | None = None) -> Retuned:
    """New settings for a loop that oscillates.

    Parameters
    ----------
    controller : SeriesPid or IdealPid
        As it is now, with integral action.
    period : float
        Of the oscillation, P0, > 0.
    theta : float, optional
        Effective dead time, where it is known.

    Returns
    -------
    Retuned

    Raises
    ------
    InvalidParameter
        Without integral action, or a number outside its bounds.
    WrongType
        Another controller.

    References
    ----------
    [SK98], [SG12]

    Examples
    --------
    A period of 40 with tau_I = 4: all of the factor goes to tau_I, for theta is not known:

    >>> from simc_core import SeriesPid, retune_oscillation
    >>> found = retune_oscillation(SeriesPid(0.5, 4), period=40)
    >>> found.cause, round(found.factor, 1), round(found.controller.tau_I, 1)
    ('integral', 10.1, 40.5)
    """
    if not isinstance(controller, SeriesPid | IdealPid):
        raise WrongType(
            said("controller must be a SeriesPid or an IdealPid, found {found}", found=type(controller).__name__)
        )
    period = checks.positive_time("period", period)
    if theta is not None:
        theta = checks.positive_time("theta", theta)
    if controller.tau_I == inf:
        raise InvalidParameter(said("controller must have integral action, found tau_I = inf: lower Kc instead"))
    ratio = period / controller.tau_I
    short = theta is not None and period <= FAST_IN_THETA * theta
    if ratio > SLOW and not short:
        return _integral(controller, ratio, period, theta)
    if ratio < FAST or short:
        new = _with(controller, controller.Kc / 2, controller.tau_I)
        text = said(
            "A fast oscillation, its period {ratio:.2g} tau_I: the gain is too high. Halve Kc, and again while it "
            "lasts.",
            ratio=ratio,
        )
        return Retuned("gain", text, new, 0.5)
    text = said(
        "The period is {ratio:.2g} tau_I: gain and integral action may both be the cause. Make a step test, or halve "
        "Kc for a trial.",
        ratio=ratio,
    )
    return Retuned("unclear", text, controller, 1.0)


def _integral(controller: SeriesPid | IdealPid, ratio: float, period: float, theta: float | None) -> Retuned:
    factor = ratio**2 / pi**2  # 0.1 as printed
    Kc = controller.Kc
    text = said(
        "A slow oscillation, its period {ratio:.2g} tau_I: Kc tau_I is too small. Multiply it by {factor:.2g}: all of "
        "it on tau_I, which is safe whatever the dead time.",
        ratio=ratio,
        factor=factor,
    )
    if theta is not None and period > SLOW_IN_THETA * theta:
        # the oscillation itself shows Kc k' = (2 pi/P0)^2 tau_I: up to SIMC's own gain, Kc k' = 1/(2 theta), it is free
        allowed = period**2 / (4 * pi**2 * controller.tau_I) / (2 * theta)
        Kc = controller.Kc * min(max(allowed, 1.0), factor)
        text = said(
            "A slow oscillation, its period {ratio:.2g} tau_I: Kc tau_I is too small. Multiply it by {factor:.2g}: Kc "
            "takes {share:.2g} of it, up to SIMC's gain for this dead time, tau_I the rest.",
            ratio=ratio,
            factor=factor,
            share=Kc / controller.Kc,
        )
    share = factor / (Kc / controller.Kc)
    return Retuned("integral", text, _with(controller, Kc, controller.tau_I * share), factor)


def _with(controller: SeriesPid | IdealPid, Kc: float, tau_I: float) -> SeriesPid | IdealPid:
    kind = type(controller)
    return kind(Kc, tau_I, controller.tau_D, controller.tau_F, controller.b, controller.c)
