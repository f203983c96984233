"""`python -m benchmarks.identification [FOLDER]`: identification beside curve_fit, on simulated tests of known truth.

curve_fit is what people do: a first-order model simulated sample by sample with the dead time rounded to samples, k,
tau1, theta and bias free, begun at the two-point model. Errors are medians and 90 % quantiles over tests with noise
0 to 10 %, drift, unsettled starts, outliers, coarse and irregular sampling; Ms is that of the true plant with the PI of
the model, tau_c = theta. FOLDER: trends as people have them, `.csv`, `.txt`, `.xlsx` and the like, for which is printed
how each was read, the models, and what is said of them; they stay where they are, and nothing else is measured.
"""

import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import numpy as np
from scipy.optimize import curve_fit

from benchmarks.recompute import keep, pin
from simc_core import (
    FirstOrderDelay,
    Identified,
    Loop,
    Plant,
    SimcError,
    Trend,
    by_hand,
    half_rule,
    identify,
    identify_all,
    margins,
    read_trend,
    robust_tau_c,
    simc,
)
from tests.identification.simulated import first_order, rise

KINDS = (".csv", ".txt", ".tsv", ".log", ".dat", ".xlsx", ".xls", ".xlsb", ".ods")
TESTS = 120
SIZES = (500, 2000, 10_000, 100_000)
STRUCTURES = ("FOPDT", "SOPDT", "IPDT", "IPDT_lag", "DIPDT", "inverse", "oscillating")


def main() -> None:
    """Print the tables and write the JSON."""
    pin()
    if len(sys.argv) > 1:
        trends(Path(sys.argv[1]))
        return
    rows = [*accuracy(), *speed()]
    keep("identification", rows)


def accuracy() -> list[dict]:
    """Errors and time of each method on the same tests."""
    methods = {
        "identify": fitted,
        "curve_fit": rounded,
        "two-point": ruler("two-point"),
        "tangent": ruler("tangent"),
        "areas": ruler("areas"),
    }
    rows = []
    print("\n| method | theta, % of theta + tau1 | k, % | tau1, % | Ms <= 2 | no model | ms |")
    print("|---" * 7 + "|")
    for name, method in methods.items():
        errors, peaks, missing, taken = [], [], 0, 0.0
        for seed in range(TESTS):
            trend, truth = first_order(seed)
            begun = time.process_time()
            model = method(trend)
            taken += time.process_time() - begun
            if model is None:
                missing += 1
                continue
            errors.append(
                (
                    abs(model.theta - truth.theta) / (truth.theta + truth.tau1),
                    abs(model.k / truth.k - 1),
                    abs(model.tau1 / truth.tau1 - 1),
                )
            )
            peaks.append(true_peak(model, truth))
        middle, wide = 100 * np.median(errors, axis=0), 100 * np.quantile(errors, 0.9, axis=0)
        sound = float(np.mean(np.array(peaks) <= 2))
        cells = " | ".join(f"{a:.2f} ({b:.1f})" for a, b in zip(middle, wide, strict=True))
        print(f"| {name} | {cells} | {100 * sound:.0f} % | {missing} | {1e3 * taken / TESTS:.0f} |")
        rows.append({"method": name, "median": middle.tolist(), "wide": wide.tolist(), "sound": sound})
    return rows


def speed() -> list[dict]:
    """CPU time of each structure, one step and its return, white noise."""
    rows = []
    print("\n| samples | " + " | ".join(f"{key}, ms" for key in STRUCTURES) + " |")
    print("|---" * (len(STRUCTURES) + 1) + "|")
    for n in SIZES:
        t = np.linspace(0, 200, n)
        y = 2 * (rise(t - 13.3, 12.0) - rise(t - 103.3, 12.0))
        y = y + 0.02 * np.random.default_rng(0).normal(size=n)
        trend = Trend(t, y, [0.0, 1.0, 0.0], t_u=[0.0, 10.0, 100.0])
        taken = []
        for key in STRUCTURES:
            begun = time.process_time()
            with suppress(SimcError):
                identify(trend, key)
            taken.append(time.process_time() - begun)
        print(f"| {n} | " + " | ".join(f"{1e3 * one:.0f}" for one in taken) + " |")
        rows.append({"samples": n, "seconds": dict(zip(STRUCTURES, taken, strict=True))})
    return rows


