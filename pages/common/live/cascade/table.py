"""What the instrument of the cascade page is sent: its setting, exact numbers, a table for each slider. No streamlit.

setup   sliders, instants, frequencies, and Ga and Gb at these: with the settings of both controllers the browser
        has La and Lb, and their margins, without reading them between rows
exact   one design
table   over the speed of one loop, the other one held
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from pages.common.live.cascade.rows import PARAMETERS, Grid, Section, TooSlow, course, sections
from pages.common.live.kit.held import kept_end
from pages.common.live.kit.instants import instants
from pages.common.live.kit.judgement import axis_labels, judgement
from pages.common.live.kit.naming import name_of
from pages.common.live.kit.packing import figures, pack
from pages.common.parts.settings_text import ACTION, UNITS, sizes
from pages.common.session.cascade import Cascade
from pages.common.session.sheet import Sheet
from pages.common.studies.cascade import CascadeStudy, designed, scale
from pages.common.words import translated
from simc_core.cascade.design import CascadeDesign
from simc_core.controllers.forms import Controller, ParallelPid
from simc_core.errors import SimcError
from simc_core.loops.frequency_grid import omega_grid
from simc_core.plants.plant import Plant
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.simulation.simulate_nested import horizon
from simc_core.wording import said

LOOPS = ("inner", "outer")
SHORTEST, LONGEST = 0.2, 10.0  # on a slider, of tight tau_c, or of the dead time in the loop
POINTS = 120  # after each step, closer together at first
CURVES = ("y1", "y2", "u")
METRICS = ("IAE_setpoint", "IAE_d1", "IAE_d2")
SHOWN = ("Ms_outer", "Ms_inner", "GM", "PM_deg", "delay_margin", *METRICS)
SYMBOLS = {"simc": "τ<sub>c</sub>", "synthesis": "λ"}
BESIDE = {"inner": said("{symbol} inner", symbol=""), "outer": said("{symbol} outer", symbol="")}
NAMES = {
    ("simc", "inner"): said("Closed-loop time constant tau_c of the inner loop"),
    ("simc", "outer"): said("Closed-loop time constant tau_c of the outer loop"),
    ("synthesis", "inner"): said("Time constant lambda of the inner loop"),
    ("synthesis", "outer"): said("Time constant lambda of the outer loop"),
}


@dataclass(frozen=True, slots=True)
class Subject:
    """What is designed, with the speeds of both loops; follows: the outer one is what the inner one makes it."""

    held: Cascade
    inner: float
    outer: float
    follows: bool

    @property
    def rest(self) -> Cascade:
        """What is the same wherever the sliders stand."""
        return replace(self.held, tau_c_inner=None, tau_c_outer=None)

    def other(self, loop: str) -> float | None:
        """The speed that stays while `loop` moves, None where it follows."""
        return self.inner if loop == "outer" else None if self.follows else self.outer


def subject_of(study: CascadeStudy) -> Subject:
    """The cascade with its speeds in place of what they were found by."""
    each, (inner, outer) = study.cascade, study.speeds
    follows = each.method == "simc" and each.tau_c_outer is None and each.Ms_outer is None
    fixed = {"tau_c_inner": inner, "tau_c_outer": None if follows else outer, "Ms_inner": None, "Ms_outer": None}
    return Subject(replace(each, **fixed), inner, outer, follows)


def grid_of(study: CascadeStudy, shown: float | None = None) -> Grid:
    """Instants. shown: the end of what is on the screen, kept as long as the present design suits it, sound or not."""
    wanted = 3 * horizon(study.loop.outer_loop)
    end = shown if shown and not study.sound else kept_end(wanted, shown)
    part = end / 3
    starts = [0.0, part, 2 * part]
    thetas = study.loop.primary.theta, study.loop.secondary.theta
    delays = [i * thetas[0] + j * thetas[1] for i in range(3) for j in range(4)]
    breaks = [start + delay for start in starts for delay in delays]
    even = [start + part * np.linspace(0.0, 1.0, POINTS, endpoint=False) ** 2 for start in starts]
    return Grid(instants(np.concatenate(even), breaks, end), *starts[1:])


def bounds(rest: Cascade) -> dict[str, tuple[float, float]]:
    """Lowest and highest speed on each slider."""
    if rest.method == "simc":
        tight = designed(replace(rest, Ms_inner=None, Ms_outer=None))
        units = tight.tau_c_inner, tight.tau_c_outer
    else:
        delays = rest.secondary.theta, rest.primary.theta + rest.secondary.theta
        units = [delay or scale(rest, loop) / 10 for delay, loop in zip(delays, LOOPS, strict=True)]
    return {loop: (SHORTEST * unit, LONGEST * unit) for loop, unit in zip(LOOPS, units, strict=True)}


def setup_name(subject: Subject, grid: Grid) -> str:
    """Of what tables and exact numbers share."""
    return name_of(subject.rest, float(grid.t[-1]))


def table_name(subject: Subject, grid: Grid, loop: str) -> str:
    """Of the table for the slider of `loop`."""
    return name_of(setup_name(subject, grid), loop, subject.other(loop))


def setup(subject: Subject, grid: Grid) -> bytes:
    """What stays while the sliders move."""
    limits, omega = bounds(subject.rest), _omega(subject.rest)
    method = subject.rest.method
    sliders = {
        loop: {
            "low": low,
            "high": high,
            "symbol": translated(BESIDE[loop].put(symbol=SYMBOLS[method])),
            "label": translated(NAMES[method, loop]),
        }
        for loop, (low, high) in limits.items()
    }
    header = {
        "kind": "setup",
        "id": setup_name(subject, grid),
        "sliders": sliders,
        "t": grid.t.tolist(),
        "starts": [grid.d1, grid.d2],
        "omega": omega.tolist(),
        "measures": {name: what for name, what in UNITS.items() if what == "time"},  # gains have others in each loop
        **judgement(SHOWN),
    }
    return pack(header, _parts("Ga", subject.rest.primary, omega) | _parts("Gb", subject.rest.secondary, omega))


def exact(subject: Subject, grid: Grid, study: CascadeStudy, answers: int, sheet: Sheet) -> bytes:
    """The present design without interpolation; answers: the release it answers.

    Without curves where it is not stable and too wild to be computed.
    """
    header = {
        "kind": "exact",
        "to": "cascade",
        "setup": setup_name(subject, grid),
        "inner": subject.inner,
        "outer": subject.outer,
        "follows": subject.follows,
        "answers": answers,
        "labels": axis_labels(sheet),
        "sound": study.sound,
        "inner_stable": study.stability.inner.verdict == "stable",
        "settings": {loop: _shown(getattr(study.design, loop)) for loop in LOOPS},
        "actions": {loop: translated(ACTION[getattr(study.design, loop).action]) for loop in LOOPS},
        "metrics": figures(_judged(study)),
    }
    blocks = {"parameters": _parameters(study.design)}
    try:
        blocks |= dict(zip(CURVES, course(study.loop, grid), strict=True))
    except SimcError:
        if study.sound:
            raise
    return pack(header, blocks)


def table(subject: Subject, grid: Grid, loop: str, pause: Callable[[], None]) -> bytes:
    """The table for the slider of `loop`, b"" where it would take too long.

    pause: called between rows, where a newer wish may end the work.
    """
    try:
        found, unsound, inner_stable = sections(subject.held, loop, *bounds(subject.rest)[loop], grid, pause)
    except TooSlow:
        return b""
    rows = [row for each in found for row in each.rows]
    x, breaks = _joined(found)
    header = {
        "kind": "table",
        "to": "cascade",
        "setup": setup_name(subject, grid),
        "loop": loop,
        "held": subject.other(loop),
        "log_tau_c": x,
        "breaks": breaks,
        "unstable": unsound,
        "inner_stable": inner_stable,
        "settings": {name: list(_shown(getattr(rows[0].design, name))) for name in LOOPS} if rows else {},
        "metrics": METRICS,
    }
    if not rows:
        return pack(header, {})
    blocks = {name: np.array([row.curves[i] for row in rows]) for i, name in enumerate(CURVES)}
    blocks["metrics"] = np.array([row.IAE for row in rows])
    blocks["outer_speed"] = np.array([[row.design.tau_c_outer or row.design.lambda_outer] for row in rows])
    blocks["parameters"] = np.array([_parameters(row.design) for row in rows])
    for name in LOOPS:
        blocks[f"settings_{name}"] = np.array([list(_shown(getattr(row.design, name)).values()) for row in rows])
    return pack(header, blocks)


def _joined(found: list[Section]) -> tuple[list[float], list[int]]:
    """Rows of all sections one after the other; nothing is read between two sections."""
    x, breaks = [], []
    for each in found:
        breaks += [len(x) + at for at in each.nodes.breaks]
        x += each.nodes.x.tolist()
    return x, breaks


def _omega(rest: Cascade) -> np.ndarray:
    """Frequencies that do not change with the sliders, for both loops."""
    blocks = rest.primary.factored, rest.secondary.factored
    return omega_grid([*blocks, blocks[0] * blocks[1]])


def _parts(name: str, block: Plant, omega: np.ndarray) -> dict[str, np.ndarray]:
    G = block.factored(1j * omega)
    return {f"{name}_re": G.real, f"{name}_im": G.imag}


def _parameters(design: CascadeDesign) -> np.ndarray:
    """Kp, Ki, Kd, tau_F of the inner controller, then of the outer one."""
    forms = design.inner.to_parallel(), design.outer.to_parallel()
    return np.array([getattr(form, name) for form in forms for name in PARAMETERS])


def _shown(controller: Controller) -> dict[str, float]:
    """As its method writes it: series settings of SIMC, gains of the direct synthesis."""
    return sizes(controller.in_form("parallel" if isinstance(controller, ParallelPid) else "series"))


def _judged(study: CascadeStudy) -> dict[str, float]:
    outer: Margins = study.outer
    found = {"Ms_outer": outer.Ms, "Ms_inner": study.inner.Ms if study.sound else math.nan}
    found |= {"GM": outer.GM, "PM_deg": outer.PM_deg, "delay_margin": outer.delay_margin}
    each = study.performance
    steps = (each.setpoint, each.disturbance, each.disturbance2) if each else ()
    return found | dict.fromkeys(METRICS, math.nan) | {n: s.IAE for n, s in zip(METRICS, steps, strict=False)}
