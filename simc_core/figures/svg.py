"""Curves with axes and units as SVG text, for reports, without a browser."""

import math
from collections.abc import Callable, Mapping
from html import escape

import numpy as np

from simc_core.figures import palette

WIDTH, HEIGHT = 340, 190
LEFT, RIGHT, TOP, BOTTOM = 52, 8, 22, 34  # of the frame
TICKS = 5  # about so many
DASHES = {"solid": "none", "dash": "6 4", "dot": "1.5 3", "dashdot": "6 3 1.5 3", "longdash": "10 4"}
NEAR = 0.05  # of a pixel: points on a straight line to this are left out
FAR = 5.0  # heights of the steps beyond which a growing curve is cut off
Curve = tuple[np.ndarray, np.ndarray, tuple[str, str, float]]  # x, y, and colour, dash, width


def figure(
    curves: Mapping[str, Curve],
    x_title: str,
    y_title: str,
    key: str,
    view: float = math.inf,
    label: str = "",
    written: Callable[[float], str] = "{:g}".format,
) -> str:
    """An <svg> element.

    Parameters
    ----------
    curves : mapping of str to (x, y, (colour, dash, width))
        By their names in the legend; the first is drawn on top.
    x_title, y_title : str
        With units, as plain text.
    key : str
        Of the figure on its page.
    view : float
        |y| beyond it is cut off.
    label : str
        What it shows, for those who do not see it; made of both titles unless given.
    written : callable
        A number of an axis as text.
    """
    inside = {name: (x, np.clip(y, -view, view), style) for name, (x, y, style) in curves.items()}
    xs, ys = (np.concatenate([curve[axis] for curve in inside.values()]) for axis in (0, 1))
    x = _Axis(float(xs.min()), float(xs.max()), LEFT, WIDTH - RIGHT)
    low, high = float(ys.min()), float(ys.max())
    room = 0.04 * (high - low) or 1.0
    y = _Axis(low - room, high + room, HEIGHT - BOTTOM, TOP)
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
        f'aria-label="{escape(label or f"{y_title} over {x_title}")}" font-family="sans-serif" font-size="10">',
        f'<clipPath id="{key}"><rect x="{LEFT}" y="{TOP}" width="{WIDTH - LEFT - RIGHT}" '
        f'height="{HEIGHT - TOP - BOTTOM}"/></clipPath>',
    ]
    for value in x.ticks():
        parts.append(_text(x.place(value), HEIGHT - BOTTOM + 13, written(value), "middle"))
    for value in y.ticks():
        parts.append(_line(LEFT, y.place(value), WIDTH - RIGHT, y.place(value), palette.GRID))
        parts.append(_text(LEFT - 5, y.place(value) + 3.5, written(value), "end"))
    parts += [
        _line(LEFT, HEIGHT - BOTTOM, WIDTH - RIGHT, HEIGHT - BOTTOM, palette.NEUTRAL),
        _line(LEFT, TOP, LEFT, HEIGHT - BOTTOM, palette.NEUTRAL),
        _text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 5, x_title, "middle"),
        f'<text transform="translate(11 {(TOP + HEIGHT - BOTTOM) / 2}) rotate(-90)" text-anchor="middle" '
        f'fill="currentColor">{escape(y_title)}</text>',
    ]
    for name, (t, values, style) in reversed(inside.items()):
        parts.append(_curve(name, x.places(t), y.places(values), style, key))
    return "".join([*parts, *_legend(inside), "</svg>"])


class _Axis:
    """From numbers to pixels."""

    def __init__(self, low: float, high: float, start: float, end: float) -> None:
        self.low, self.high = low, high if high > low else low + 1.0
        self.start, self.scale = start, (end - start) / (self.high - self.low)

    def place(self, value: float) -> float:
        """Pixel of a number."""
        return self.start + (value - self.low) * self.scale

    def places(self, value: np.ndarray) -> np.ndarray:
        """Pixels of an array."""
        return self.start + (value - self.low) * self.scale

    def ticks(self) -> list[float]:
        """Round numbers within."""
        rough = (self.high - self.low) / TICKS
        power = 10.0 ** math.floor(math.log10(rough))
        step = next(factor * power for factor in (1, 2, 5, 10) if factor * power >= rough * (1 - 1e-9))
        first, last = math.ceil(self.low / step - 1e-9), math.floor(self.high / step + 1e-9)
        return [float(f"{i * step:.12g}") for i in range(first, last + 1)]


def _curve(name: str, x: np.ndarray, y: np.ndarray, style: tuple[str, str, float], key: str) -> str:
    colour, dash, width = style
    points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(*_thinned(x, y), strict=True))
    return (
        f'<polyline data-name="{escape(name)}" points="{points}" fill="none" stroke="{colour}" '
        f'stroke-width="{width * 0.8:g}" stroke-dasharray="{DASHES[dash]}" clip-path="url(#{key})"/>'
    )


def _thinned(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Without points that lie on the line between their neighbours."""
    if len(x) < 3:
        return x, y
    span = np.maximum(x[2:] - x[:-2], 1e-12)
    between = y[:-2] + (y[2:] - y[:-2]) * (x[1:-1] - x[:-2]) / span
    kept = np.concatenate([[True], (np.abs(y[1:-1] - between) > NEAR) | (span < 1e-9), [True]])
    kept[::4] = True  # a slow bend may hide from three neighbours
    return x[kept], y[kept]


def _legend(curves: Mapping[str, Curve]) -> list[str]:
    parts, left = [], float(LEFT)
    for name, (_, _, (colour, dash, width)) in curves.items():
        parts.append(
            f'<line x1="{left:g}" y1="10" x2="{left + 22:g}" y2="10" stroke="{colour}" stroke-width="{width * 0.8:g}" '
            f'stroke-dasharray="{DASHES[dash]}"/>'
        )
        parts.append(_text(left + 26, 13.5, name, "start"))
        left += 38 + 5.6 * len(name)
    return parts


def _line(x1: float, y1: float, x2: float, y2: float, colour: str) -> str:
    return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}"/>'


def _text(x: float, y: float, text: str, anchor: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="currentColor">{escape(text)}</text>'
