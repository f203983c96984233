"""A strip of figures: one cell each, what it means and its exact value on hover; the bands of Ms."""

import math
from dataclasses import dataclass
from html import escape

from pages.common.parts.quantities import QUANTITIES
from pages.common.parts.units import unit_of
from pages.common.session import state
from pages.common.words import numeral, translated, words
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.studies.bands import band_of


@dataclass(frozen=True, slots=True)
class Reading:
    """One cell. text: as shown, and its unit.   exact: on hover, with what it means."""

    label: str
    text: str
    exact: str
    meaning: str
    unit: str = ""


def cell_html(cell: Reading) -> str:
    """One cell of the strip."""
    unit = f" <i>{escape(cell.unit)}</i>" if cell.unit else ""
    return f'<div title="{hover(cell)}"><small>{escape(cell.label)}</small><b>{cell.text}</b>{unit}</div>'


def peak_html(cell: Reading, Ms: float) -> str:
    """The cell of an Ms, larger, with its band in words and colour."""
    band = band_of(Ms)
    return (
        f'<div class="first {band.tone}" title="{hover(cell)}"><small>{escape(cell.label)}</small><b>{cell.text}</b>'
        f"<span>{translated(band.words)}</span></div>"
    )


def hover(cell: Reading) -> str:
    """The exact value, and what it is."""
    return escape(f"{cell.exact}\n{cell.meaning}")


def reading(name: str, value: float, label: str = "") -> Reading:
    """The cell of a quantity; label: where it is not the quantity's own."""
    quantity = QUANTITIES[name]
    exact = numeral(f"{quantity.factor * value:.10g}")
    if math.isinf(value):
        exact = words("infinite: no limit")
    if math.isnan(value):
        exact = words("no number: the loop keeps an offset (no integral action), or does not come to rest in reach")
    unit = unit_of(quantity.unit, state.design_now().sheet)
    return Reading(
        label or translated(quantity.label), translated(quantity.text(value)), exact, translated(quantity.meaning), unit
    )


def pair(label: str, names: tuple[str, str], values: tuple[float, float]) -> Reading:
    """Two quantities in one cell."""
    first, second = (reading(name, value) for name, value in zip(names, values, strict=True))
    return Reading(
        label, f"{first.text} · {second.text}", f"{first.exact} · {second.exact}", second.meaning, second.unit
    )


def gain_margin(judged: Margins) -> Reading:
    """The upper limit, and the lower one where there is one."""
    if judged.GM_lower > 0:
        return pair(words("Gain margin, low · high"), ("GM_lower", "GM"), (judged.GM_lower, judged.GM))
    return reading("GM", judged.GM)
