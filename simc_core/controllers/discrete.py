"""The law of a sampled PID controller, at t = 0, h, 2h, ...; simulation, margins and exports share it.

    "backward"   backward differences
    "tustin"     bilinear transformation, nearer to the continuous controller; needs tau_F >= h/2 for derivative action

I is kept in the unit of u, so the gains may change on line. The last term of I is the anti-windup of the sample before,
pull = min(h/T_t, 1). u, what the actuator made of v, is written into the state by whoever limits it.

y, r and the state may be numbers, or arrays: the rows by which they are made of something else.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from simc_core import checks
from simc_core.controllers.forms import ParallelPid
from simc_core.errors import InvalidParameter
from simc_core.wording import said

MOST_SCANS = 100  # between a sample and the output made of it

Signal = float | np.ndarray


class State(NamedTuple):
    """What is remembered from one sample to the next; all zero at rest."""

    y: Signal = 0.0
    r: Signal = 0.0
    yF: Signal = 0.0
    rF: Signal = 0.0
    dy: Signal = 0.0
    dr: Signal = 0.0
    I: Signal = 0.0  # noqa: E741 the name of the field
    v: Signal = 0.0
    u: Signal = 0.0


def backward(pid: ParallelPid, h: float, pull: float, s: State, r: Signal, y: Signal) -> State:
    """One sample by backward differences."""
    a = pid.tau_F / (pid.tau_F + h)
    yF, rF = a * s.yF + (1 - a) * y, a * s.rF + (1 - a) * r
    dy, dr = (yF - s.yF) / h, (rF - s.rF) / h
    I = s.I + h * pid.Ki * (rF - yF) + pull * (s.u - s.v)  # noqa: E741
    v = pid.Kp * (pid.b * rF - yF) + I + pid.Kd * (pid.c * dr - dy)
    return State(y, r, yF, rF, dy, dr, I, v, v)


def tustin(pid: ParallelPid, h: float, pull: float, s: State, r: Signal, y: Signal) -> State:
    """One sample by the bilinear transformation; without a filter there is no derivative action."""
    a, g = (2 * pid.tau_F - h) / (2 * pid.tau_F + h), h / (2 * pid.tau_F + h)
    yF, rF = a * s.yF + g * (y + s.y), a * s.rF + g * (r + s.r)
    dy, dr = a * s.dy + 2 * g / h * (y - s.y), a * s.dr + 2 * g / h * (r - s.r)
    if not pid.tau_F:
        yF, rF, dy, dr = y, r, 0 * y, 0 * r
    I = s.I + h / 2 * pid.Ki * (rF - yF + s.rF - s.yF) + pull * (s.u - s.v)  # noqa: E741
    v = pid.Kp * (pid.b * rF - yF) + I + pid.Kd * (pid.c * dr - dy)
    return State(y, r, yF, rF, dy, dr, I, v, v)


def backward_response(pid: ParallelPid, h: float, log_z: np.ndarray) -> np.ndarray:
    """From -y to v of `backward` at z = e^{log_z}, without limits."""
    difference = -np.expm1(-log_z)  # 1 - 1/z
    return (pid.Kp + h * pid.Ki / difference + pid.Kd / h * difference) / (1 + pid.tau_F / h * difference)


def tustin_response(pid: ParallelPid, h: float, log_z: np.ndarray) -> np.ndarray:
    """From -y to v of `tustin` at z = e^{log_z}: the continuous one at s = (2/h) (z - 1)/(z + 1)."""
    s = 2 / h * np.tanh(log_z / 2)
    return (pid.Kp + pid.Ki / s + pid.Kd * s) / (1 + pid.tau_F * s)


class Law(NamedTuple):
    """A sampled law: how one sample is taken, and its response."""

    step: Callable[..., State]
    response: Callable[[ParallelPid, float, np.ndarray], np.ndarray]


LAWS = {"backward": Law(backward, backward_response), "tustin": Law(tustin, tustin_response)}


def known_law(law: str) -> str:
    """`law` if it is one of LAWS. Raises InvalidParameter."""
    return checks.one_of("law", law, LAWS)


def scans(name: str, value: int) -> int:
    """Whole sampling periods after which an output is written, if they are some. Raises InvalidParameter."""
    return checks.whole(name, value, 0, MOST_SCANS)


def law_for(law: str, pid: ParallelPid, h: float) -> Law:
    """The law for this controller. Raises InvalidParameter: not one of LAWS, or "tustin" with a filter that rings."""
    if known_law(law) == "tustin" and (pid.tau_F or pid.Kd) and pid.tau_F < h / 2:
        raise InvalidParameter(
            said(
                'tau_F must be >= h/2 = {half:g} for the law "tustin" (0 will do without derivative action), '
                'found {tau_F:g}: "backward" has no such limit',
                half=h / 2,
                tau_F=pid.tau_F,
            )
        )
    return LAWS[law]
