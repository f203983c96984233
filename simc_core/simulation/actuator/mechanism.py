"""What a real actuator makes of the output it is sent: steps of its resolution, a dead band, a slow motion, play.

One after the other, u being where the actuator was:

    resolution    q round(v/q)
    dead band     u while |v - u| <= band, else v          a positioner that rests
    rate limit    u moved towards v by rate dt at most
    backlash      u while v is within width/2 of it, else v -+ width/2     play of a linkage

The controller knows none of it: its anti-windup follows the limits, not the actuator.
"""

import math
from collections.abc import Callable

Moved = Callable[[float, float], float]  # from the value sent and where the actuator was to where it is


def mechanism(resolution: float, dead_band: float, step: float, backlash: float) -> Moved:
    """The actuator over one step of time; step: rate dt, math.inf for no limit; 0 for what it has not."""
    half = backlash / 2
    before = [0.0]  # where the part before the linkage is

    def moved(v: float, u: float) -> float:
        part = before[0]
        if resolution:
            v = resolution * math.floor(v / resolution + 0.5)
        if dead_band and abs(v - part) <= dead_band:
            v = part
        v = min(max(v, part - step), part + step)
        before[0] = v
        return min(max(u, v - half), v + half)

    return moved
