"""`python -m benchmarks.fuzz`: random loops against independent methods, for a minute; the same ones each time.

    poles       the certificate against a count along a contour (tests/oracles/pole_count.py)
    Ms          no frequency of a fine grid has a larger |S|, and the one that is named has it
    responses   y after a step of r and of d against 75 digits (tests/oracles/high_precision.py), every eighth loop
    scale       margins and IAE of the same loop in other units of time and gain

The last line counts what disagrees, or failed without words; the loop is printed. Bounded: it ends with the minute.
"""

import sys
import time
from collections.abc import Callable, Iterator
from fractions import Fraction

import numpy as np

from simc_core import Loop, Scenario, SimcError, margins, performance, simulate, stability
from tests.oracles import pole_count
from tests.oracles.high_precision import course
from tests.oracles.random_loops import resonant_loop, simulated_loop, third_unstable_loop, wild_loop

MINUTE, SEED = 60.0, 11  # s
GENERATORS = (third_unstable_loop, resonant_loop, simulated_loop, wild_loop)
GRID = 20_000  # frequencies
SAME, PEAK, EXACT = 1e-6, 1e-9, 1e-8
TIME, GAIN = Fraction(60), 7.0
EVERY = 8


def poles(loop: Loop) -> bool | None:
    """Whether both methods count the same; None where the other one has no answer."""
    found, counted = stability(loop), pole_count.unstable(loop.L)
    return None if counted is None or found.verdict == "marginal" else found.unstable_poles == counted


def peak(loop: Loop) -> bool | None:
    """Whether Ms is the largest |S|."""
    judged = margins(loop)
    if not judged.stable or stability(loop).neutral:  # a neutral loop may have its largest |S| at no frequency
        return None
    omega = judged.omega_Ms * np.geomspace(1e-4, 1e4, GRID)
    named = abs(1 / (1 + loop.L(1j * np.array([judged.omega_Ms]))[0]))
    grid = float(np.max(np.abs(1 / (1 + loop.L(1j * omega)))))
    return bool(grid <= judged.Ms * (1 + PEAK) and abs(named / judged.Ms - 1) <= SAME)


def response(loop: Loop) -> bool | None:
    """Whether y is that of high precision at three instants."""
    if not loop.plant.theta or stability(loop).verdict != "stable":
        return None
    t = loop.plant.theta * np.array([0.0, 1.7, 3.3, 6.1])
    for load in (False, True):
        ours = simulate(loop, Scenario(0.0 if load else 1.0, 1.0 if load else 0.0, 0.0, t=t)).y
        theirs = np.array([course(loop, load, float(t[-1])).at(instant)[0] for instant in t.tolist()], dtype=float)
        if np.max(np.abs(ours - theirs)) > EXACT * max(float(np.max(np.abs(theirs))), 1.0):
            return False
    return True


def scale(loop: Loop) -> bool | None:
    """Whether the loop in other units has the same margins, and its IAE in them."""
    judged = margins(loop)
    if not judged.stable:
        return None
    other = Loop(loop.plant.rescaled(TIME, GAIN), loop.controller.rescaled(TIME, 1 / GAIN))
    mine, theirs = performance(loop).setpoint.IAE, performance(other).setpoint.IAE
    pairs = [(judged.Ms, margins(other).Ms), (mine * int(TIME), theirs)]
    return all(a == b or np.isnan([a, b]).any() or abs(a / b - 1) <= SAME for a, b in pairs)


CHECKS: dict[str, Callable[[Loop], bool | None]] = {"poles": poles, "Ms": peak, "responses": response, "scale": scale}


def loops() -> Iterator[Loop]:
    """Of the four kinds in turn, without end."""
    rng = np.random.default_rng(SEED)
    while True:
        for make in GENERATORS:
            try:
                yield make(rng)
            except SimcError:  # beyond the bounds of a plant
                continue


def main() -> int:
    """Check until the minute is over; how many disagree."""
    counts, wrong = dict.fromkeys(CHECKS, 0), 0
    end = time.monotonic() + MINUTE
    for i, loop in enumerate(loops()):
        for name, check in CHECKS.items():
            if time.monotonic() > end:
                break
            if name == "responses" and i % EVERY:
                continue
            try:
                right = check(loop)
            except SimcError:  # refused in words
                continue
            except Exception as error:
                right = False
                print(f"{name}: {type(error).__name__} {error}")
            counts[name] += right is not None
            if right is False:
                wrong += 1
                print(f"{name}: {loop}", flush=True)
        else:
            continue
        break
    print(", ".join(f"{name} {count}" for name, count in counts.items()) + f"; {wrong} disagree")
    return wrong


if __name__ == "__main__":
    sys.exit(bool(main()))
