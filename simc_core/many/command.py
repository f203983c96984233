"""`simc many loops.csv -o out/`: a list of loops in, results.csv and report.html out.

A run that was stopped goes on where it was. Rows that were changed since, or are asked for otherwise, are done again.
"""

import argparse
import os
import sys
import time
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from simc_core import checks
from simc_core.errors import SimcError
from simc_core.many.processes import Processes
from simc_core.many.read_list import meanings, read_list, template
from simc_core.many.report import report, summary
from simc_core.many.results_csv import ResultsFile
from simc_core.many.run import TuneChunk, tune_many
from simc_core.many.tune_rows import tune_chunk
from simc_core.many.variants import SPREAD, TuneWithVariants

FEW = 300  # rows below which processes of one's own are not worth their start
MOST_JOBS = 1000  # more than there are cores are not taken
EVERY = 0.5  # seconds between two lines of progress


def add_to(commands: argparse._SubParsersAction) -> None:
    """The command's own options."""
    parser = commands.add_parser(
        "many",
        help="tune a list of loops",
        description="Tune a list of loops. Columns that are understood:\n\n" + meanings(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("list", nargs="?", help="CSV, or a spreadsheet")
    parser.add_argument("-o", "--out", default="out", help="folder for results.csv and report.html (out)")
    parser.add_argument("-j", "--jobs", type=int, default=0, help="processes; 0: one a core for long lists")
    parser.add_argument("--variants", type=int, default=0, help="plants with other k, theta, tau1 to try each loop on")
    parser.add_argument("--spread", type=float, default=SPREAD, help=f"of the variants, either way ({SPREAD:g})")
    parser.add_argument("--seed", type=int, default=1, help="of the variants (1)")
    parser.add_argument("--template", action="store_true", help="print a list to begin with")
    parser.set_defaults(run=run)


def run(given: argparse.Namespace) -> int:
    """The command. Returns its exit status."""
    if given.template:
        print(template(), end="")
        return 0
    if not given.list:
        print("simc many needs a list of loops; simc many --template prints one to begin with", file=sys.stderr)
        return 2
    try:
        return _run(given)
    except (SimcError, OSError) as error:
        print(f"simc many: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("\nStopped. Run it again to go on.", file=sys.stderr)
        return 130


def _run(given: argparse.Namespace) -> int:
    loops = read_list(given.list)
    understood = ", ".join(f"{heading} → {name}" for heading, name in loops.columns.items() if name)
    left_out = ", ".join(heading for heading, name in loops.columns.items() if not name)
    print(f"{len(loops.rows)} loops. Columns: {understood}" + (f"; not used: {left_out}" if left_out else ""))
    for note in loops.notes:
        print(note)
    out = Path(given.out)
    out.mkdir(parents=True, exist_ok=True)
    tune: TuneChunk = TuneWithVariants(given.variants, given.seed, given.spread) if given.variants else tune_chunk
    jobs = checks.whole("jobs", given.jobs, 0, MOST_JOBS)
    with ResultsFile(out / "results.csv", loops.rows, repr(tune) if given.variants else "") as file:
        if len(file.left) < len(loops.rows):
            print(f"{len(loops.rows) - len(file.left)} are in {file.path} already")
        if file.changed:
            print(f"{file.changed} have changed since and are done again")
        _tuned(file.left, _jobs(jobs, len(file.left)), tune, file)
        lines = list(file.read())
    (out / "report.html").write_text(report(lines, f"Many loops: {Path(given.list).name}"), encoding="utf-8")
    print(summary(lines))
    print(f"{file.path} and {out / 'report.html'}")
    return 0


def _jobs(asked: int, rows: int) -> int:
    """Processes beside this one."""
    if asked:
        return min(asked, os.cpu_count() or 1) if asked > 1 else 0
    return (os.cpu_count() or 1) if rows > FEW else 0


def _tuned(rows: Sequence[Mapping[str, Any]], jobs: int, tune: TuneChunk, file: ResultsFile) -> None:
    """All rows, each written as soon as it is there."""
    with ExitStack() as stack:
        pool = stack.enter_context(Processes(jobs)) if jobs else None
        begun, told = time.monotonic(), 0.0
        for done, result in enumerate(tune_many(rows, pool, tune=tune), 1):
            file.write(result)
            now = time.monotonic() - begun
            if done == len(rows) or now - told >= EVERY:
                told = now
                print(
                    f"\r{done} of {len(rows)}, {done / max(now, 1e-3):.0f} loops/s ",
                    end="",
                    file=sys.stderr,
                    flush=True,
                )
        print(file=sys.stderr)
