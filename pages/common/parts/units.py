"""The user's names of units, put where figures and tables leave room for them."""

from html import escape

from pages.common.session.sheet import Sheet


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
    for place, unit in labels(sheet).items():
        text = text.replace(place, unit)
    return text


def axes_named(figure: dict, sheet: Sheet) -> dict:
    """A figure in plotly's schema with its axes named; plotly reads markup in titles, so foreign signs are escaped."""
    safe = {place: escape(unit, quote=False) for place, unit in labels(sheet).items()}
    for name, axis in figure["layout"].items():
        if name[1:5] == "axis" and safe:
            title = axis.get("title")
            text = title.get("text") if isinstance(title, dict) else title
            if text:
                for place, unit in safe.items():
                    text = text.replace(place, unit)
                axis["title"] = {**title, "text": text} if isinstance(title, dict) else text
    return figure
