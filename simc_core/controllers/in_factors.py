"""Transfer functions of controllers in the factors that loops are made of."""

import math

from simc_core.algebra.factors import Factored, factors


def series_factors(Kc: float, tau_I: float, tau_D: float, tau_F: float) -> Factored:
    """Kc (tau_I s + 1)/(tau_I s) (tau_D s + 1)/(tau_F s + 1); tau_I may be infinite."""
    derivative, filter_ = (0.0, tau_D, 1.0), (0.0, tau_F, 1.0)
    if tau_I == math.inf:
        return Factored(Kc, factors(derivative), factors(filter_))
    return Factored(Kc / tau_I, factors((0.0, tau_I, 1.0), derivative), factors((0.0, 1.0, 0.0), filter_))


def parallel_factors(Kp: float, Ki: float, Kd: float, tau_F: float) -> Factored:
    """(Kp + Ki/s + Kd s)/(tau_F s + 1), without what is zero."""
    filter_ = (0.0, tau_F, 1.0)
    if Ki == 0 and Kd == 0:
        return Factored(Kp, factors(), factors(filter_))
    if Ki == 0:
        return Factored(1.0, factors((0.0, Kd, Kp)), factors(filter_))
    return Factored(Ki, factors((Kd / Ki, Kp / Ki, 1.0)), factors((0.0, 1.0, 0.0), filter_))
