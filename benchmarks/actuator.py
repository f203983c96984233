"""`make bench`, fourth part: loops with actuator limits, which are stepped in time; milliseconds for 5000 steps.

y and u of a set-point and of a load step at 600 points; u is at its limit for a while after the set point. A step is a
part of the dead time, or all of it if that is below 1/5000 of the horizon (theta < step). Sampled: h is the step.
Noise: a new value in each step. One pinned core, interleaved, medians. A table, and results/actuator.json.
"""

from dataclasses import replace

from benchmarks.recompute import keep, median_times, pin
from simc_core import Actuation, Loop, Plant, Scenario, SeriesPid, simulate
from simc_core.simulation.actuator.actuation import FEWEST_STEPS, Inputs
from simc_core.simulation.actuator.continuous import actuated

LOOPS = {
    "order 1, PI": Loop(Plant(1, 1, (8,)), SeriesPid(4, 8)),
    "order 2, PID": Loop(Plant(1, 1, (8, 2)), SeriesPid(4, 8, 2, 0.1)),
    "order 4, PI": Loop(Plant(1, 1, (6, 3, 1, 0.5)), SeriesPid(1, 6)),
    "order 4, PID": Loop(Plant(1, 1, (6, 3, 1, 0.5)), SeriesPid(1.5, 6, 3, 0.3)),
}
LIMITED = Scenario(1.0, -0.5, 40.0, 80.0, actuation=Actuation(u_min=-0.2, u_max=1.3))
STEP = LIMITED.t_end / FEWEST_STEPS
SITUATIONS = {
    "theta > 0": (1.0, LIMITED),
    "theta = 0": (0.0, LIMITED),
    "theta < step": (0.6 * STEP, LIMITED),
    "sampled": (1.0, replace(LIMITED, actuation=replace(LIMITED.actuation, h=STEP))),
    "sampled, theta < step": (0.6 * STEP, replace(LIMITED, actuation=replace(LIMITED.actuation, h=STEP))),
    "noise": (1.0, replace(LIMITED, actuation=replace(LIMITED.actuation, noise=0.01))),
}


def steps(loop: Loop, scenario: Scenario) -> int:
    """How many a simulation takes."""
    inputs = Inputs(scenario.setpoint, scenario.disturbance, scenario.disturbance_time, scenario.t_end)
    return len(actuated(loop, scenario.actuation, inputs).y)


def main() -> None:
    """Print the table and write the JSON."""
    pin()
    rows = []
    print("\n| 5000 steps, ms | " + " | ".join(SITUATIONS) + " |\n|---|" + "---|" * len(SITUATIONS))
    for name, loop in LOOPS.items():
        runs = {
            case: (replace(loop, plant=replace(loop.plant, theta=theta)), scenario)
            for case, (theta, scenario) in SITUATIONS.items()
        }
        taken = median_times({case: lambda run=run: simulate(*run) for case, run in runs.items()})
        per_5000 = {case: 1e3 * taken[case] * FEWEST_STEPS / steps(*run) for case, run in runs.items()}
        rows.append({"case": name, "ms per 5000 steps": per_5000})
        print(f"| {name} | " + " | ".join(f"{each:.1f}" for each in per_5000.values()) + " |")
    keep("actuator", rows)


if __name__ == "__main__":
    main()
