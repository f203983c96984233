"""`python -m benchmarks.beside`: a slider that is released while somebody else's list of loops is tuned.

The tuning page runs in this process, as in the server, and the list is worked on by the job of the page Many loops: a
process of its own, whose results are fetched here. On one core and on all; the job that gives way, as it is, and one
that does not. Releases in turn, in all cases; medians and 95 %, of wall time.
"""

import os
import statistics
import time
from itertools import cycle

from streamlit.testing.v1 import AppTest

from benchmarks.many import plant_list
from benchmarks.recompute import keep
from pages.common.many_loops import job
from tests.pages.tools import run_page

ROUNDS, RELEASES, LOOPS = 4, 12, 2000
PAUSE = 0.1  # seconds from a release to the next
CASES = {"no list": None, "a list": job.NICE, "a list that does not give way": 0}
TAU_C = cycle((3.0, 5.0, 7.0, 9.0, 6.0, 4.0))


def main() -> None:
    """Print the table and write the JSON."""
    every, rows = os.sched_getaffinity(0), []
    print("\n| ms of a released slider | median | 95 % | loops tuned a second |\n|---|---|---|---|")
    for cores in (every, {max(every)}):
        os.sched_setaffinity(0, cores)
        app = run_page("tuning", "Figures", plant="exp(-3s)/((6s+1)(4s+1)(2s+1))")
        times: dict[str, list[float]] = {case: [] for case in CASES}
        speeds: dict[str, list[float]] = {case: [] for case in CASES}
        for _ in range(ROUNDS):
            for case, nice in CASES.items():
                found, speed = beside(app, nice)
                times[case] += found
                speeds[case].append(speed)
        for case, found in times.items():
            row = {
                "cores": len(cores),
                "case": case,
                "median": statistics.median(found),
                "95": sorted(found)[int(0.95 * len(found))],
                "loops": statistics.median(speeds[case]),
            }
            rows.append(row)
            where = f"{row['cores']} core{'s' * (row['cores'] > 1)}"
            print(f"| {where}, {case} | {row['median']:.0f} | {row['95']:.0f} | {row['loops']:.0f} |")
    keep("beside", rows)


def beside(app: AppTest, nice: int | None) -> tuple[list[float], float]:
    """ms of some releases while a list is tuned, and the loops that were tuned in a second; nice: None for no list."""
    if nice is None:
        return [released(app) for _ in range(RELEASES)], 0.0
    usual, job.NICE = job.NICE, nice
    try:
        work = job.Job(plant_list(LOOPS), "list")
        while not work.results:
            time.sleep(0.05)
        begun, had = time.perf_counter(), len(work.results)
        found = []
        while work.going and len(found) < RELEASES:
            found.append(released(app))
        speed = (len(work.results) - had) / (time.perf_counter() - begun)
        work.stop()
        while work.going:
            time.sleep(0.05)
        return found, speed
    finally:
        job.NICE = usual


def released(app: AppTest) -> float:
    """ms of a run of the page after another tau_c."""
    time.sleep(PAUSE)
    begun = time.perf_counter()
    app.select_slider(key="tau_c_slider").set_value(next(TAU_C)).run()
    return 1e3 * (time.perf_counter() - begun)


if __name__ == "__main__":
    main()
