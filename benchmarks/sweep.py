"""`make bench`, second part: 60 values of tau_c at once against 60 recomputes of python-control with Pade(10).

Ours, for each tau_c: y and u of a set-point and of a load step at 300 points, L at 300 frequencies, stability, all
margins, IAE, TV, overshoot (simc_core.sweep), nothing remembered from round to round. The peer: the recompute of the
first part, at its 600 points and 400 frequencies; "alike" is the ratio to one at 300 and 300. The largest difference
from the single results is shown, and what n tunings cost: the cost is linear. A table, and results/sweep.json.
"""

import numpy as np

from benchmarks.recompute import FREQUENCIES as FINE_FREQUENCIES
from benchmarks.recompute import POINTS as FINE_POINTS
from benchmarks.recompute import forgotten, keep, median_times, peer, pin
from simc_core import Loop, Plant, Scenario, half_rule, margins, performance, simulate, sweep

TUNINGS, POINTS, FREQUENCIES, ORDER = 60, 300, 300, 10
COUNTS = (15, 60, 240, 1000)
CASES = {
    "FOPDT, PI": (Plant(1, 1, (8,)), 1),
    "FOPDT, delay dominant, PI": (Plant(1, 1, (0.1,)), 1),
    "SOPDT, PID": (Plant(1, 1, (8, 3)), 2),
    "integrating, PI": (Plant(1, 1, integrators=1), 1),
    "V06 example 1, PI": (Plant(1, 3, (6, 4, 2)), 1),
}


def main() -> None:
    """Print the tables and write the JSON."""
    pin()
    rows = []
    print("\n| tuned over tau_c | 60 at once, ms | 60 times Pade(10), ms | ratio | alike | difference from single |")
    print("|---|---|---|---|---|---|")
    for name, (plant, order) in CASES.items():
        model = half_rule(plant, order).model
        tau_c = np.geomspace(0.3, 30, TUNINGS) * model.theta
        t, omega = np.linspace(0, 40 * model.theta, POINTS), np.geomspace(0.01, 30, FREQUENCIES) / model.theta
        loop = Loop(plant, sweep(plant, model, tau_c[TUNINGS // 2 :], t, omega).controllers[0])

        def ours(tau_c=tau_c, plant=plant, model=model, t=t, omega=omega):
            forgotten()
            return sweep(plant, model, tau_c, t, omega)

        fine_t, fine_omega = np.linspace(0, t[-1], FINE_POINTS), np.geomspace(omega[0], omega[-1], FINE_FREQUENCIES)
        taken = median_times(
            {
                "ours": ours,
                "peer": lambda loop=loop, t=fine_t, omega=fine_omega: peer(loop, ORDER, t, omega),
                "alike": lambda loop=loop, t=t, omega=omega: peer(loop, ORDER, t, omega),
            }
        )
        ratio, alike = (TUNINGS * taken[name] / taken["ours"] for name in ("peer", "alike"))
        difference = largest_difference(ours(), plant)
        rows.append({"case": name, "seconds": taken, "ratio": ratio, "alike": alike, "difference": difference})
        both = f"{1e3 * taken['ours']:.1f} | {1e3 * TUNINGS * taken['peer']:.0f}"
        print(f"| {name} | {both} | {ratio:.1f} | {alike:.1f} | {difference:.0e} |")
    plant, order = CASES["SOPDT, PID"]
    print("\n| tunings in one call | " + " | ".join(map(str, COUNTS)) + " |\n|---|" + "---|" * len(COUNTS))
    costs = cost(plant, half_rule(plant, order).model)
    print("| ms per tuning | " + " | ".join(f"{1e3 * each:.2f}" for each in costs) + " |")
    keep("sweep", [*rows, {"tunings": COUNTS, "seconds per tuning": costs}])


def largest_difference(found, plant: Plant) -> float:
    """Between the rows of a sweep and the single results, relative to the largest value of each quantity."""
    worst = 0.0
    for i, controller in enumerate(found.controllers):
        if not found.stable[i]:
            continue
        loop = Loop(plant, controller)
        r = simulate(loop, Scenario(disturbance=0.0, t=found.t))
        d = simulate(loop, Scenario(setpoint=0.0, disturbance_time=0.0, t=found.t))
        judged, metrics = margins(loop), performance(loop)
        pairs = [
            (found.y_setpoint[i], r.y),
            (found.u_setpoint[i], r.u),
            (found.y_disturbance[i], d.y),
            (found.u_disturbance[i], d.u),
            *(
                (getattr(found, name)[i], getattr(judged, name))
                for name in ("Ms", "Mt", "GM", "PM_deg", "delay_margin")
            ),
            (found.IAE_setpoint[i], metrics.setpoint.IAE),
            (found.IAE_disturbance[i], metrics.disturbance.IAE),
            (found.TV_setpoint[i], metrics.setpoint.TV),
            (found.TV_disturbance[i], metrics.disturbance.TV),
        ]
        for ours, single in pairs:
            if np.all(np.isfinite(single)):
                worst = max(worst, float(np.max(np.abs(ours - single)) / np.max(np.abs(single))))
    return worst


def cost(plant: Plant, model) -> list[float]:
    """Seconds per tuning for each of COUNTS."""
    t, omega = np.linspace(0, 40 * model.theta, POINTS), np.geomspace(0.01, 30, FREQUENCIES) / model.theta
    jobs = {str(n): lambda n=n: sweep(plant, model, np.geomspace(0.3, 30, n) * model.theta, t, omega) for n in COUNTS}
    return [seconds / int(n) for n, seconds in median_times(jobs).items()]


if __name__ == "__main__":
    main()
