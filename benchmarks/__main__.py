"""`make bench`: the full recompute of a tuning against python-control with Pade(5) and Pade(10), as ratios.

Both compute y and u for a set-point and a load step at 600 points, step metrics, five frequency responses at 400
frequencies, all margins, and whether the loop is stable. One pinned core, RUNS of each in turn, medians of the rounds.
A table, and results/engine.json.
"""

import numpy as np

from benchmarks.recompute import FREQUENCIES, POINTS, forgotten, keep, median_times, peer, pin
from simc_core import Loop, Plant, Scenario, SeriesPid, frequency_response, margins, performance, simulate
from simc_core.simulation.horizon import times

CASES = {
    "FOPDT, lag dominant": Loop(Plant(1, 1, (8,)), SeriesPid(4, 8)),
    "FOPDT, delay dominant": Loop(Plant(1, 1, (0.1,)), SeriesPid(0.05, 0.1)),
    "integrating": Loop(Plant(1, 1, integrators=1), SeriesPid(0.5, 8)),
    "SOPDT, PID": Loop(Plant(1, 1, (6, 3)), SeriesPid(3, 6, 3, 0.3)),
    "V06 example 1": Loop(Plant(1, 3, (6, 4, 2)), SeriesPid(4 / 7, 8)),
    "unstable": Loop(Plant(-1, 1, (-4,)), SeriesPid(2.5, 20)),
    "inverse response": Loop(Plant(1, 0.5, (10, 6, 1), (-2,)), SeriesPid(1, 13)),
    "oscillating": Loop(Plant(1, 1, (2,), lag_pairs=((1, 0.3),)), SeriesPid(0.3, 2)),
    "order 12": Loop(Plant(1, 2, (100, 50, 20, 10, 5, 2, 1, 0.5, 0.2, 0.1, 0.05, 0.01)), SeriesPid(2, 100)),
    "horizon/theta = 1e4": Loop(Plant(1, 0.01, (8, 0.5)), SeriesPid(4, 8)),
}
RUNS = 5  # one after the other
HORIZONS = {"horizon/theta = 1e4": 100.0}


def ours(loop: Loop, t_end: float, omega: np.ndarray, plants: bool = True) -> None:
    """Everything with exact dead time, nothing remembered; plants=False: a plant that has been tuned before."""
    forgotten(plants)
    simulate(loop, Scenario(t_end=t_end, points=POINTS))
    frequency_response(loop, omega)
    if margins(loop).stable:  # margins carries the certificate
        performance(loop)


def main() -> None:
    """Print the table and write the JSON."""
    pin()
    rows = []
    print("| case | new plant, ms | retuned, ms | Pade(5) | Pade(10) | ratios to Pade(10) | errors of y, both |")
    print("|---|---|---|---|---|---|---|")
    for name, loop in CASES.items():
        t_end = HORIZONS.get(name) or times(loop, Scenario())[1]
        t = np.linspace(0.0, t_end, POINTS)
        omega = np.geomspace(0.5 / t_end, 50 / max(loop.plant.theta, t_end / 1000), FREQUENCIES)
        taken = median_times(
            {
                "ours": lambda loop=loop, end=t_end, omega=omega: ours(loop, end, omega),
                "retuned": lambda loop=loop, end=t_end, omega=omega: ours(loop, end, omega, plants=False),
                "Pade(5)": lambda loop=loop, t=t, omega=omega: peer(loop, 5, t, omega),
                "Pade(10)": lambda loop=loop, t=t, omega=omega: peer(loop, 10, t, omega),
            },
            RUNS,
        )
        exact = simulate(loop, Scenario(disturbance=0.0, t=t)).y
        errors = [float(np.max(np.abs(peer(loop, order, t, omega) - exact))) for order in (5, 10)]
        ratios = [taken["Pade(10)"] / taken[key] for key in ("ours", "retuned")]
        rows.append({"case": name, "seconds": taken, "ratios": ratios, "pade5_10_errors": errors})
        shown = " | ".join(f"{1e3 * taken[key]:.1f}" for key in ("ours", "retuned", "Pade(5)", "Pade(10)"))
        print(f"| {name} | {shown} | {ratios[0]:.1f}, {ratios[1]:.1f} | {errors[0]:.1e}, {errors[1]:.1e} |")
    keep("engine", rows)


if __name__ == "__main__":
    main()
