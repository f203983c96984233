"""The user's names of units, put where figures and tables leave room for them."""

import re
from html import escape

from pages.common.parts.foreign_text import exact
from pages.common.session.sheet import Sheet
from pages.common.words import translated
from simc_core.notation import number as core_number
from simc_core.wording import Text, joined

PLAIN = re.compile(r"(?:[^\W_]|[%°/·⁻²³ ()])*")  # nothing in it that Markdown or Streamlit would read as more than text


def labels(sheet: Sheet) -> dict[str, str]:
    """What stands for the open places of an axis: time, y and u; an open place stays open where there is no name."""
    found = {}
    if sheet.time_unit:
        found["time unit"] = sheet.time_unit
    if sheet.PV_unit:
        found["unit of y"] = sheet.PV_unit
    if sheet.OP_unit:
        found["unit of u"] = sheet.OP_unit
    return found


def named(text: str, sheet: Sheet) -> str:
    """A text with its open places filled."""
    return filled(text, labels(sheet))


def axes_named(figure: dict, sheet: Sheet) -> dict:
    """A figure in plotly's schema with axes and hover texts named; plotly reads markup: foreign signs are escaped."""
    safe = {place: escape(unit, quote=False) for place, unit in labels(sheet).items()}
    for name, axis in figure["layout"].items():
        if name[1:5] == "axis" and safe:
            title = axis.get("title")
            text = title.get("text") if isinstance(title, dict) else title
            if text:
                text = filled(text, safe)
                axis["title"] = {**title, "text": text} if isinstance(title, dict) else text
    for trace in figure["data"] if sheet.time_unit else ():
        if "[rad/time unit]" in trace.get("hovertemplate", ""):
            trace["hovertemplate"] = filled(trace["hovertemplate"], {"[rad/time unit]": f"rad/{sheet.time_unit}"})
    return figure


def filled(text: str, units: dict[str, str]) -> str:
    """A text with its open places filled; one that can be translated still can."""
    if isinstance(text, Text):
        return text.put(
            **{name: units[value] for name, value in text.values.items() if isinstance(value, str) and value in units}
        )
    for place, unit in units.items():
        text = text.replace(place, unit)
    return text


def unit_of(what: str, sheet: Sheet) -> str:
    """The unit of a quantity, such as "time" or "PV/(OP time)"; empty where one of its units has no name."""
    units = {"time": sheet.time_unit, "PV": sheet.PV_unit, "OP": sheet.OP_unit}
    if not all(units[name] for name in re.findall("time|PV|OP", what)):
        return ""
    if what in units:
        return units[what]
    return re.sub("time|PV|OP", lambda found: _factor(units[found[0]]), what)


def _factor(unit: str) -> str:
    """A unit within another one: m3/h in brackets, so that (m3/h)/m is read in one way."""
    return f"({unit})" if "/" in unit else unit


def measured(value: float, unit: str, digits: int = 4) -> str:
    """A number with its unit, where that has a name, to stand in a Text."""
    told = core_number(value, digits)
    return joined((told, unit), " ") if unit else told


def time_text(value: float, sheet: Sheet, digits: int = 4) -> str:
    """A time as a number with its unit, where that has a name."""
    return translated(measured(value, sheet.time_unit, digits))


def with_unit(label: str, unit: str) -> str:
    """A label of a widget, as Markdown, with its unit in brackets."""
    if not unit:
        return label
    return f"{label} [{unit if PLAIN.fullmatch(unit) else exact(unit)}]"


def with_plain_unit(label: str, unit: str) -> str:
    """The same where it is not read as Markdown."""
    return joined((label, f" [{unit}]"), "") if unit else label
