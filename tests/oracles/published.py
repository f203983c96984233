"""The cited numbers of tests/data/published.json, and the plants and controllers they belong to.

value = PUBLISHED["S03-rob-fopdt-Ms"]
assert margins(value.loop).Ms == value.approx()
"""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from simc_core import IController, Loop, Plant, SeriesPid

FILE = Path(__file__).parents[1] / "data" / "published.json"


@dataclass(frozen=True, slots=True)
class Published:
    """One published value, or several printed in one row; expected and tolerance have the same length."""

    id: str
    source: str
    statement: str
    inputs: dict[str, Any]
    expected: tuple[float, ...]
    tolerance: tuple[float, ...]

    @property
    def plant(self) -> Plant:
        """The plant of the entry."""
        return plant_of(self.inputs)

    @property
    def loop(self) -> Loop:
        """The plant under the controller of the entry."""
        return Loop(self.plant, controller_of(self.inputs))

    def approx(self, index: int = 0):
        """The printed value with its printed tolerance, for ==."""
        return pytest.approx(self.expected[index], abs=self.tolerance[index], rel=0)


def plant_of(inputs: dict[str, Any]) -> Plant:
    """The plant described by an entry's inputs."""
    given = inputs["plant"]
    return Plant(
        given["k"],
        given.get("theta", 0.0),
        tuple(given.get("lags", ())),
        tuple(given.get("leads", ())),
        given.get("integrators", 0),
    )


def controller_of(inputs: dict[str, Any]) -> SeriesPid | IController:
    """The controller of an entry; 'PI part only' at the set point is b = 1, c = 0, the default."""
    given = inputs.get("controller", inputs)
    if given["form"] == "I":
        return IController(given["K_I"])
    return SeriesPid(given["Kc"], given["tau_I"], given.get("tau_D", 0.0), given.get("tau_F", 0.0))


def select(*words: str) -> list:
    """Entries whose id contains one of the words, as pytest parameters with the id as name."""
    chosen = [value for value in PUBLISHED.values() if any(word in value.id for word in words)]
    assert chosen, f"no entry matches {words}"
    return [pytest.param(value, id=value.id) for value in chosen]


def _read(entry: dict[str, Any]) -> Published:
    expected, tolerance = entry["expected"], entry["tolerance"]
    several = isinstance(expected, list)
    return Published(
        entry["id"],
        entry["source"],
        entry["statement"],
        entry["inputs"],
        tuple(map(float, expected)) if several else (float(expected),),
        tuple(map(float, tolerance)) if several else (float(tolerance),),
    )


PUBLISHED = {entry["id"]: _read(entry) for entry in json.loads(FILE.read_text(encoding="utf-8"))["values"]}
