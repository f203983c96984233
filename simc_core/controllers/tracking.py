"""Anti-windup by back calculation: how fast the integral follows the actuator.

Source: Astrom and Hagglund, Advanced PID Control, 2006, sect. 3.5.
"""

import math

from simc_core.controllers.forms import Controller


def tracking_time(controller: Controller, k: float, integrators: int = 0) -> float:
    """T_t = sqrt(tau_I tau_D), tau_I without derivative; infinite without integral action.

    Pure integral action has no time of its own: T_t is then that of the loop K_I k/s^{n+1},  |K_I k|^{-1/(n+1)}.

    Parameters
    ----------
    controller : Controller
        In any form.
    k : float
        Gain of what it controls, in output units per input unit and time^n.
    integrators : int
        n, of what it controls.

    Returns
    -------
    float
        T_t > 0, in the time unit of the controller.
    """
    form = controller.to_parallel()
    if form.Ki == 0:
        return math.inf
    if form.Kd * form.Ki > 0:
        return math.sqrt(form.Kd / form.Ki)
    if form.Kp:
        return abs(form.Kp / form.Ki)
    return abs(form.Ki * k) ** (-1 / (integrators + 1))
