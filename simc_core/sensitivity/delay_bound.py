"""The dead-time error that |T| alone vouches for: |e^{-j omega delta} - 1| < 1/|T(j omega)| at every frequency.

A smaller bound than the delay margin, which knows the phase of L too; but it holds for any error of that size in
magnitude. With |T| > 1/2 it is delta < 2 asin(1/(2 |T|))/omega. [RMS86]
"""

import math

import numpy as np
from scipy.optimize import minimize_scalar

from simc_core.certificate.verdict import stability
from simc_core.errors import NotStable
from simc_core.loops.loop import Loop
from simc_core.sensitivity.log_response import FactoredResponse, sensitivities
from simc_core.sensitivity.search_grid import search_grid
from simc_core.wording import said

LOG_OMEGA_PRECISION = 1e-12


def delay_bound(loop: Loop) -> float:
    """Largest additional dead time that the bound of the module docstring allows, in the user's time unit.

    0.0 for a neutral loop whose |T| comes back to 1/2 or more for ever, math.inf where |T| never exceeds 1/2.
    Raises NotStable.
    """
    if stability(loop).verdict != "stable":
        raise NotStable(said("a bound for dead-time errors exists for a stable loop only, found one that is not"))
    response = FactoredResponse(loop.L)
    gain, power = response.at_infinity
    last = abs(gain) if power == 0 else 0.0
    if last and last / abs(1 - last if response.theta else 1 + gain) >= 0.5:
        return 0.0

    def allowed(omega: np.ndarray) -> np.ndarray:
        size = np.maximum(np.abs(sensitivities(response.log_derivatives(omega)[0])[1]), 0.5)
        return 2 * np.arcsin(0.5 / size) / omega * np.where(size > 0.5, 1.0, math.inf)

    omega = search_grid([response], lambda omega, _: response.log_derivatives(omega)).omega
    values = allowed(omega)
    if not np.isfinite(values).any():
        return math.inf
    i = int(values.argmin())
    ends = math.log(omega[max(i - 1, 0)]), math.log(omega[min(i + 1, len(omega) - 1)])
    found = minimize_scalar(
        lambda x: float(allowed(np.full(1, math.exp(x)))[0]),
        bounds=ends,
        method="bounded",
        options={"xatol": LOG_OMEGA_PRECISION},
    )
    return min(float(found.fun), float(values[i]))
