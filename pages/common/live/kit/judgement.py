"""What the strip of an instrument says of its figures: labels, meanings, bands of Ms. Pure: no streamlit."""

from pages.common.parts.quantities import QUANTITIES
from pages.common.parts.settings_text import UNITS
from pages.common.parts.units import named, unit_of
from pages.common.session.sheet import Sheet
from pages.common.words import translated
from simc_core.figures.palette import FREQUENCY, TIME
from simc_core.studies.bands import BANDS, CIRCLES, SOLVED

MEASURED = sorted({*UNITS.values(), "PV/OP", "PV/(OP time)", *(each.unit for each in QUANTITIES.values())} - {""})
PEAKS = ("Ms", "Ms_outer", "Ms_inner")


def judgement(names: tuple[str, ...]) -> dict:
    """For the header of a message; names: of the cells, in their order."""
    cells = [
        {
            "name": name,
            "label": translated(QUANTITIES[name].label),
            "meaning": translated(QUANTITIES[name].meaning),
            "factor": QUANTITIES[name].factor,
            "unit": QUANTITIES[name].unit,
            "peak": name in PEAKS,
        }
        for name in names
    ]
    bands = [[min(band.upto, 1e300), band.tone, translated(band.words)] for band in BANDS]
    return {"cells": cells, "bands": bands, "solved": SOLVED, "circles": CIRCLES}


def axis_labels(sheet: Sheet) -> dict[str, str]:
    """What stands on the axes of an instrument, in the user's units; and each unit by what it is of."""
    y, u = (f"{name}  [{unit}]" if unit else name for name, unit in (("y", sheet.PV_unit), ("u", sheet.OP_unit)))
    t, omega = (translated(named(axis, sheet)) for axis in (TIME, FREQUENCY))
    axes = {"t": t, "omega": omega, "y": y, "u": u}
    frequency = f"rad/{sheet.time_unit}" if sheet.time_unit else ""
    return axes | {"frequency": frequency} | {what: unit_of(what, sheet) for what in MEASURED}
