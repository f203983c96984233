"""A step of set point under P control: PI settings and a model from its first overshoot [SS10].

D = (dy_p - dy_inf)/dy_inf, b = dy_inf/dy_s, dy_inf ~ 0.45 (dy_p + dy_u), A = 1.152 D^2 - 1.607 D + 1:

    Kc = Kc0 A/F,   tau_I = min(0.86 A |b/(1 - b)| t_p, 2.44 t_p F)
    B = |(dy_s - dy_inf)/dy_inf|, r = 2 A/B:   k = 1/(Kc0 B), theta = t_p (0.309 + 0.209 e^{-0.61 r}), tau1 = r theta
"""

from dataclasses import dataclass
from math import exp, inf

from simc_core import checks
from simc_core.controllers.forms import SeriesPid
from simc_core.errors import InvalidParameter
from simc_core.plants.models import FirstOrderDelay, IntegratingDelay
from simc_core.wording import said

MOST = 0.6  # overshoot for which the correlation was made; dy_inf as estimated never gives less than 0.11
BEST = 0.3
INTEGRATING = 1e-3  # relative offset below which the plant is an integrator to this test


@dataclass(frozen=True, slots=True)
class SetpointOvershoot:
    """Settings and model of the experiment.

    Parameters
    ----------
    controller : SeriesPid
        PI.
    model : FirstOrderDelay or IntegratingDelay
    overshoot : float
        D, as a fraction of the final change.
    final : float
        Change of PV at the end, as estimated.
    advice : tuple of str
        What to mind.
    """

    controller: SeriesPid
    model: FirstOrderDelay | IntegratingDelay
    overshoot: float
    final: float
    advice: tuple[str, ...]


def setpoint_overshoot(
    Kc0: float, setpoint: float, peak: float, peak_time: float, lowest: float, F: float = 1.0
) -> SetpointOvershoot:
    """PI settings and a model from a set-point step under P control.

    Parameters
    ----------
    Kc0 : float
        Gain of the P controller.
    setpoint : float
        Step of the set point, dy_s.
    peak : float
        Change of PV at its first peak, dy_p.
    peak_time : float
        Time from the step to that peak, > 0.
    lowest : float
        Change of PV at the first minimum after the peak, dy_u.
    F : float
        Detuning, 1 for tight control, larger for smoother, 0.5 to 10.

    Returns
    -------
    SetpointOvershoot

    Raises
    ------
    InvalidParameter
        A number outside its bounds, or an overshoot above 0.6, for which there is no correlation.

    References
    ----------
    [SS10]; the model [SG12].

    Examples
    --------
    Read from the response of the published example E2:

    >>> from simc_core import setpoint_overshoot
    >>> found = setpoint_overshoot(1.5, 1.0, peak=0.7816, peak_time=4.446, lowest=0.5443)
    >>> round(found.controller.Kc, 3), round(found.controller.tau_I, 2)
    (0.919, 3.46)
    """
    Kc0 = checks.gain("Kc0", Kc0)
    setpoint = checks.gain("setpoint", setpoint)
    peak_time = checks.positive_time("peak_time", peak_time)
    F = checks.real("F", F, 0.5, 10.0)
    up = checks.real("peak", peak, -checks.LARGEST_GAIN, checks.LARGEST_GAIN) / setpoint
    down = checks.real("lowest", lowest, -checks.LARGEST_GAIN, checks.LARGEST_GAIN) / setpoint
    if not 0 <= down < up:
        raise InvalidParameter(
            said(
                "lowest must lie between 0 and peak, in the direction of the set-point step, found {lowest:g} and "
                "{peak:g}",
                lowest=float(lowest),
                peak=float(peak),
            )
        )
    final = 0.45 * (up + down)  # b, as a share of the step
    overshoot = (up - final) / final
    if overshoot > MOST:
        raise InvalidParameter(
            said(
                "The overshoot must be at most {most:g}, best {best:g}, found {overshoot:.2g}: repeat with a smaller "
                "Kc0",
                most=MOST,
                best=BEST,
                overshoot=overshoot,
            )
        )
    A = 1.152 * overshoot**2 - 1.607 * overshoot + 1
    offset = abs(1 - final)
    share = final / offset if offset > INTEGRATING else inf
    controller = SeriesPid(Kc0 * A / F, min(0.86 * A * share * peak_time, 2.44 * peak_time * F))
    return SetpointOvershoot(
        controller, _model(Kc0, A, offset / final, peak_time), overshoot, final * setpoint, _advice(overshoot, final)
    )


def _model(Kc0: float, A: float, B: float, peak_time: float) -> FirstOrderDelay | IntegratingDelay:
    if B <= INTEGRATING:  # r without end: k/tau1 = 1/(Kc0 B r theta) = 1/(2 A Kc0 theta)
        theta = 0.309 * peak_time
        return IntegratingDelay(1 / (2 * A * Kc0 * theta), theta)
    r = 2 * A / B
    theta = peak_time * (0.309 + 0.209 * exp(-0.61 * r))
    return FirstOrderDelay(1 / (Kc0 * B), theta, r * theta)


def _advice(overshoot: float, final: float) -> tuple[str, ...]:
    found = []
    if overshoot < 0.2:
        found.append(
            said(
                "The overshoot is {overshoot:.2f}; at 0.1 the gain comes out 12 to 27 % low. Aim at 0.3.",
                overshoot=overshoot,
            )
        )
    if final > 1:
        found.append(
            said("PV ends beyond the set point, which P control alone does not do: read peak and minimum again.")
        )
    elif final > 0.9:
        found.append(said("The offset is small: k and tau1 are not known, only k/tau1; the settings need no more."))
    return tuple(found)
