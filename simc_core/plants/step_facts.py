"""A plant from the facts of one step test, as an engineer reads them off a trend.

    k = dPV/dOP        theta: from the step of OP to the first movement of PV
    tau1 = t63 - theta, t63 from the step to 63 % of the change (1 - 1/e = 0.632 of it, theta + tau1 of a first order)

An integrating process has no end of its change: PV goes on with a slope, and k_prime = slope/dOP.
"""

import math

from simc_core import checks
from simc_core.errors import InvalidParameter
from simc_core.plants.models import FirstOrderDelay, IntegratingDelay

AT_63 = 1 - 1 / math.e  # of the change, one time constant after the first movement


def plant_of_step(change_OP: float, change_PV: float, theta: float, t63: float, from_step: bool = True):
    """First-order model of a self-regulating process.

    Parameters
    ----------
    change_OP, change_PV : float
        How far the controller output was moved, and how far PV went in the end; signs count.
    theta : float
        Time from the step to the first movement of PV, >= 0.
    t63 : float
        Time to 63 % of the change of PV.
    from_step : bool
        Whether t63 counts from the step of OP; else from the first movement.

    Returns
    -------
    FirstOrderDelay
        k = change_PV/change_OP, theta, tau1.

    Raises
    ------
    InvalidParameter
        A change of 0, or t63 from the step that is not longer than theta.

    Examples
    --------
    >>> plant_of_step(5.0, 11.0, 20.0, 180.0)
    FirstOrderDelay(k=2.2, theta=20.0, tau1=160.0)
    """
    change_OP, change_PV = checks.gain("change of OP", change_OP), checks.gain("change of PV", change_PV)
    theta, t63 = checks.optional_time("dead time", theta), checks.positive_time("time to 63 %", t63)
    if from_step and t63 <= theta:
        raise InvalidParameter(
            f"time to 63 % must be > dead time = {theta:g} where it counts from the step, got {t63:g}: "
            "or does it count from the first movement?"
        )
    return FirstOrderDelay(change_PV / change_OP, theta, t63 - theta if from_step else t63)


def plant_of_ramp(change_OP: float, change_PV: float, duration: float, theta: float) -> IntegratingDelay:
    """Integrating model of a process that goes on moving after the step.

    Parameters
    ----------
    change_OP : float
        How far the controller output was moved from where PV stood still.
    change_PV, duration : float
        How far PV then moved in how long a time, once it moved at a constant rate.
    theta : float
        Time from the step to the first movement of PV, >= 0.

    Returns
    -------
    IntegratingDelay
        k_prime = change_PV/(duration change_OP), theta.

    Raises
    ------
    InvalidParameter
        A change of 0, or a duration that is not > 0.

    Examples
    --------
    >>> plant_of_ramp(10.0, 30.0, 60.0, 2.0)
    IntegratingDelay(k_prime=0.05, theta=2.0, tau2=0.0)
    """
    change_OP, change_PV = checks.gain("change of OP", change_OP), checks.gain("change of PV", change_PV)
    duration = checks.positive_time("duration of the movement", duration)
    return IntegratingDelay(change_PV / change_OP / duration, checks.optional_time("dead time", theta))
