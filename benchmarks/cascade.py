"""`make bench`, third part: the full recompute of a cascade against two single-loop recomputes of python-control.

Ours: y1, y2 and u for r, d1 and d2 at 600 points, step metrics of all three, frequency responses of both loops at 400
frequencies, margins of both and the verdict on stability, all with both dead times exact, nothing remembered. The
peer, with Pade(10): the inner loop, and the outer controller on Ga with both dead times, each once. Then the same
with an inner dead time 4000 times shorter than the outer one. A table, and results/cascade.json.
"""

from dataclasses import replace

import numpy as np

from benchmarks.recompute import FREQUENCIES, POINTS, forgotten, keep, median_times, peer, pin
from simc_core import CascadeLoop, Loop, Scenario, frequency_response, margins, performance, simulate, stability
from simc_core.cascade.pairs import ROWS, designed
from simc_core.simulation.simulate_nested import horizon

ORDER = 10
RATIO = 4000


def ours(loop: CascadeLoop, t_end: float, omega: np.ndarray) -> None:
    """Everything about one cascade."""
    forgotten()
    simulate(loop, Scenario(t_end=t_end, points=POINTS))
    frequency_response(loop.outer_loop, omega)
    frequency_response(loop.inner_loop, omega)
    margins(loop.outer_loop)
    margins(loop.inner_loop)
    if stability(loop).sound:
        performance(loop)


def cases() -> dict[str, CascadeLoop]:
    """A design of each of the ten pairs, and the first of them with a tiny inner dead time."""
    found = {row.name: designed(row).loop for row in ROWS if row.method == "synthesis"}
    usual = found["1a"]
    tiny = replace(usual.secondary, theta=usual.primary.theta / RATIO)
    return found | {f"1a, 1:{RATIO}": replace(usual, secondary=tiny)}


def main() -> None:
    """Print the table and write the JSON."""
    pin()
    rows = []
    print("| cascade | ours, ms | inner, Pade(10) | outer, Pade(10) | ratio of both to ours |")
    print("|---|---|---|---|---|")
    for name, loop in cases().items():
        part = horizon(loop.nested)
        theta = loop.primary.theta + loop.secondary.theta
        t, omega = np.linspace(0.0, 3 * part, POINTS), np.geomspace(0.5 / part, 50 / theta, FREQUENCIES)
        outer = Loop(replace(loop.primary, theta=theta), loop.outer)
        taken = median_times(
            {
                "ours": lambda loop=loop, end=t[-1], omega=omega: ours(loop, end, omega),
                "inner": lambda loop=loop.inner_loop, t=t, omega=omega: peer(loop, ORDER, t, omega),
                "outer": lambda loop=outer, t=t, omega=omega: peer(loop, ORDER, t, omega),
            }
        )
        ratio = (taken["inner"] + taken["outer"]) / taken["ours"]
        rows.append({"cascade": name, "seconds": taken, "ratio": ratio})
        print(f"| {name} | " + " | ".join(f"{1e3 * value:.1f}" for value in taken.values()) + f" | {ratio:.2f} |")
    keep("cascade", rows)


if __name__ == "__main__":
    main()
