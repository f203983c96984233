"""The response to a load step, new and now, drawn from a line of results.csv. Set-point weights do not matter to it."""

from collections.abc import Mapping

from simc_core.controllers.forms import Controller, IController, IdealPid, SeriesPid
from simc_core.errors import SimcError
from simc_core.figures import palette
from simc_core.figures.svg import FAR, figure
from simc_core.loops.loop import Loop
from simc_core.many.request import read_request
from simc_core.many.result import TROUBLES
from simc_core.plants.parse import parse_plant
from simc_core.simulation import Scenario, simulate
from simc_core.simulation.horizon import times

POINTS = 150
LOAD = Scenario(setpoint=0.0, disturbance=1.0, disturbance_time=0.0, points=POINTS)


def drawn(line: Mapping[str, str], key: str) -> str:
    """A figure as SVG; nothing where a line does not tell enough, or has been edited.

    line: of results.csv.   key: of the figure in its page.
    """
    try:
        plant = parse_plant(line["plant"].removeprefix("'"))
        loops = {"new": Loop(plant, _new(line))}
        if line["settings_now"]:
            loops["now"] = Loop(plant, _now(line))
        _, t_end = times(loops["new"], LOAD)
        if "now" in loops and line["now"] != TROUBLES[0]:  # of a loop that is stable
            t_end = min(max(t_end, times(loops["now"], LOAD)[1]), 5 * t_end)
        asked = Scenario(0.0, 1.0, 0.0, t_end, POINTS)
        found = {name: simulate(loop, asked) for name, loop in loops.items()}
    except (SimcError, ValueError, KeyError):
        return ""
    curves = {
        name: (each.t, each.y, palette.shade(palette.Y, position))
        for position, (name, each) in enumerate(found.items())
    }
    largest = float(abs(found["new"].y).max())
    text = figure(curves, "t", "y after a load step of 1", key, FAR * largest if largest else 1.0)
    return text.replace(' xmlns="http://www.w3.org/2000/svg"', "")  # which HTML knows


def _new(line: Mapping[str, str]) -> Controller:
    if line["form"] == "I":
        return IController(float(line["K_I"]))
    settings = float(line["Kc"]), float(line["tau_I"]), float(line["tau_D"] or 0), float(line["tau_F"] or 0)
    return IdealPid(*settings) if line["form"] == "ideal" else SeriesPid(*settings)


def _now(line: Mapping[str, str]) -> Controller:
    told = dict(each.split(" = ") for each in line["settings_now"].split(", "))
    given = told | {"form": line["form_now"], "tau_F": line["tau_F_now"], "plant": "1/(s+1)"}
    found = read_request(given).present
    if found is None:
        raise KeyError("settings_now")
    return found
