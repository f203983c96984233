"""What the strip of an instrument says of its figures: labels, meanings, bands of Ms. Pure: no streamlit."""

from pages.common.parts.quantities import QUANTITIES
from simc_core.studies.bands import BANDS, CIRCLES, SOLVED

PEAKS = ("Ms", "Ms_outer", "Ms_inner")


def judgement(names: tuple[str, ...]) -> dict:
    """For the header of a message; names: of the cells, in their order."""
    cells = [
        {
            "name": name,
            "label": QUANTITIES[name].label,
            "meaning": QUANTITIES[name].meaning,
            "factor": QUANTITIES[name].factor,
            "peak": name in PEAKS,
        }
        for name in names
    ]
    bands = [[min(band.upto, 1e300), band.tone, band.words] for band in BANDS]
    return {"cells": cells, "bands": bands, "solved": SOLVED, "circles": CIRCLES}