def trends(folder: Path) -> None:
    """What each file of a folder gives: how it was read, each structure with its 95 % intervals, what is said of it."""
    for path in sorted(folder.iterdir()):
        if path.suffix.lower() not in KINDS:
            continue
        print(f"\n## {path.name}")
        begun = time.process_time()
        try:
            trend = read_trend(path)
            print(f"   {'; '.join(note.rstrip('.') for note in trend.notes)}")
            ranked = identify_all(trend)
        except SimcError as error:
            print(f"   refused: {error}")
            continue
        for one in ranked:
            shown = ", ".join(
                f"{name} {value:.4g} ({low:.3g} to {high:.3g})" for name, value, low, high in _values(one)
            )
            print(f"   {one.structure}: {shown}; fit {100 * one.fit:.1f} %, behind {one.criterion:.1f}")
        for text in ranked[0].verdicts:
            print(f"   - {text}")
        with suppress(SimcError):
            half = half_rule(ranked[0].plant).model
            print(f"   by the half rule {half}")
            print(f"   tau_c for Ms <= 1.7 with 95 %: {robust_tau_c(ranked):.4g}")
        print(f"   {time.process_time() - begun:.2f} s of CPU")


def _values(one: Identified) -> Iterator[tuple[str, float, float, float]]:
    for name, value in one.parameters.items():
        yield (name, value, *one.intervals[name])


def fitted(trend: Trend) -> FirstOrderDelay | None:
    """Ours."""
    try:
        return identify(trend).model
    except SimcError:
        return None


def rounded(trend: Trend) -> FirstOrderDelay | None:
    """curve_fit with the dead time rounded to samples."""
    t = np.linspace(trend.t[0], trend.t[-1], trend.t.size)
    y = np.interp(t, trend.t, trend.y)
    u = trend.u[np.maximum(np.searchsorted(trend.instants_of_u, t, "right") - 1, 0)] - trend.u[0]
    h = t[1] - t[0]

    def response(_: np.ndarray, k: float, tau1: float, theta: float, bias: float) -> np.ndarray:
        late = max(round(theta / h), 0)
        shifted = np.concatenate([np.zeros(late), u])[: u.size]
        kept, x, out = np.exp(-h / max(tau1, 1e-9)), 0.0, np.empty(u.size)
        for i, value in enumerate(shifted.tolist()):
            out[i] = x
            x = kept * x + (1 - kept) * value
        return bias + k * out

    begin = ruler("two-point")(trend) or FirstOrderDelay(1.0, 0.1 * trend.span, 0.1 * trend.span)
    try:
        k, tau1, theta, _ = curve_fit(
            response, t, y, [begin.k, begin.tau1, begin.theta, y[0]], diff_step=0.05, method="trf", max_nfev=60
        )[0]
        return FirstOrderDelay(float(k), max(float(theta), 0.0), float(tau1))
    except (RuntimeError, SimcError):
        return None


def ruler(method: str):
    """One of the graphical methods."""

    def read(trend: Trend) -> FirstOrderDelay | None:
        try:
            return next((one.model for one in by_hand(trend) if one.method == method), None)
        except SimcError:
            return None

    return read


def true_peak(model: FirstOrderDelay, truth) -> float:
    """Ms of the true plant with the tight PI of the model; inf where there is none, or the loop is not stable."""
    try:
        found = margins(Loop(Plant(truth.k, truth.theta, (truth.tau1,)), simc(model)))
    except SimcError:
        return np.inf
    return found.Ms if found.stable else np.inf


if __name__ == "__main__":
    main()
