"""`make bench`: a list of loops in batches, row by row, by the single functions of a script, and by Pade(10).

The list is that of a plant: 45 % first order, 25 % second order, 12 % integrating, 12 % fourth order, 6 % with inverse
response, PI by SIMC at tau_c = theta; each loop has settings, margins and both step metrics. CPU time of one process.
Row by row: `tune_row`. By single functions: half_rule, simc, margins, performance. The peer: its recompute of one loop
(responses at 600 points, margins), for some of the loops. Then 4000 loops of every kind with 100 bad rows among them:
none lost, and the memory of it. A table, and results/many.json.
"""

import resource
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from benchmarks.recompute import FREQUENCIES, POINTS, forgotten, keep, peer, pin
from simc_core import Loop, Result, half_rule, margins, performance, simc, tune_many, tune_row
from simc_core.many.request import read_request
from tests.many.lists import mixed_rows

LOOPS, SINGLE, PEERS, ROUNDS = 2000, 300, 40, 3
NASTY = {"plant": "(10s+1)exp(-100s)/((0.001s+1)(20s+1))", "kind": "PID"}


def main() -> None:
    """Print the tables and write the JSON."""
    pin()
    rows = plant_list(LOOPS)
    list(tune_many(rows[:100]))  # loaded and warm
    jobs: dict[str, tuple[Callable[[], object], int]] = {
        "batch": (lambda: list(tune_many(rows)), LOOPS),
        "row by row": (lambda: [tune_row(row) for row in rows[:SINGLE]], SINGLE),
        "single functions": (lambda: [_single(row) for row in rows[:SINGLE]], SINGLE),
        "Pade(10)": (lambda: [_peer(row) for row in rows[:PEERS]], PEERS),
    }
    taken: dict[str, list[float]] = {name: [] for name in jobs}
    for _ in range(ROUNDS):
        for name, (job, loops) in jobs.items():
            forgotten()
            start = time.process_time()
            job()
            taken[name].append((time.process_time() - start) / loops)
    seconds = {name: float(np.median(values)) for name, values in taken.items()}
    print("\n| a loop of a list | CPU, ms | times the batch | loops a CPU second |\n|---|---|---|---|")
    for name, each in seconds.items():
        print(f"| {name} | {1e3 * each:.2f} | {each / seconds['batch']:.1f} | {1 / each:.0f} |")
    bad, lost, difference = _with_bad_rows()
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print("\n| 4000 rows of every kind | bad | lost | largest difference from row by row | memory, MB |")
    print(f"|---|---|---|---|---|\n| | {bad} | {lost} | {difference:.0e} | {peak:.0f} |")
    keep("many", [{"seconds": seconds, "bad": bad, "lost": lost, "difference": difference, "MB": peak}])


def plant_list(number: int, seed: int = 5) -> list[dict[str, Any]]:
    """Rows of the mix in the module's docstring, most of them in columns of numbers."""
    rng = np.random.default_rng(seed)
    rows: list[dict[str, Any]] = []
    for i in range(number):
        kind, sign = rng.random(), float(rng.choice([-1, 1]))
        k, theta = sign * float(10 ** rng.uniform(-1, 1)), float(10 ** rng.uniform(-1, 1))
        tau = theta * float(10 ** rng.uniform(-0.5, 1.3))
        row: dict[str, Any] = {"tag": f"L{i}", "k": k, "theta": theta, "tau1": tau}
        if 0.45 <= kind < 0.7:
            row["tau2"] = tau * float(rng.uniform(0.1, 1))
        elif 0.7 <= kind < 0.82:
            row = {"tag": f"L{i}", "k_prime": k, "theta": theta, "tau2": 0.3 * tau}
        elif kind >= 0.82:
            lags = (tau, 0.5 * tau, 0.2 * tau, 0.05 * tau) if kind < 0.94 else (tau, 0.5 * tau)
            zero = f"(1 - {0.2 * tau:.6g} s)" if kind >= 0.94 else ""
            bottom = "".join(f"({each:.6g} s + 1)" for each in lags)
            row = {"tag": f"L{i}", "plant": f"{k:.6g} {zero} exp(-{theta:.6g} s)/({bottom})"}
        rows.append(row)
    return rows


def _single(row: dict[str, Any]) -> object:
    plant = read_request(row).plant
    loop = Loop(plant, simc(half_rule(plant).model))
    return margins(loop), performance(loop)


def _peer(row: dict[str, Any]) -> object:
    plant = read_request(row).plant
    model = half_rule(plant).model
    scale = model.theta
    t, omega = np.linspace(0, 40 * scale, POINTS), np.geomspace(0.01, 30, FREQUENCIES) / scale
    return peer(Loop(plant, simc(model)), 10, t, omega)


def _with_bad_rows() -> tuple[int, int, float]:
    """Bad rows, rows that were lost, and the largest relative difference in Ms and load IAE of 571 rows alone.

    Of plants that are stable without a controller; an unstable one lets rounding grow.
    """
    rows, bad = mixed_rows(4000, 100)
    rows[7] = {"tag": "L7", **NASTY}
    together = list(tune_many(rows))
    lost = sum(result.tag != row["tag"] for result, row in zip(together, rows, strict=True))
    lost += sum(not together[i].refusal for i in bad)
    pairs = [(result, tune_row(result.row)) for result in together[::7]]
    differences = [
        max(abs(a / b - 1) for a, b in zip(_numbers(one), _numbers(other), strict=True))
        for one, other in pairs
        if one.performance and other.performance and one.plant and not one.plant.unstable_poles
    ]
    return len(bad), lost, max(differences)


def _numbers(result: Result) -> tuple[float, float]:
    assert result.margins is not None
    assert result.performance is not None
    return result.margins.Ms, result.performance.disturbance.IAE


if __name__ == "__main__":
    main()
