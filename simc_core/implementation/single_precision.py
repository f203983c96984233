"""What an integral in single precision no longer sees."""

import math

import numpy as np


def dead_error(integral: float, Ki: float, h: float, single: bool = True) -> float:
    """The error below which h Ki e is lost when it is added to the integral: ulp(I)/2/(h |Ki|).

    Parameters
    ----------
    integral : float
        I, in units of the output.
    Ki, h : float
        Integral gain and sampling period.
    single : bool
        32 bits (REAL, float; double of an AVR), else 64.

    Returns
    -------
    float
        In units of PV; math.inf without integral action.
    """
    ulp = float(np.spacing((np.float32 if single else np.float64)(abs(integral))))
    return ulp / 2 / (h * abs(Ki)) if Ki else math.inf
