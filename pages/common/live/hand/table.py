"""What the instrument of the hand is sent: what may be turned, and the exact picture of where it stands. Pure.

Knobs hold sizes without sign: a negative gain keeps its sign while it is dragged.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from pages.common.live.kit.judgement import axis_labels, judgement
from pages.common.live.kit.naming import name_of
from pages.common.live.kit.packing import figures, pack
from pages.common.live.tuning.table import CURVES, SHOWN, Grid, at_rest, cap, responses
from pages.common.parts.settings_text import UNITS
from pages.common.session.sheet import Sheet
from pages.common.studies.single import Study, study_of_settings
from pages.common.words import translated
from simc_core.controllers.forms import Controller, IController, IdealPid, SeriesPid
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import Loop
from simc_core.plants.plant import Plant
from simc_core.wording import said

REACH = 10.0  # a knob goes to so many times its value, and to its inverse
CELLS = tuple(name for name in SHOWN if name != "noise_gain")
LEAST_D = 0.01  # of tau_I or theta: the lowest tau_D above 0 on the knob
NAMES = {
    "Kc": ("K<sub>c</sub>", said("Controller gain Kc")),
    "tau_I": ("τ<sub>I</sub>", said("Integral time tau_I")),
    "tau_D": ("τ<sub>D</sub>", said("Derivative time tau_D")),
    "Kp": ("K<sub>p</sub>", said("Proportional gain Kp")),
    "Ki": ("K<sub>i</sub>", said("Integral gain Ki")),
    "Kd": ("K<sub>d</sub>", said("Derivative gain Kd")),
    "K_I": ("K<sub>I</sub>", said("Integral gain K_I")),
    "k": ("k", said("Gain of the plant k")),
    "theta": ("θ", said("Dead time theta")),
    "tau1": ("τ<sub>1</sub>", said("Largest time constant tau1")),
}


KNOB_UNITS = {**UNITS, "theta": "time", "tau1": "time"}


@dataclass(frozen=True, slots=True)
class Subject:
    """What is turned. settings: the knobs are those of the controller, else those of the plant.

    plant, controller: where the knobs were when they were offered; their ranges follow from these, or are `within`:
    (name, low, high) of the knobs that are offered.
    """

    plant: Plant
    controller: Controller
    settings: bool
    within: tuple[tuple[str, float, float], ...] = ()

    def at(self, values: dict[str, float]) -> Loop:
        """The loop with the knobs there. Raises InvalidParameter for values out of bounds."""
        if self.settings:
            given = self.controller.settings
            turned = {name: math.copysign(value, given[name]) for name, value in values.items() if name in given}
            return Loop(self.plant, replace(self.controller, **turned))
        return Loop(turned_plant(self.plant, values), self.controller)


def turned_plant(plant: Plant, values: dict[str, float]) -> Plant:
    """The plant with k, theta or tau1, its largest time constant, at other sizes. Raises InvalidParameter."""
    lags = list(plant.lags)
    if "tau1" in values:
        largest = max(range(len(lags)), key=lambda i: abs(lags[i]))
        lags[largest] = math.copysign(values["tau1"], lags[largest])
    k = math.copysign(values.get("k", abs(plant.k)), plant.k)
    return replace(plant, k=k, theta=values.get("theta", plant.theta), lags=tuple(lags))


def knobs(subject: Subject) -> list[dict]:
    """Name, words, value and range of each knob."""
    if subject.within:
        values = subject.controller.settings
        ranges = {name: {"low": low, "high": high} for name, low, high in subject.within}
        return [_knob(subject, name, abs(values[name])) | ranges[name] for name in ranges]
    if subject.settings:
        values = {name: value for name, value in subject.controller.settings.items() if math.isfinite(value)}
    else:
        values = {"k": subject.plant.k, "theta": subject.plant.theta}
        if subject.plant.lags:
            values["tau1"] = max(subject.plant.lags, key=abs)
    return [_knob(subject, name, abs(value)) for name, value in values.items()]


def _knob(subject: Subject, name: str, value: float) -> dict:
    symbol, label = NAMES[name]
    zero = name in ("tau_D", "Kd", "Ki", "theta")  # which may be nothing at all
    size = value or _usual(subject, name)
    low = size * LEAST_D if zero else size / REACH
    return {
        "name": name,
        "symbol": symbol,
        "label": translated(label),
        "value": value,
        "low": low,
        "high": size * REACH,
        "zero": zero,
        "what": KNOB_UNITS.get(name) or _gain_of(subject.plant),
    }


def _gain_of(plant: Plant) -> str:
    return {0: "PV/OP", 1: "PV/(OP time)"}.get(plant.integrators, "")


def _usual(subject: Subject, name: str) -> float:
    """A size for a knob that stands at nothing."""
    time = subject.plant.theta or subject.plant.slowest or 1.0
    if name in ("tau_D", "theta"):
        return 0.5 * time
    form = subject.controller.to_parallel()
    gain = abs(form.Kp) or abs(form.Ki) * time or 1.0
    return gain * time / 2 if name == "Kd" else gain / (4 * time)


def setup(
    subject: Subject,
    grid: Grid,
    present: Study,
    behind: Sequence[tuple[str, Study]],
    name: str,
    more: Mapping[str, object] | None = None,
) -> bytes:
    """What does not change while a knob moves. behind: designs that are drawn behind, by name. more: of the header."""
    plant = {field: getattr(subject.plant, field) for field in Plant.__slots__}
    header = {
        "kind": "setup",
        "id": name,
        "knobs": knobs(subject),
        "moves_settings": subject.settings,
        "plant": plant,
        "controller": _controller(subject.controller),
        "steps": grid.steps,
        "t": grid.t.tolist(),
        "omega": grid.omega.tolist(),
        **judgement(CELLS),
        "pins": [{"name": translated(letter)} for letter, _ in behind],
        **(more or {}),
    }
    y, u, *_ = responses(present.loop, grid)
    of_stable = present.stable
    header["y_cap"], header["u_cap"] = (
        cap(curve[: len(curve) * of_stable], room) for curve, room in ((y, 2.0), (u, 3.0))
    )
    blocks = {}
    if behind:
        rows = zip(*[responses(each.loop, grid) for _, each in behind], strict=True)
        blocks = {f"pin_{field}": np.array(block) for field, block in zip(CURVES, rows, strict=True)}
    return pack(header, blocks)


def _controller(controller: Controller) -> dict:
    form = {SeriesPid: "series", IdealPid: "ideal", IController: "I"}.get(type(controller), "parallel")
    settings = {name: value if math.isfinite(value) else None for name, value in controller.settings.items()}
    weights = (0.0, 1.0, 0.0) if form == "I" else (controller.tau_F, controller.b, controller.c)
    return {"form": form, "settings": settings, **dict(zip(("tau_F", "b", "c"), weights, strict=True))}


def exact(
    subject: Subject,
    grid: Grid,
    values: dict[str, float],
    name: str,
    answers: int,
    sheet: Sheet,
    to: str = "hand",
) -> bytes:
    """The picture at these values without the engine of the browser.

    name: of the setup.   answers: the release.   to: the instrument that shows it.
    """
    loop = subject.at(values)
    each = study_of_settings(loop.plant, loop.controller)
    header = {
        "kind": "exact",
        "to": to,
        "setup": name,
        "values": values,
        "answers": answers,
        "labels": axis_labels(sheet),
        "stable": each.stable,
        "metrics": figures(at_rest(each, grid.omega)),
    }
    return pack(header, dict(zip(CURVES, responses(loop, grid), strict=True)))


def values_of(subject: Subject) -> dict[str, float]:
    """Where the knobs are at first."""
    return {knob["name"]: knob["value"] for knob in knobs(subject)}


def allowed(subject: Subject, values: object) -> dict[str, float]:
    """Values that a browser sent, those of knobs only. Raises InvalidParameter for what is no number in range."""
    if not isinstance(values, Mapping):
        raise InvalidParameter(
            said("values must be those of the knobs by name, found {found}", found=f"{values!s:.20}")
        )
    found = {}
    for knob in knobs(subject):
        value = values.get(knob["name"], knob["value"])
        within = (
            isinstance(value, int | float)
            and (0 if knob["zero"] else knob["low"] * 0.999) <= value <= knob["high"] * 1.001
        )
        if not within:
            raise InvalidParameter(
                said(
                    "{name} must be within {low:g} to {high:g}, found {found}",
                    name=knob["name"],
                    low=knob["low"],
                    high=knob["high"],
                    found=f"{value!s:.20}",
                )
            )
        found[knob["name"]] = float(value)
    return found


def setup_name(subject: Subject, grid: Grid, behind: Sequence[tuple[str, Study]], *more: object) -> str:
    """Same name, same setup."""
    return name_of(
        subject, grid.excitation, float(grid.t[-1]), len(grid.t), [(letter, each.loop) for letter, each in behind], more
    )
