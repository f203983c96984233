"""How long a loop is worth watching, and when its load step begins, where the scenario leaves that open."""

import math
from functools import lru_cache

import numpy as np

from simc_core.certificate.poles import dominant_poles
from simc_core.certificate.verdict import stability
from simc_core.errors import SimcError
from simc_core.loops.loop import Loop
from simc_core.simulation.scenario import Scenario

TIME_CONSTANTS_TO_REST = 4.6  # time constants of the slowest mode, e^{-4.6} = 1 %
GROWN = 6.0  # time constants of an unstable mode that are shown
LONGEST = 1e5  # default horizon, in units of all times of plant and controller together
NICE = (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)


def times(loop: Loop, scenario: Scenario) -> tuple[float, float]:
    """disturbance_time and t_end, chosen where the scenario leaves them open."""
    if scenario.t is not None:
        t_end = float(scenario.t[-1]) or 1.0
        begins = scenario.disturbance_time
        return (t_end / 2 if begins is None else begins), t_end
    if scenario.t_end is not None:
        begins = scenario.t_end / 2 if scenario.disturbance_time is None else scenario.disturbance_time
        return begins, scenario.t_end
    part = settling_horizon(loop)
    begins = part + scenario.setpoint_ramp if scenario.disturbance_time is None else scenario.disturbance_time
    return begins, begins + scenario.disturbance_ramp + part


@lru_cache(maxsize=64)  # a page that shows a loop asks again and again
def settling_horizon(loop: Loop) -> float:
    """A round time in which the slowest closed-loop mode settles to 1 %; of an unstable loop, shows what grows."""
    scale, form = loop.plant.total_time, loop.controller.to_parallel()
    scale += abs(form.Kp / form.Ki) if form.Ki else 0.0
    scale = scale or 1.0
    try:
        rates = np.array([*[pole.s.real for pole in dominant_poles(loop)], *_line(loop)])
    except SimcError:
        rates = np.zeros(0)
    growing, falling = rates[rates > 0], -rates[rates < 0]
    if len(growing):
        time = GROWN / float(np.max(growing))
    elif len(falling):
        time = TIME_CONSTANTS_TO_REST / float(np.min(falling)) + loop.plant.theta
    else:
        time = 10 * scale
    return round_up(min(max(time, 3 * loop.plant.theta, scale * 1e-6), LONGEST * scale))


def _line(loop: Loop) -> list[float]:
    """Real part that the countless poles of a neutral loop approach, where they grow."""
    neutral = stability(loop).neutral if loop.plant.theta else 0.0
    return [math.log(neutral) / loop.plant.theta] if neutral > 1 else []


def round_up(time: float) -> float:
    """The next round number."""
    power = 10.0 ** math.floor(math.log10(time))
    return next(nice * power for nice in NICE if nice * power >= time * (1 - 1e-9))
