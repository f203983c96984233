"""What the benchmarks share: the peer, interleaved medians on one core, where results go."""

import json
import os
import time
from collections.abc import Callable
from pathlib import Path

import control
import numpy as np

from simc_core import Loop
from simc_core.certificate.verdict import remembered, remembered_nested
from simc_core.interop import closed_loop, to_tf
from simc_core.loops.loop import factored_plant, transfer_function
from simc_core.sensitivity.nested_response import closed
from simc_core.simulation.one_delay.element_sizes import levels
from simc_core.simulation.one_delay.process_maps import chain_of
from simc_core.simulation.several_delays.stepper import steps_of
from simc_core.simulation.simulate import settled

ROUNDS = 9
OF_LOOPS = (settled, transfer_function, remembered, steps_of, remembered_nested, closed)
OF_PLANTS = (factored_plant, chain_of, levels)
POINTS, FREQUENCIES = 600, 400


def peer(loop: Loop, order: int, t: np.ndarray, omega: np.ndarray) -> np.ndarray:
    """A full recompute by python-control with Pade(order); y of the set-point step comes back.

    Its best use: one MIMO state-space call for the responses, one for the frequencies.
    """
    system = closed_loop(loop, order)
    responses = control.step_response(system, t).outputs
    for source in range(2):
        y, u = responses[:, source]
        e = (1.0 - source) - y
        np.trapezoid(np.abs(e), t), np.trapezoid(e**2, t), np.trapezoid(t * np.abs(e), t), np.abs(np.diff(u)).sum()
    control.step_info(responses[0, 0], T=t)
    control.step_info(responses[0, 1], T=t, yfinal=0.0)
    L = to_tf(loop.plant, order) * to_tf(loop.controller)
    control.frequency_response(system, omega)
    S = 1 / (1 + control.frequency_response(L, omega).frdata[0, 0])
    np.max(np.abs(S)), np.max(np.abs(1 - S))  # Ms, Mt
    control.stability_margins(L)
    system.poles()
    return responses[0, 0]


def median_times(jobs: dict[str, Callable[[], object]], runs: int = 1) -> dict[str, float]:
    """Seconds of one run, interleaved: in each round every job `runs` times, as a slider that moves asks for it."""
    taken: dict[str, list[float]] = {name: [] for name in jobs}
    for _ in range(ROUNDS):
        for name, job in jobs.items():
            start = time.perf_counter()
            for _ in range(runs):
                job()
            taken[name].append((time.perf_counter() - start) / runs)
    return {name: float(np.median(values)) for name, values in taken.items()}


def forgotten(plants: bool = True) -> None:
    """Everything that is remembered between calls of loops, and of plants."""
    for function in (*OF_LOOPS, *(OF_PLANTS if plants else ())):
        function.cache_clear()


def pin() -> None:
    """This process on one core, where the system can do that."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})


def keep(name: str, rows: list[dict]) -> None:
    """Rows as results/NAME.json."""
    target = Path(__file__).parent / "results" / f"{name}.json"
    target.parent.mkdir(exist_ok=True)
    target.write_text(json.dumps(rows, indent=1))
