"""What measurement noise does to the input: the variance of u, exact by Parseval.

White noise in y with a spectral density of 1 gives u the variance

    int_0^inf |KS(j omega)|^2 domega/pi = int_0^inf h(t)^2 dt

h is the impulse response of KS = C/(1 + L), the slope of u after a unit step of the set point with b = c = 1. The
engine has that step, its dead time exact, as polynomials.
"""

import math
from dataclasses import replace

import numpy as np

from simc_core.certificate.verdict import IN_WORDS, stability
from simc_core.errors import NotStable
from simc_core.loops.loop import Loop
from simc_core.metrics.step_metrics import both_steps
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P
from simc_core.simulation.one_delay.march import march
from simc_core.wording import said

NODES, WEIGHTS = np.polynomial.legendre.leggauss(P)
SLOPES = np.array([np.polynomial.chebyshev.chebval(NODES, np.polynomial.chebyshev.chebder(row)) for row in np.eye(P)])


def noise_variance(loop: Loop) -> float:
    """Variance of u under white noise in the measurement of y, int |KS|^2 domega/pi.

    Parameters
    ----------
    loop : Loop
        A stable loop, dead time exact.

    Returns
    -------
    float
        For noise with a spectral density of 1: in input units squared, per output unit squared and time. math.inf
        where KS does not fall off at high frequency: proportional action without a filter, or derivative action with
        a filter of first order.

    Raises
    ------
    NotStable
        The loop is not stable, or too near the limit to come to rest.

    Examples
    --------
    Integral action alone on a plant without dead time, KS = 1/(s + 1), and a PI controller without filter:

    >>> from simc_core import IController, Loop, Plant, SeriesPid, noise_variance
    >>> loops = Loop(Plant(1), IController(1)), Loop(Plant(1, 1, (8,)), SeriesPid(4, 8))
    >>> [round(noise_variance(loop), 9) for loop in loops]
    [0.5, inf]
    """
    verdict = stability(loop)
    if verdict.verdict != "stable":
        raise NotStable(
            said(
                "a variance exists for a stable loop only, found one that is {verdict}",
                verdict=IN_WORDS[verdict.verdict],
            )
        )
    if loop.controller.factored.relative_degree <= 0:
        return math.inf
    form = replace(loop.controller.to_parallel(), b=1.0, c=1.0)
    course = march(loop.plant, [form], None)
    if not course.at_rest[0]:
        raise NotStable(said("the loop must come to rest for a variance, found one too close to its stability limit"))
    steps = both_steps(course)
    own = steps.owner == 0
    slopes = steps.y_and_u[1, own] @ SLOPES
    return float(np.sum(2 / steps.length[own] * (slopes**2 @ WEIGHTS)))
