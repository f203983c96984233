"""`make bench`: optimal PI and PID controllers, whole fronts, and scipy's differential evolution on the same work.

Differential evolution searches log Kc, log tau_I (and log tau_D) for the same criterion, margins and metrics being
those of the library, with a penalty beyond the bound; population and generations as scipy has them by default but for
`maxiter`. "value" is our IAE over its: at most 1 is as good or better. Nothing is remembered from round to round.
Times are those of the processor, medians. A table, and results/optimum.json.
"""

import math
import time
from collections.abc import Callable

import numpy as np
from scipy.optimize import differential_evolution

from benchmarks.recompute import forgotten, keep, pin
from simc_core import IdealPid, Loop, Plant, comparison, margins, optimal, performance, trade_off
from simc_core.optimal.robust_gains import robust_gains
from simc_core.optimal.under_ms import references
from simc_core.studies.optimum import front

MS, GENERATIONS, ROUNDS = 1.59, 30, 5
CASES = {
    "FOPDT, balanced": Plant(1, 1, (1,)),
    "FOPDT, lag dominant": Plant(1, 1, (8,)),
    "integrating": Plant(1, 1, integrators=1),
    "four lags": Plant(1, 0, (1, 1, 1, 1)),
    "SOPDT": Plant(1, 1, (6, 2)),
}


def main() -> None:
    """Print the tables and write the JSON."""
    pin()
    rows = []
    print("\n| optimum for the load at Ms = 1.59 | ms | front of 20, ms | differential evolution, ms | ratio | value |")
    print("|---|---|---|---|---|---|")
    for name, plant in CASES.items():
        for kind in ("PI", "PID"):
            best = optimal(plant, kind, MS)
            taken = medians(
                {
                    "one": lambda plant=plant, kind=kind: fresh(optimal, plant, kind, MS),
                    "front": lambda plant=plant, kind=kind: fresh(trade_off, plant, kind),
                }
            )
            start = time.process_time()
            slow = evolved(plant, kind, best.controller.tau_F)
            taken["evolution"] = time.process_time() - start
            ratio, value = taken["evolution"] / taken["one"], best.value / slow
            rows.append({"case": f"{name}, {kind}", "seconds": taken, "ratio": ratio, "value": value})
            times = " | ".join(f"{1e3 * taken[each]:.0f}" for each in ("one", "front", "evolution"))
            print(f"| {name}, {kind} | {times} | {ratio:.0f} | {value:.5f} |")
    print("\n| all rules on one plant | as published, ms | at Ms = 1.59, ms |\n|---|---|---|")
    for name, plant in CASES.items():
        taken = medians(
            {
                "published": lambda plant=plant: fresh(lambda plant: list(comparison(plant)), plant),
                "equal": lambda plant=plant: fresh(lambda plant: list(comparison(plant, Ms=MS)), plant),
            }
        )
        rows.append({"case": f"rules, {name}", "seconds": taken})
        print(f"| {name} | {1e3 * taken['published']:.0f} | {1e3 * taken['equal']:.0f} |")
    keep("optimum", rows)


def medians(jobs: dict[str, Callable[[], object]]) -> dict[str, float]:
    """Seconds of the processor for each job, in turn."""
    taken: dict[str, list[float]] = {name: [] for name in jobs}
    for _ in range(ROUNDS):
        for name, job in jobs.items():
            start = time.process_time()
            job()
            taken[name].append(time.process_time() - start)
    return {name: float(np.median(values)) for name, values in taken.items()}


def fresh(function, plant: Plant, *how) -> object:
    """The result, nothing remembered."""
    forgotten()
    robust_gains.cache_clear()
    references.cache_clear()
    front.cache_clear()
    return function(plant, *how)


def evolved(plant: Plant, kind: str, tau_F: float) -> float:
    """IAE of the load that differential evolution finds."""
    best = optimal(plant, kind, MS).controller
    centre = np.log([best.Kc, best.tau_I, best.tau_D][: len(kind)]) + 0.3

    def cost(x: np.ndarray) -> float:
        loop = Loop(plant, IdealPid(*np.exp(x).tolist(), tau_F=tau_F))
        found = margins(loop)
        if not found.stable or max(found.Ms, found.Mt) > 20:
            return 20.0
        excess = math.log(max(found.Ms, found.Mt) / MS)
        return math.log(performance(loop).disturbance.IAE) + 1e3 * max(excess, 0.0)

    found = differential_evolution(
        cost, [(x - 1.5, x + 1.5) for x in centre], maxiter=GENERATIONS, seed=1, polish=False
    )
    return math.exp(found.fun)


if __name__ == "__main__":
    main()
