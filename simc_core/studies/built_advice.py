"""Guards for the loop as it is built: steps that the actuator cannot answer, sampling that the tuning does not know."""

import math

import numpy as np

from simc_core.notation import number
from simc_core.plants.plant import Plant
from simc_core.simulation.scenario import Scenario
from simc_core.studies.advice import Advice
from simc_core.studies.tuned import Tuned
from simc_core.wording import Text, joined, said

INSIDE = 1 - 1e-9  # a step proposed ends just within the limit
SMALL = 0.05  # of tau_c + theta: half a sampling period below it changes little


def out_of_reach(plant: Plant, scenario: Scenario, u: str = "u", now: float = 0.0) -> tuple[Advice, ...]:
    """Steps of r and d that need a constant u beyond the limits: y never comes to its set point.

    At rest y = k (u + d), so u = r/k before the load step and r/k - d after it; k is infinite with an integrator.
    The change is one of the heights, "r" or "d".   u, now: what the input is called, and where it is at rest, in words.
    """
    low, high = scenario.actuation.u_min, scenario.actuation.u_max
    per_r = 0.0 if plant.integrators else 1 / plant.k
    before = per_r * scenario.setpoint
    found = []
    if not low <= before <= high:
        limit = high if before > high else low
        change = {"r": INSIDE * limit / per_r}
        needed, allowed = number(before + now, 3), number(limit + now, 3)
        text = said(
            "r = {r} needs {u} = {needed}, the limit is {allowed}: it is never reached.",
            r=number(scenario.setpoint, 3),
            u=u,
            needed=needed,
            allowed=allowed,
        )
        remedy = said("Ask for {r} at most, or allow more {u}.", r=number(change["r"], 3), u=u)
        found.append(Advice("warning", "r", text, scenario.setpoint, change["r"], limit * per_r < 0, remedy, change))
        before = INSIDE * limit
    after = before - scenario.disturbance
    if not low <= after <= high:
        limit = high if after > high else low
        change = {"d": before - INSIDE * limit}
        needed, allowed = number(after + now, 3), number(limit + now, 3)
        text = said(
            "With the load, {u} = {needed} is needed, the limit is {allowed}: the error stays.",
            u=u,
            needed=needed,
            allowed=allowed,
        )
        remedy = said("Expect a load of {d} at most, or allow more {u}.", d=number(change["d"], 3), u=u)
        below = change["d"] < 0
        found.append(Advice("warning", "d", text, scenario.disturbance, change["d"], below, remedy, change))
    return tuple(found)


def sampling_not_in_tuning(of: Tuned, h: float) -> Advice | None:
    """A controller sampled every h whose tuning allows for another period; the change is that of the tuning."""
    known = of.choices["h"]
    more = (h - known) / 2
    if not more > SMALL * (of.tau_c + of.model.theta):
        return None
    missing = number(more, 3)
    text = [
        said("The tuning does not allow for it: {missing} of dead time is missing in theta and in Ms.", missing=missing)
    ]
    if known:
        text = [
            said(
                "The tuning allows for {h}: {missing} of dead time is missing in theta and in Ms.",
                h=number(known),
                missing=missing,
            )
        ]
    if of.margins.stable and more >= of.margins.delay_margin:
        text.append(said("The loop bears {delay} more.", delay=number(of.margins.delay_margin, 3)))
    remedy = said("Let the half rule allow for it; with tau_c = theta the loop becomes slower.")
    return Advice("warning", said("Sampling period"), joined(text, " "), h, remedy=remedy, change={"h": h})


def error_integral(t: np.ndarray, r: np.ndarray, y: np.ndarray) -> float:
    """Integral of |r - y| over the time shown, by trapezoids."""
    return float(np.trapezoid(np.abs(r - y), t))


def protections_compared(integrals: dict[str, float]) -> Text:
    """IAE of each way to guard against windup, and which is best here, in words."""
    each = joined(said("{name} {value}", name=name, value=number(value, 3)) for name, value in integrals.items())
    best = min(integrals, key=lambda name: integrals[name])
    equal = all(math.isclose(value, integrals[best], rel_tol=0.01) for value in integrals.values())
    if equal:
        return said("IAE over the time shown: {each}; they differ by less than 1 %.", each=each)
    return said("IAE over the time shown: {each}; best here: {best}.", each=each, best=best)
