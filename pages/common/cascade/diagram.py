"""The block diagram of a cascade with its own blocks and settings, as inline SVG: one row, on a narrow screen two.

Signs and inputs are those of simc_core/nested.py. Strokes take the colour of the text, so that it follows the theme.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import streamlit as st

from pages.common.parts.settings_text import form_shown
from pages.common.session import state
from pages.common.studies.cascade import CascadeStudy
from pages.common.words import number, numeral, words
from simc_core.controllers.forms import Controller
from simc_core.notation import latex_factors, plain
from simc_core.plants.plant import Plant

LINE, CHARACTER, SMALL = 14, 6.3, 4.6  # px: line height, width of a letter and of one in an exponent
RADIUS = 9  # of a summing point
MOST_LINES = 3  # of a denominator; a longer plant is named only, and stands in full on top of the page
GREEK = {"tau_I": ("τ", "I"), "tau_D": ("τ", "D"), "tau_F": ("τ", "F")}


@dataclass(frozen=True, slots=True)
class Box:
    """What stands in a block. top, bottom: lines of SVG text; a fraction stroke between them where there are both."""

    kind: str
    name: str
    top: tuple[str, ...]
    bottom: tuple[str, ...] = ()

    @property
    def height(self) -> int:
        """px."""
        return 26 + LINE * (len(self.top) + len(self.bottom)) + (4 if self.bottom else 0)


def diagram(study: CascadeStudy, form: str) -> None:
    """The diagram; controllers with their settings in `form`, parallel where they have none in it."""
    picture = f'<div class="diagram">{wide(study, form)}{narrow(study, form)}</div>'
    st.markdown(picture, unsafe_allow_html=True)  # st.html takes no SVG; all texts in it are numbers or escaped


def wide(study: CascadeStudy, form: str) -> str:
    """All in one row, 940 px wide."""
    Ca, Cb, Gb, Ga = boxes = _boxes(study, form, plants=158)
    tall = max(box.height for box in boxes)
    y = 24 + tall / 2
    low = y + tall / 2 + 14
    parts = [
        *(_wire((4, y), (45 - RADIUS, y)), _label(6, y - 6, "r₁")),
        *(_sum(45, y), _wire((45 + RADIUS, y), (78, y))),
        *(_box(78, y, 112, Ca), _wire((190, y), (240 - RADIUS, y)), _label(204, y - 6, "r₂")),
        *(_sum(240, y), _wire((240 + RADIUS, y), (273, y))),
        *(_box(273, y, 112, Cb), _wire((385, y), (430 - RADIUS, y)), _label(400, y - 6, "u")),
        *(_sum(430, y), _wire((430, 8), (430, y - RADIUS)), _label(436, 14, "d₂")),
        *(_wire((430 + RADIUS, y), (458, y)), _box(458, y, 170, Gb)),
        *(_wire((628, y), (680 - RADIUS, y)), _label(636, y - 6, "y₂")),
        *(_sum(680, y), _wire((680, 8), (680, y - RADIUS)), _label(686, 14, "d₁")),
        *(_wire((680 + RADIUS, y), (706, y)), _box(706, y, 170, Ga)),
        *(_wire((876, y), (934, y)), _label(916, y - 6, "y₁")),
        *(_wire((650, y), (650, low), (240, low), (240, y + RADIUS)), _label(246, y + RADIUS + 12, "−")),
        *(_wire((900, y), (900, low + 12), (45, low + 12), (45, y + RADIUS)), _label(51, y + RADIUS + 12, "−")),
        *(_node(650, y), _node(900, y)),
    ]
    return _svg("wide", 940, low + 16, parts, study)


def narrow(study: CascadeStudy, form: str) -> str:
    """Controllers in one row, the plant back from right to left below it; 360 px wide."""
    Ca, Cb, Gb, Ga = boxes = _boxes(study, form, plants=108)
    above, below = max(box.height for box in boxes[:2]), max(box.height for box in boxes[2:])
    y, z = 4 + above / 2, 4 + above + 34 + below / 2
    parts = [
        *(_wire((0, y), (26 - RADIUS, y)), _label(0, y - 6, "r₁"), _sum(26, y)),
        *(_wire((26 + RADIUS, y), (46, y)), _box(46, y, 104, Ca)),
        *(_wire((150, y), (184 - RADIUS, y)), _label(156, y - 6, "r₂"), _sum(184, y)),
        *(_wire((184 + RADIUS, y), (206, y)), _box(206, y, 104, Cb)),
        *(_wire((310, y), (344, y), (344, z - RADIUS)), _label(348, y + 4, "u"), _sum(344, z)),
        *(_wire((344, z + 32), (344, z + RADIUS)), _label(350, z + 28, "d₂")),
        *(_wire((344 - RADIUS, z), (326, z)), _box(206, z, 120, Gb)),
        *(_wire((206, z), (171 + RADIUS, z)), _label(189, z + 15, "y₂"), _sum(171, z)),
        *(_wire((171, z + 32), (171, z + RADIUS)), _label(177, z + 32, "d₁")),
        *(_wire((171 - RADIUS, z), (154, z)), _box(34, z, 120, Ga)),
        *(_wire((34, z), (0, z)), _label(2, z + 15, "y₁")),
        *(_wire((193, z), (193, z - 22 - below / 2), (184, z - 22 - below / 2), (184, y + RADIUS))),
        *(_label(189, y + RADIUS + 12, "−"), _label(31, y + RADIUS + 12, "−")),
        *(_wire((26, z), (26, y + RADIUS)), _node(193, z), _node(26, z)),
    ]
    return _svg("narrow", 364, z + max(below / 2, 34) + 4, parts, study)


def settings_lines(controller: Controller, form: str) -> list[tuple[str, float]]:
    """Names and values of the settings in `form`, or in one that the controller has."""
    shown = controller.in_form(form_shown(controller, form))
    always, optional = shown.SETTINGS[:2], (*shown.SETTINGS[2:], *shown.OPTIONAL[:1])
    return [(name, getattr(shown, name)) for name in (*always, *(name for name in optional if getattr(shown, name)))]


def _boxes(study: CascadeStudy, form: str, plants: int) -> tuple[Box, Box, Box, Box]:
    """Ca, Cb, Gb, Ga. plants: px that the lines of a plant may take."""
    loop = study.loop
    controllers = []
    for kind, index, controller in (("outer", "a", loop.outer), ("inner", "b", loop.inner)):
        name = f"{_indexed('C', index)} {getattr(study.cascade, kind)}"
        lines = tuple(_setting(*each) for each in settings_lines(controller, form))
        controllers.append(Box(kind, name, lines))
    return *controllers, _plant_box("b", loop.secondary, plants), _plant_box("a", loop.primary, plants)


def _plant_box(index: str, plant: Plant, width: int) -> Box:
    name = _indexed("G", index)
    top, bottom = (_wrapped(factors, width) for factors in latex_factors(plant))
    if len(top) > MOST_LINES or len(bottom) > MOST_LINES:
        return Box("box", name, (words("as on top"),))
    return Box("box", name, top, bottom)


def _wrapped(factors: Sequence[str], width: int) -> tuple[str, ...]:
    """Factors as lines of SVG text that are no wider than `width`, broken between factors only."""
    lines: list[list[str]] = []
    for factor in factors:
        if lines and _width(" ".join([*lines[-1], factor])) <= width:
            lines[-1].append(factor)
        else:
            lines.append([factor])
    return tuple(_svg_text(" ".join(line)) for line in lines)


def _width(latex: str) -> float:
    small = sum(map(len, re.findall(r"\^\{?([^}]*)\}?", latex)))
    return CHARACTER * (len(re.sub(r"\^\{[^}]*\}|\\cdot", "·", latex))) + SMALL * small


def _svg_text(latex: str) -> str:
    """The little LaTeX of latex_factors as SVG text: exponents raised, real minus signs."""
    text = numeral(latex).replace(r"\cdot", "·").replace("-", "−").replace(" s", "\u2009s")
    pieces = re.split(r"\^(?:\{([^}]*)\}|(\d))", text)
    shown, raised = "", False
    for i in range(0, len(pieces), 3):
        if pieces[i]:
            shown += f'<tspan dy="{4 if raised else 0}">{escape(pieces[i])}</tspan>'
            raised = False
        exponent = next((each for each in pieces[i + 1 : i + 3] if each), "")
        if exponent:
            shown += f'<tspan dy="{0 if raised else -4}" font-size="9">{escape(exponent)}</tspan>'
            raised = True
    return shown


def _setting(name: str, value: float) -> str:
    letter, index = GREEK.get(name, (name[0], name[-1]))
    unit = state.design_now().sheet.time_unit if letter == "τ" else ""
    return f"{_indexed(letter, index)} = {escape(number(value))} {unit}".rstrip()


def _indexed(letter: str, index: str) -> str:
    """A letter with a lowered index, and back on the line behind it."""
    return f'{letter}<tspan dy="3" font-size="9">{index}</tspan><tspan dy="-3">\u200b</tspan>'


def _box(x: float, y: float, width: float, box: Box) -> str:
    top = y - box.height / 2
    middle = x + width / 2
    parts = [
        f'<rect class="box {box.kind}" x="{x}" y="{top:g}" width="{width}" height="{box.height}" rx="3"/>',
        f'<text class="name" x="{middle:g}" y="{top + 15:g}" text-anchor="middle">{box.name}</text>',
    ]
    line = top + 15 + LINE
    kind = ' class="setting"' if box.kind in ("outer", "inner") else ""
    for text in box.top:
        parts.append(f'<text{kind} x="{middle:g}" y="{line + 1:g}" text-anchor="middle">{text}</text>')
        line += LINE
    if box.bottom:
        stroke = line - LINE + 6
        parts.append(f'<path class="wire" d="M{x + 12:g} {stroke:g}H{x + width - 12:g}"/>')
        line += 4
    for text in box.bottom:
        parts.append(f'<text x="{middle:g}" y="{line + 1:g}" text-anchor="middle">{text}</text>')
        line += LINE
    return "".join(parts)


def _sum(x: float, y: float) -> str:
    return f'<circle class="wire" cx="{x}" cy="{y:g}" r="{RADIUS}"/><path class="wire" d="M{x - 4} {y:g}h8m-4 -4v8"/>'


def _node(x: float, y: float) -> str:
    return f'<circle class="head" cx="{x}" cy="{y:g}" r="2.6"/>'


def _label(x: float, y: float, text: str) -> str:
    return f'<text x="{x:g}" y="{y:g}">{text}</text>'


def _wire(*points: tuple[float, float]) -> str:
    """A line through the points with an arrow head at the last one."""
    (x0, y0), (x, y) = points[-2:]
    dx, dy = (x > x0) - (x < x0), (y > y0) - (y < y0)
    back, side = 7, 3.2
    head = f"M{x:g} {y:g}L{x - back * dx + side * dy:g} {y - back * dy + side * dx:g}"
    head += f"L{x - back * dx - side * dy:g} {y - back * dy - side * dx:g}Z"
    path = "L".join(f"{a:g} {b:g}" for a, b in points)
    return f'<path class="wire" d="M{path}"/><path class="head" d="{head}"/>'


def _svg(kind: str, width: float, height: float, parts: list[str], study: CascadeStudy) -> str:
    text = escape(described(study), quote=True)
    body = "".join(parts)
    return f'<svg class="{kind}" viewBox="0 0 {width:g} {height:g}" role="img" aria-label="{text}">{body}</svg>'


def described(study: CascadeStudy) -> str:
    """The diagram in words, for those who do not see it."""
    loop, cascade = study.loop, study.cascade
    return words(
        "Block diagram. The outer {outer} controller Ca compares the set point r1 with y1 and gives the set point r2 "
        "of the inner {inner} controller Cb, which compares it with y2 and drives Gb = {Gb}, with d2 added at its "
        "input. Its output y2 plus d1 drives Ga = {Ga}, whose output is y1.",
        outer=cascade.outer,
        inner=cascade.inner,
        Gb=numeral(plain(loop.secondary)),
        Ga=numeral(plain(loop.primary)),
    )
