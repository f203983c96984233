"""Operating points as people have them, and the gain schedule they make. Pure: no streamlit."""

from collections.abc import Callable
from functools import lru_cache

from pages.common.parts.units import with_plain_unit
from pages.common.session.design import Design
from pages.common.session.home import Home, Point
from pages.common.session.links import number_text
from pages.common.session.sheet import Sheet
from pages.common.session.time_unit import in_time_unit
from pages.common.session.tuning import Tuning
from simc_core import GainSchedule, ScheduleTable, export_schedule, read_numbers, simc
from simc_core.controllers.forms import Controller
from simc_core.errors import InvalidParameter
from simc_core.plants.models import Model
from simc_core.rules.speed import tau_c_in_use
from simc_core.wording import said


def points_of(text: str) -> tuple[Point, ...]:
    """Rows of numbers, one operating point a line; a first line of words is passed over. Raises InvalidParameter."""
    lines = [line for line in text.splitlines() if line.strip()]
    if lines and not any(c.isdigit() for c in lines[0]):
        lines = lines[1:]
    points = tuple(
        tuple(read_numbers(said("row {i}", i=i), line.replace("\t", " ").strip()))
        for i, line in enumerate(lines, start=1)
    )
    if len(points) == 1:
        raise InvalidParameter(said("a schedule has 2 rows at least, found 1"))
    return Home(points=points).points


def text_of(points: tuple[Point, ...]) -> str:
    """The points as `points_of` reads them."""
    return "\n".join("  ".join(map(number_text, point)) for point in points)


def schedule_of(design: Design) -> GainSchedule:
    """The schedule with the tuning of the design at every point. Raises SimcError."""
    return _schedule(design.home.points, design.home.between, design.tuning)


@lru_cache(maxsize=16)
def _schedule(points: tuple[Point, ...], between: str, tuning: Tuning) -> GainSchedule:
    home = Home(points=points)
    return GainSchedule(home.values, home.models, _rule(tuning), between)


@lru_cache(maxsize=16)
def table_of(schedule: GainSchedule) -> ScheduleTable:
    """What a program has of it. Raises SimcError."""
    return ScheduleTable(schedule)


def schedule_code(design: Design) -> str:
    """The table as source text, in minutes or seconds as the controller is. Raises SimcError."""
    unit = design.sheet.time_unit
    told = design if unit in ("", "s", "min") else in_time_unit(design, "s")
    return export_schedule(table_of(schedule_of(told)), design.home.language, "min" if unit == "min" else "s")


def schedule_csv(table: ScheduleTable, sheet: Sheet) -> str:
    """Scheduling value, Kp, tau_I, tau_D of the ideal form, all digits."""
    names = ("value", "Kp", *(with_plain_unit(name, sheet.time_unit) for name in ("tau_I", "tau_D")))
    rows = zip(table.x, (1 / band for band in table.band), table.tau_I, table.tau_D, strict=True)
    return "\r\n".join([",".join(names), *(",".join(map(repr, row)) for row in rows), ""])


def _rule(tuning: Tuning) -> Callable[[Model], Controller]:
    """SIMC with the tau_c, the filter and the weight of the tuning; the model is taken as it is."""

    def settings(model: Model) -> Controller:
        controller = simc(model, tau_c_in_use(model, tuning.tau_c, tuning.speed))
        return controller.with_filter(tuning.filter).with_weight(tuning.b)

    return settings
