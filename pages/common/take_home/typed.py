"""The settings of a design as they are typed into a box, in the units of the loop sheet. Pure: no streamlit."""

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction

from pages.common.session.sheet import TIME_UNITS, Sheet
from simc_core import BOXES, Typed, from_box, to_box
from simc_core.controllers.forms import Controller
from simc_core.implementation.boxes.box import DIRECT, PV_FILTER, REVERSE, STRUCTURE
from simc_core.wording import Numeral, Text, joined, said

# By the form of a box: raises FormError where the design has none, with numbers as the page has them, not in seconds.
NEEDED = {
    "ideal": lambda controller: controller.to_ideal(),
    **dict.fromkeys(("series", "interacting"), lambda controller: controller.to_series()),
}
SECONDS = said("times are taken as seconds")
SPAN = 100.0  # where a range is not told, it is taken as 0 to 100 of its unit


def name_of(key: str) -> Text:
    """A box with its maker."""
    return said("{maker}: {box}", maker=BOXES[key].maker, box=BOXES[key].title)


def typed_into(key: str, controller: Controller, sheet: Sheet, rounded: bool, nearest: bool = False) -> Typed:
    """What is typed, and the controller in effect, in the time unit of the design. Raises SimcError.

    nearest: a number beyond its range becomes the nearest within it.
    """
    NEEDED.get(BOXES[key].form, lambda _: None)(controller)
    seconds = seconds_of(sheet)
    found = to_box(controller.rescaled(seconds), key, *spans(sheet), rounded=rounded, nearest=nearest)
    return replace(found, effective=found.effective.rescaled(1 / seconds))


def read_from(key: str, values: Mapping[str, float | str], action: str, sheet: Sheet) -> Controller:
    """The controller that typed numbers make, in the time unit of the design. Raises SimcError."""
    return from_box(key, values, action, *spans(sheet)).rescaled(1 / seconds_of(sheet))


def seconds_of(sheet: Sheet) -> Fraction:
    """Seconds in a time unit of the design; one that has no name is taken as a second."""
    return TIME_UNITS.get(sheet.time_unit, Fraction(1))


def spans(sheet: Sheet) -> tuple[float, float]:
    """Ranges of PV and of OP."""
    ends = ((sheet.PV_low, sheet.PV_high), (sheet.OP_low, sheet.OP_high))
    return tuple(SPAN if None in (low, high) else high - low for low, high in ends)


def assumed(sheet: Sheet) -> list[Text]:
    """What the loop sheet does not tell and is taken as usual."""
    found = []
    if not sheet.time_unit:
        found.append(SECONDS)
    for signal in ("PV", "OP"):
        if None in (getattr(sheet, f"{signal}_low"), getattr(sheet, f"{signal}_high")):
            found.append(said("the range of {signal} is taken as 0 to 100", signal=signal))
    return found


def rows(key: str, found: Typed, sheet: Sheet) -> list[dict[str, str]]:
    """Field, value, unit: as the box has them, its action and structure last; what is to be translated still can."""
    box = BOXES[key]
    units = {each.name: _unit(each.unit, sheet) for each in box.fields} | {PV_FILTER: "s", STRUCTURE: ""}
    named = {name: name for name in (*box.structures, *units)}
    shown = [
        {"field": named[name], "value": named.get(value) or _value(value), "unit": units[name]}
        for name, value in found.values.items()
    ]
    action = REVERSE if found.action == "reverse" else DIRECT
    value: str = box.actions[0 if action == REVERSE else 1]
    field: str = said("action")
    if " = " in value:  # InvertControl = FALSE
        field, _, value = value.rpartition(" = ")
    return [*shown, {"field": field, "value": value, "unit": "" if value == action else action}]


def as_text(shown: list[dict[str, str]]) -> str:
    """Lines `field = value unit`."""
    return "\n".join(f"{row['field']} = {row['value']} {row['unit']}".rstrip() for row in shown)


def _value(value: float | str) -> str:
    return value if isinstance(value, str) else Numeral(f"{value:.10g}")


def _unit(unit: str, sheet: Sheet) -> str:
    if unit == "units":
        return said("units")
    if "PV" not in unit or sheet.PV_unit:
        return unit.replace("PV", sheet.PV_unit)
    return joined((unit.replace("PV", ""), said("unit of PV")), "")
