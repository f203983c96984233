"""A strip of figures: one cell each, what it means and its exact value on hover; the bands of Ms."""

import math
import re
from dataclasses import dataclass
from html import escape

from simc_core.figures import palette
from simc_core.notation import number

CALM, ATTENTION = 1.6, 2.0  # upper ends of the bands of Ms
SOLVED = 1e-6  # a loop designed for Ms = 2 has it to this
DIGITS = 3
STYLE = f"""<style>
.strip {{display: grid; grid-template-columns: 1.5fr repeat(5, 1fr); font-variant-numeric: tabular-nums;
  border: 1px solid {palette.GRID}; border-radius: 4px; overflow: hidden}}
.strip > div {{padding: 0.3rem 0.6rem; line-height: 1.25; min-width: 0}}
.strip small {{display: block; font-size: 0.75rem; opacity: 0.75; white-space: nowrap; overflow: hidden;
  text-overflow: ellipsis}}
.strip b {{font-size: 1.05rem; font-weight: 600; white-space: nowrap}}
.strip i {{font-style: normal; font-size: 0.8rem; opacity: 0.75}}
.strip .first {{grid-row: span 2; border-left: 6px solid var(--band); display: flex; flex-direction: column;
  justify-content: center}}
.strip .first b {{font-size: 2rem; color: var(--band)}}
.strip .first span {{font-weight: 600; font-size: 0.85rem}}
.strip.calm {{--band: {palette.CALM}}} .strip.attention {{--band: {palette.ATTENTION}}}
.strip.alarm {{--band: {palette.ALARM}}}
@media (max-width: 640px) {{
  .strip {{grid-template-columns: 1fr 1fr}}
  .strip .first {{grid-row: auto; grid-column: 1 / -1}}
}}
</style>"""


MEANINGS = {
    "Ms": "Ms = max |1/(1+L)|: 1/Ms is the smallest distance of L from −1; below 1.7 is usual, 2 the limit [SK03]",
    "Msa": "Msa = max |1/(1+La)|, La with the inner loop closed: 1/Msa is the smallest distance of La from −1",
    "Msb": "Msb = max |1/(1+Lb)| of the inner loop: 1/Msb is the smallest distance of Lb from −1",
    "Mt": "Mt = max |L/(1+L)|: how much a set point is amplified at worst",
    "Gain": "factor on the plant gain at which the loop becomes unstable",
    "GM": "factors on the plant gain, downwards and upwards, at which the loop becomes unstable",
    "Phase": "phase the loop may lose at |L| = 1 before it becomes unstable",
    "Delay": "dead time that may be added before the loop becomes unstable, in your time unit",
    "IAE": "integral of |r − y| after a unit step, over all time",
    "TV": "total variation of u, the wear of the actuator, after a unit step",
    "Overshoot": "of y beyond a unit step of the set point",
    "Peak": "how far y goes at most after a unit step of the load at the plant input",
    "Settling": "time until y stays within 2 % of the step",
}


@dataclass(frozen=True, slots=True)
class Reading:
    """One cell. text: as shown.   exact: on hover.   more: a word beside it."""

    label: str
    text: str
    exact: str
    more: str = ""


def band_of(Ms: float) -> tuple[str, str]:
    """Name of the band of Ms, and what it means in words."""
    if Ms <= CALM * (1 + SOLVED):
        return "calm", "calm: robust (≤ 1.6)"
    if Ms <= ATTENTION * (1 + SOLVED):
        return "attention", "attention: little to spare (≤ 2.0)"
    return "alarm", "alarm: too close to −1 (> 2.0)"


def hover(cell: Reading) -> str:
    """The exact value, and what it is."""
    meaning = MEANINGS[re.match(r"\w+", cell.label)[0]]
    return escape(f"{cell.exact}\n{meaning}")


def cell_html(cell: Reading) -> str:
    label = escape(cell.label)
    return f'<div title="{hover(cell)}"><small>{label}</small><b>{cell.text}</b> <i>{cell.more}</i></div>'


def reading(label: str, value: float, more: str = "") -> Reading:
    if math.isinf(value):
        return Reading(label, "∞", "infinite: no limit", "no limit")
    if math.isnan(value):
        return Reading(label, "–", "not known: too near its stability limit, the loop does not come to rest in reach")
    return Reading(label, number(value, DIGITS), f"{value:.10g}", more)


def pair(label: str, first: float, second: float) -> Reading:
    text = f"{number(first, DIGITS)} · {number(second, DIGITS)}"
    return Reading(label, text, f"{first:.10g} · {second:.10g}")


def percent(label: str, value: float) -> Reading:
    return Reading(label, number(100 * value, DIGITS), f"{100 * value:.10g} %", "%")
