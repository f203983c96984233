"""What the instrument is sent: a table over tau_c, and the exact numbers of one design. Pure: no streamlit."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from pages.common.live.kit.held import kept_end
from pages.common.live.kit.instants import instants
from pages.common.live.kit.judgement import axis_labels, judgement
from pages.common.live.kit.naming import name_of
from pages.common.live.kit.packing import figures, pack
from pages.common.parts.settings_text import ACTION, UNITS, form_shown, sizes
from pages.common.session.excitation import Excitation
from pages.common.session.sheet import Sheet
from pages.common.session.tuning import Tuning
from pages.common.studies.single import Study
from pages.common.words import translated
from simc_core.algebra.factors import Factored
from simc_core.certificate.verdict import stability
from simc_core.controllers.forms import Controller
from simc_core.loops.frequency_grid import omega_grid
from simc_core.loops.loop import Loop
from simc_core.plants.models import Model, UnstableDelay
from simc_core.plants.plant import Plant
from simc_core.rules.simc import default_tau_c
from simc_core.rules.simc_family import presets_of, settings_of
from simc_core.simulation import simulate
from simc_core.simulation.horizon import times
from simc_core.studies.sweep import MARGINS, METRICS, Sweep, sweep, time_curves
from simc_core.studies.tau_table import Rows, first_rows, kinks, refined

SHORTEST, LONGEST = 0.1, 100.0  # of tau_c over theta, on the slider
POINTS = 300
JUMPS = 12  # instants k theta after each step at which curves may break
BISECTIONS = 30
CURVES = ("y", "u", "re", "im")
FIGURES = (
    "Ms",
    "Mt",
    "GM",
    "GM_lower",
    "PM_deg",
    "delay_margin",
    "IAE_setpoint",
    "IAE_disturbance",
    "TV_setpoint",
    "TV_disturbance",
    "overshoot",
    "noise_gain",
)
AT_REST = ("peak_disturbance", "settling_setpoint", "settling_disturbance")  # they jump: not read between rows
SHOWN = (
    "Ms",
    "GM",
    "PM_deg",
    "delay_margin",
    "IAE_setpoint",
    "IAE_disturbance",
    "peak_disturbance",
    "Mt",
    "TV_setpoint",
    "TV_disturbance",
    "overshoot",
    "settling_setpoint",
    "settling_disturbance",
    "noise_gain",
)


@dataclass(frozen=True, slots=True, eq=False)
class Grid:
    """The instants and frequencies everything is computed at, so that table, pins and exact curves share them.

    load: when the load begins.   excitation: heights and ramps.
    """

    t: np.ndarray
    load: float
    omega: np.ndarray
    excitation: Excitation

    @property
    def steps(self) -> dict[str, float]:
        """What r and d do, for the browser."""
        asked = self.excitation
        return {
            "r": asked.reached,
            "d": asked.disturbance,
            "load": self.load,
            "r_ramp": asked.ramp,
            "d_ramp": asked.disturbance_ramp,
        }

    @property
    def ramps(self) -> tuple[float, float]:
        """Of r and d."""
        return self.excitation.ramp, self.excitation.disturbance_ramp

    @property
    def heights(self) -> np.ndarray:
        """Of r and d."""
        return np.array([self.excitation.reached, self.excitation.disturbance])


@dataclass(frozen=True, slots=True)
class Subject:
    """What is tuned: everything but tau_c."""

    plant: Plant
    model: Model
    tuning: Tuning
    form: str

    def controller(self, tau_c: float) -> Controller:
        """The rule at tau_c, with set-point weight and filter."""
        return (
            settings_of(self.tuning.rule, self.model, tau_c).with_filter(self.tuning.filter).with_weight(self.tuning.b)
        )

    def loop(self, tau_c: float) -> Loop:
        """The loop round the full plant."""
        return Loop(self.plant, self.controller(tau_c))

    def swept(self, tau_c: np.ndarray, grid: "Grid") -> Sweep:
        """Everything at all tau_c."""
        b, ratio, rule = self.tuning.b, self.tuning.filter, self.tuning.rule
        return sweep(self.plant, self.model, tau_c, grid.t, grid.omega, b, ratio, grid.load, grid.ramps, rule)


def subject_of(plant: Plant, present: Study, form: str) -> Subject:
    """The subject of the study, in a form that its controller has."""
    shown = form_shown(present.controller, form)
    return Subject(plant, present.model, replace(present.tuning, tau_c=None, speed=""), shown)


def grid_of(subject: Subject, present: Study, excitation: Excitation, shown: float | None = None) -> Grid:
    """Instants and frequencies. shown: the horizon on the screen, kept as long as the present design suits it.

    The frequencies are those of one reference design, so that they do not change with tau_c.
    """
    return grid_around(present.loop, [subject.loop(bounds(subject)[2]).L], excitation, shown)


def grid_around(loop: Loop, curves: Sequence[Factored], excitation: Excitation, shown: float | None = None) -> Grid:
    """Instants that suit a loop and what is asked of it, and frequencies that suit these L."""
    begins, wanted = times(loop, excitation.scenario())
    end = kept_end(wanted, shown)
    load, theta = begins if excitation.load_time is not None else begins / wanted * end, loop.plant.theta
    starts = (0.0, load, excitation.ramp, load + excitation.disturbance_ramp)
    breaks = [start + k * theta for start in starts for k in range(JUMPS + 1)]
    t = instants(np.linspace(0.0, end, POINTS + 1), breaks, end)
    return Grid(t, load, omega_grid(curves), excitation)


def bounds(subject: Subject) -> tuple[float, float, float, str]:
    """low, high of tau_c on the slider, the length of 1 on its scale, and what that is called."""
    model = subject.model
    presets = presets_of(subject.tuning.rule, model)
    unit = default_tau_c(model)
    high = max(LONGEST * unit, *presets.values(), 0.0)
    return SHORTEST * unit, high, unit, "θ" if model.theta else ""


def table(subject: Subject, grid: Grid, pins: Sequence[tuple[str, Study]], name: str) -> bytes:
    """The table as bytes, under its name."""
    low, high, unit, symbol = bounds(subject)
    nodes, found = rows(subject, grid)
    names = list(found.controllers[0].in_form(subject.form).settings)
    header = {
        "kind": "table",
        "id": name,
        "log_tau_c": nodes.x.tolist(),
        "breaks": nodes.breaks,
        "t": grid.t.tolist(),
        "steps": grid.steps,
        "omega": grid.omega.tolist(),
        "settings": names,
        "measures": {name: UNITS[name] for name in names},
        "action": translated(ACTION[found.controllers[0].action]),
        "metrics": FIGURES,
        **judgement(SHOWN),
        "unit": unit,
        "symbol": symbol,
        "low": low,
        "high": high,
        "fixed": isinstance(subject.model, UnstableDelay),
        "unstable": unstable_ranges(
            nodes.tau_c, found.stable, lambda each: stability(subject.loop(each)).verdict == "stable"
        ),
        "presets": [
            (translated(name), tau_c) for name, tau_c in presets_of(subject.tuning.rule, subject.model).items()
        ],
        "pins": [{"name": translated(letter), "metrics": figures(judged(each, grid.omega))} for letter, each in pins],
    }
    blocks = curves(found, grid)
    for field in ("y", "u"):
        header[f"{field}_cap"] = cap(blocks[field][found.stable], 1.0)
    blocks["settings"] = np.array([list(sizes(each.in_form(subject.form)).values()) for each in found.controllers])
    blocks["metrics"] = metrics(subject, found)
    if pins:
        pinned = zip(*[responses(each.loop, grid) for _, each in pins], strict=True)
        blocks |= {f"pin_{field}": np.array(rows) for field, rows in zip(CURVES, pinned, strict=True)}
    return pack(header, blocks)


def rows(subject: Subject, grid: Grid) -> tuple[Rows, Sweep]:
    """Rows close enough for reading between them, and everything there."""
    low, high, *_ = bounds(subject)
    if isinstance(subject.model, UnstableDelay):  # the rule knows one tau_c: two rows of the same
        nodes = Rows(np.log([0.99, 1.01]) + math.log(subject.model.theta), (0, 1))
        return nodes, subject.swept(np.full(2, subject.model.theta), grid)

    def compute(tau_c: np.ndarray) -> list[np.ndarray]:
        controllers = [subject.controller(each) for each in tau_c.tolist()]
        unit = time_curves(subject.plant, controllers, grid.t, grid.load, grid.ramps)
        return list(np.einsum("nsit,i->snt", unit, grid.heights))

    nodes, _ = refined(first_rows(low, high, kinks(subject.model, subject.tuning.rule)), compute)
    return nodes, subject.swept(nodes.tau_c, grid)


def curves(found: Sweep, grid: Grid) -> dict[str, np.ndarray]:
    """CURVES of a sweep: r from 0 on and d from the time of the load on; each of shape (rows, points)."""
    r, d = grid.heights
    y, u = r * found.y_setpoint + d * found.y_disturbance, r * found.u_setpoint + d * found.u_disturbance
    return dict(zip(CURVES, (y, u, found.L.real, found.L.imag), strict=True))


def metrics(subject: Subject, found: Sweep) -> np.ndarray:
    """FIGURES of all rows, (rows, figures)."""
    values = {name: getattr(found, name) for name in (*MARGINS, *METRICS)}
    G = subject.plant.response(1j * found.omega)
    noise = [noise_gain(L, G, each) for L, each in zip(found.L, found.controllers, strict=True)]
    values["noise_gain"] = np.where(found.stable, noise, np.nan)
    return np.array([values[name] for name in FIGURES]).T


def exact(subject: Subject, grid: Grid, present: Study, name: str, answers: int, sheet: Sheet) -> bytes:
    """The present design without interpolation. name: of the table it belongs to; answers: the release it answers."""
    header = {
        "kind": "exact",
        "to": "tuning",
        "table": name,
        "tau_c": present.tau_c,
        "answers": answers,
        "labels": axis_labels(sheet),
        "stable": present.stable,
        "settings": sizes(present.controller.in_form(subject.form)),
        "metrics": figures(at_rest(present, grid.omega)),
    }
    return pack(header, dict(zip(CURVES, responses(present.loop, grid), strict=True)))


def responses(loop: Loop, grid: Grid) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """y and u at the instants, Re L and Im L at the frequencies."""
    course = simulate(loop, grid.excitation.scenario(disturbance_time=grid.load, t_end=float(grid.t[-1]), t=grid.t))
    L = loop.L(1j * grid.omega)
    return course.y, course.u, L.real, L.imag


def judged(each: Study, omega: np.ndarray) -> dict[str, float]:
    """FIGURES of a study; all nan where the loop is not stable."""
    if not each.stable:
        return dict.fromkeys(FIGURES, math.nan)
    metrics, s = each.performance, 1j * omega
    values = {name: getattr(each.margins, name) for name in MARGINS} | {
        "IAE_setpoint": metrics.setpoint.IAE,
        "IAE_disturbance": metrics.disturbance.IAE,
        "TV_setpoint": metrics.setpoint.TV,
        "TV_disturbance": metrics.disturbance.TV,
        "overshoot": metrics.setpoint.overshoot,
        "noise_gain": noise_gain(each.loop.L(s), each.loop.plant.response(s), each.controller),
    }
    return {name: values[name] for name in FIGURES}


def at_rest(each: Study, omega: np.ndarray) -> dict[str, float]:
    """FIGURES of a study, and those that are computed when nothing moves; all nan where the loop is not stable."""
    metrics, found = each.performance, judged(each, omega)
    if metrics is None:
        return found | dict.fromkeys(AT_REST, math.nan)
    load = metrics.disturbance
    values = (load.peak, metrics.setpoint.settling_time, load.settling_time)
    return found | dict(zip(AT_REST, values, strict=True))


def noise_gain(L: np.ndarray, G: np.ndarray, controller: Controller) -> float:
    """Largest |K S| = |L/G/(1 + L)|, measurement noise to input, at the frequencies of L and G and beyond all of them.

    Infinite for a derivative without filter.
    """
    form = controller.to_parallel()
    if form.Kd and not form.tau_F:
        return math.inf
    at_infinity = abs(form.Kd / form.tau_F if form.tau_F else form.Kp)
    return max(float(np.max(np.abs(L / (G * (1 + L))))), at_infinity)


def unstable_ranges(
    tau_c: np.ndarray, stable: np.ndarray, is_stable: Callable[[float], bool]
) -> list[tuple[float, float]]:
    """Ranges of tau_c without a stable loop; their ends by bisection between the rows, logarithmic."""
    ends = [float(tau_c[0])] if not stable[0] else []
    for i in np.flatnonzero(stable[1:] != stable[:-1]):
        a, b = math.log(tau_c[i]), math.log(tau_c[i + 1])
        for _ in range(BISECTIONS):
            middle = (a + b) / 2
            a, b = (middle, b) if is_stable(math.exp(middle)) == stable[i] else (a, middle)
        ends.append(math.exp((a + b) / 2))
    if not stable[-1]:
        ends.append(float(tau_c[-1]))
    return list(zip(ends[::2], ends[1::2], strict=True))


def cap(responses: np.ndarray, room: float) -> tuple[float, float]:
    """Limits that no axis goes beyond: what stable loops reach, and `room` times that span on either side."""
    if not responses.size:
        return (-10.0, 10.0)
    low, high = min(float(responses.min()), 0.0), max(float(responses.max()), 1.0)
    return (low - room * (high - low), high + room * (high - low))


def table_name(subject: Subject, grid: Grid, pins: Sequence[tuple[str, Study]]) -> str:
    """Of the table: same name, same table."""
    ends = grid.excitation, float(grid.t[-1]), len(grid.omega), float(grid.omega[0]), float(grid.omega[-1])
    return name_of(subject, *ends, [(each.tuning, each.controller) for _, each in pins])
