"""`python -m benchmarks.bounds`: what one call or one page takes at most, for plants that were made to hurt.

Each in a process of its own, after the same for a usual plant: MB of memory and seconds of the processor beyond that.
The named plants are those that once took gigabytes; the random ones have times over six decades, light damping and
unstable poles. Bounded: 60 processes, two at a time, some three minutes on two quiet cores.
"""

import math
import random
import resource
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from streamlit.testing.v1 import AppTest

from simc_core import Loop, SimcError, half_rule, parse_plant, performance, simc, simulate, sweep
from tests.pages.tools import ROOT

MOST_MB, MOST_S = 300.0, 2.0
USUAL = "2exp(-3s)/((10s+1)(4s+1))", "3exp(-2s)/((12s+1)(5s+1))"  # the first one loads everything
INNER = "exp(-0.5s)/(2s+1)"
NAMED = (
    "(10s+1)exp(-100s)/((0.001s+1)(20s+1))",
    "(10s+1)exp(-1000s)/((0.001s+1)(20s+1))",
    "exp(-s)/(1e4s^2+1e-4s+1)",
    "+".join(f"1/(s+{i})" for i in range(1, 38)),
)
RANDOM, SEED = 8, 11
AT_A_TIME = 2
PATIENCE = 300  # s, for one of the processes
TUNINGS = 300


def swept(text: str) -> None:
    """300 tunings over three decades of tau_c."""
    plant = parse_plant(text)
    model = half_rule(plant, 2).model
    unit = model.theta or 1.0
    t, omega = np.linspace(0.0, 20 * unit, 301), np.geomspace(1e-3, 1e3, 300) / unit
    sweep(plant, model, unit * np.geomspace(0.1, 100, TUNINGS), t, omega)


def measured(text: str) -> None:
    """One response and its measures."""
    plant = parse_plant(text)
    loop = Loop(plant, simc(half_rule(plant, 2).model))
    try:
        simulate(loop)
    finally:
        performance(loop)


def tuned(text: str) -> None:
    """The tuning page."""
    _page("tuning", plant=text, order="2")


def changed(text: str) -> None:
    """Its view of 33 changed plants."""
    _page("tuning", "Model error", plant=text, order="2")


def cascaded(text: str) -> None:
    """The cascade page, with a usual block inside."""
    _page("cascade", Ga=text, Gb=INNER)


KINDS: dict[str, Callable[[str], None]] = {
    "sweep": swept,
    "measures": measured,
    "tuning page": tuned,
    "model error": changed,
    "cascade page": cascaded,
}


def random_plant(seed: int) -> str:
    """As text; times over six decades."""
    draw = random.Random(f"{SEED} {seed}")

    def some(most: int) -> list[float]:
        return [10 ** draw.uniform(-3, 3) for _ in range(draw.randint(0, most))]

    below = [f"({tau:.4g}s+1)" for tau in some(4)]
    below += [f"({tau * tau:.4g}s^2+{2 * tau * 10 ** draw.uniform(-4, 0):.4g}s+1)" for tau in some(1)]
    below += ["s"] * draw.choice((0, 0, 0, 1)) + ["(-500s+1)"] * draw.choice((0, 0, 0, 0, 1))
    below = below or ["(s+1)"]
    above = [f"({draw.choice((1, 1, -1)) * tau:.4g}s+1)" for tau in some(len(below) - 1)]
    delay = f"exp(-{10 ** draw.uniform(-3, 3):.4g}s)" if draw.random() < 0.9 else "1"
    return f"{''.join(above)}{delay}/({''.join(below)})" if above else f"{delay}/({''.join(below)})"


def beyond_usual(kind: str, text: str) -> tuple[float, float, str]:
    """MB and s beyond a usual plant, and how it ended."""
    seconds, peaks, end = [], [], ""
    for each in (*USUAL, text):
        begin = time.process_time()
        try:
            KINDS[kind](each)
            end = "answered"
        except SimcError as error:
            end = f"refused: {error}"
        seconds.append(time.process_time() - begin)
        peaks.append(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
    return peaks[-1] - peaks[-2], seconds[-1] - seconds[-2], end


def apart(kind: str, text: str) -> tuple[float, float, str]:
    """The same in a process of its own."""
    command = [sys.executable, "-m", "benchmarks.bounds", kind, text]
    try:
        found = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False, timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        return math.nan, math.nan, f"not within {PATIENCE} s"
    try:
        megabytes, s, end = found.stdout.strip().splitlines()[-1].split(" ", 2)
        return float(megabytes), float(s), end
    except (IndexError, ValueError):
        return math.nan, math.nan, f"failed: {found.stderr.strip().splitlines()[-1:]}"


def main() -> None:
    """Print the table: largest of all random plants in one row, and what is beyond the bounds."""
    texts = {text: text if len(text) < 50 else f"{text[:25]}..." for text in NAMED}
    texts |= {random_plant(i): f"random {i}" for i in range(RANDOM)}
    print(f"| plant | {' | '.join(f'{kind}, MB | s' for kind in KINDS)} |")
    print(f"|---|{'---|---|' * len(KINDS)}")
    beyond = []
    with ThreadPoolExecutor(AT_A_TIME) as pool:
        made = {(text, kind): pool.submit(apart, kind, text) for text in texts for kind in KINDS}
        for text, name in texts.items():
            row = []
            for kind in KINDS:
                megabytes, s, end = made[text, kind].result()
                row.append(f"{max(megabytes, 0):.0f} | {max(s, 0):.2f}")
                if not (megabytes <= MOST_MB and s <= MOST_S):
                    beyond.append(f"{kind} {text}: {megabytes:.0f} MB, {s:.2f} s, {end}")
            print(f"| {name} | {' | '.join(row)} |", flush=True)
    print("\n".join(beyond) or f"all within {MOST_MB:.0f} MB and {MOST_S:g} s of a usual plant")


def _page(name: str, view: str = "Live", **parameters: str) -> None:
    app = AppTest.from_file(str(ROOT / "pages" / f"{name}.py"), default_timeout=120)
    app.session_state["views"] = view
    app.query_params.update(parameters)
    app.run()
    if app.exception:
        raise RuntimeError(app.exception[0].value)


if __name__ == "__main__":
    if len(sys.argv) == 3:
        print(*beyond_usual(*sys.argv[1:]))
    else:
        main()
