"""The engine that draws in the browser while a knob moves, against the exact one: curves, margins, stable or not."""

import json
import math
import subprocess
from pathlib import Path

import numpy as np
import pytest

from simc_core import (
    IController,
    Loop,
    Plant,
    Scenario,
    SeriesPid,
    SimcError,
    margins,
    performance,
    simulate,
    stability,
)
from simc_core.simulation.horizon import settling_horizon
from tests.oracles.random_loops import resonant_loop, simulated_loop, third_unstable_loop

SCRIPT = Path(__file__).with_name("engine_cases.mjs")
OF_PLANT = ("k", "theta", "lags", "leads", "integrators", "lag_pairs", "lead_pairs")
OF_CONTROLLER = ("Kp", "Ki", "Kd", "tau_F", "b", "c")
MARGINS = ("Ms", "Mt", "GM", "GM_lower", "PM_deg", "delay_margin")
WITHIN = 2e-3  # of the range of a curve
LOOPS = 200
BY_HAND = [
    Loop(Plant(1, 0, (5,)), SeriesPid(2, 5)),  # no dead time
    Loop(Plant(1, 1), IController(0.5)),  # nothing but dead time
    Loop(Plant(1, 1e-5, (1, 0.1)), SeriesPid(3, 1)),  # dead time far below the horizon
    Loop(Plant(-0.5, 2, integrators=1), SeriesPid(-0.5, 16)),
    Loop(Plant(1, 1, (10,)), SeriesPid(5, 8, 0.1)),  # neutral: D without filter on a first-order plant
    Loop(Plant(1, 2, (), (), 0, ((5, 0.01),)), IController(0.02)),
    Loop(Plant(-1, 0.5, (-4,)), SeriesPid(-4, 8)),
    Loop(Plant(1, 1, integrators=2), SeriesPid(0.0625, 8, 8, 0.08)),
]


@pytest.fixture(scope="module")
def drawn():
    """Random loops, those chosen by hand, and what the browser's engine makes of them."""
    rng, loops = np.random.default_rng(20), list(BY_HAND)
    makers = (resonant_loop, third_unstable_loop, simulated_loop)
    while len(loops) < LOOPS:
        loop = makers[len(loops) % 3](rng)
        try:
            if stability(loop).verdict != "marginal":
                loops.append(loop)
        except SimcError:
            continue
    cases = []
    for i, loop in enumerate(loops):
        end = 2 * settling_horizon(loop)
        ramps = (0.3 * end, 0.1 * end) if i % 3 == 0 else (0.0, 0.0)
        steps = {"r": 1.0, "d": -2.0 if i % 3 == 0 else 1.0, "load": end / 2, "r_ramp": ramps[0], "d_ramp": ramps[1]}
        plant = {name: getattr(loop.plant, name) for name in OF_PLANT}
        controller = {name: getattr(loop.controller.to_parallel(), name) for name in OF_CONTROLLER}
        cases.append({"plant": plant, "controller": controller, "end": end, "steps": steps})
    run = subprocess.run(
        ["node", SCRIPT], input=json.dumps(cases), capture_output=True, text=True, check=True, timeout=60
    )
    return list(zip(loops, cases, json.loads(run.stdout), strict=True))


def asked(case: dict, t: np.ndarray) -> Scenario:
    steps = case["steps"]
    ramps = {"setpoint_ramp": steps["r_ramp"], "disturbance_ramp": steps["d_ramp"]}
    return Scenario(steps["r"], steps["d"], steps["load"], case["end"], t=t, **ramps)


def test_curves_of_stable_loops_are_right_at_every_point_that_is_drawn(drawn):
    checked = 0
    for loop, case, picture in drawn:
        if not picture["stable"]:
            continue
        t, load = np.array(picture["t"]), case["steps"]["load"]
        single = np.diff(t) > 0  # where there are two limits both may be drawn
        keep = np.r_[True, single] & np.r_[single, True] & (np.abs(t - load) > 1e-12 * load)
        exact = simulate(loop, asked(case, t[keep]))
        for name in ("y", "u"):
            ours, theirs = np.array(picture[name])[keep], getattr(exact, name)
            assert np.max(np.abs(ours - theirs)) <= WITHIN * np.ptp(theirs), (name, loop)
        checked += 1
    assert checked > LOOPS / 2


def test_unstable_loops_are_drawn_right_as_long_as_they_stay_on_the_screen(drawn):
    for loop, case, picture in drawn:
        if picture["stable"] or stability(loop).unstable_poles == math.inf:  # countless poles: no grid shows them all
            continue
        t, y = np.array(picture["t"]), np.array(picture["y"])
        off = np.flatnonzero(np.abs(y) > 20)
        end = off[0] if len(off) else len(t)
        load = case["steps"]["load"]
        keep = np.r_[True, np.diff(t) > 0][:end] & (np.abs(t[:end] - load) > 1e-12 * load)
        keep &= np.r_[np.diff(t) > 0, True][:end]
        exact = simulate(loop, asked(case, t[:end][keep]))
        assert np.max(np.abs(y[:end][keep] - exact.y), initial=0.0) <= WITHIN * 40, loop


def test_stable_or_not_is_never_mistaken(drawn):
    assert [picture["stable"] for *_, picture in drawn] == [stability(loop).verdict == "stable" for loop, *_ in drawn]


def test_margins_and_peaks_are_exact(drawn):
    for loop, _, picture in drawn:
        if picture["stable"]:
            judged = margins(loop)
            for name in MARGINS:
                ours = float(picture["figures"][name])
                # where |L| < 1e-4 is not looked at, |S| differs from 1 by no more
                allowed = 1e-4 if name in ("Ms", "Mt") and judged.Ms < 1.001 else 1e-9
                assert ours == pytest.approx(getattr(judged, name), rel=1e-7, abs=allowed), (name, loop)


def test_integrals_are_good_to_the_two_digits_that_are_shown(drawn):
    off = []
    for loop, _, picture in drawn:
        if picture["stable"] and margins(loop).Ms < 2:
            try:
                judged = performance(loop)
            except SimcError:
                continue
            pairs = (("IAE_setpoint", judged.setpoint.IAE), ("IAE_disturbance", judged.disturbance.IAE))
            for name, exact in pairs:
                ours = picture["figures"][name]
                if ours is not None and exact:
                    off.append(abs(ours / exact - 1))
            assert picture["figures"]["overshoot"] == pytest.approx(judged.setpoint.overshoot, abs=2e-3)
    assert len(off) > 50
    assert not [error for error in off if not error < 0.02 and not math.isnan(error)]
