"""A report as HTML that prints on one page of A4 and needs nothing else. Pure: no streamlit."""

from base64 import b64encode
from collections.abc import Iterable, Sequence
from html import escape
from pathlib import Path
from textwrap import wrap

import numpy as np

from pages.common.parts.qr import qr_svg
from pages.common.take_home.proof import table
from pages.common.take_home.report.record import Report, Row
from simc_core.figures import palette
from simc_core.figures.svg import FAR, HEIGHT, WIDTH, Curve, figure

STYLE = (Path(__file__).parent / "report.css").read_text(encoding="utf-8")
PAPER = "@page { size: A4; margin: 12mm; }\nbody { margin: 0; }\n"
LINE, CHARACTERS = 14, 105  # px and length, of the texts of a picture


def document(report: Report) -> str:
    """The whole file."""
    return (
        f'<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<title>{escape(title(report))}</title>\n'
        f"<style>\n{PAPER}{STYLE}</style>\n</head>\n<body>\n{body(report)}\n</body>\n</html>\n"
    )


def body(report: Report) -> str:
    """The report itself, as an <article>; its styles are those of report.css."""
    plant = [Row("plant", report.plant, ""), Row("kind", report.kind, ""), Row("from", report.came_from, "")]
    plant += [Row("note", report.note, "")] if report.note else []
    design = [Row("controller", report.how, ""), *report.settings]
    parts = [
        f"<header><h1>{escape(title(report))}</h1><p>{escape(report.made)}</p></header>",
        _section("Plant", f'<div class="pair">{_list(plant)}{_list(report.signals)}</div>'),
        '<div class="pair">',
        _section("Design", _list(design)),
        _section(f"Typed into {report.box}", _list(report.typed, "large")) if report.typed else "",
        "</div>",
        _section("Margins", _margins(report)),
        _section(f"Responses: {report.asked}", _drawn(report)),
        _section("What to watch", _items(report.watch)) if report.watch else "",
        _section("Sources", _items(report.sources)) if report.sources else "",
        _link(report.link),
    ]
    return f'<article class="report">{"".join(parts)}</article>'


def title(report: Report) -> str:
    """What it is called."""
    return f"{report.tag}: controller settings" if report.tag else "Controller settings"


def figures(report: Report) -> tuple[str, str]:
    """y and u of all curves, as SVG."""
    first = next(iter(report.curves.values()))
    x_title = f"t [{report.time}]" if report.time else "t"
    view = {"y": FAR * max(float(np.max(np.abs(first.r))), float(np.max(np.abs(first.d))), 1e-12), "u": np.inf}
    if all(each.stable for each in report.margins.values()):
        view["y"] = np.inf
    found = []
    for signal, colour, unit in (("y", palette.Y, report.y), ("u", palette.U, report.u)):
        curves: dict[str, Curve] = {
            name: (curve.t, getattr(curve, signal), palette.shade(colour, position))
            for position, (name, curve) in enumerate(report.curves.items())
        }
        if signal == "y":
            curves["r"] = first.t, first.r, (palette.R, "dash", 1.4)
        limit = view["y"] if signal == "y" else _limit_of_u(report, view["y"])
        found.append(figure(curves, x_title, f"{signal} [{unit}]" if unit else signal, f"view_{signal}", limit))
    return found[0], found[1]


def picture(report: Report) -> str:
    """Both figures as one SVG, with plant and settings in it."""
    settings = ", ".join(f"{row.name} {row.value} {row.unit}".rstrip() for row in report.typed or report.settings)
    texts = (title(report), report.plant, f"{report.box or report.how}: {settings}")
    lines = [line for text in texts for line in wrap(text, CHARACTERS)]
    width, height = 2 * WIDTH, LINE * len(lines) + 8 + HEIGHT
    size = f'width="{width}" height="{height}"'
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" {size}>']
    parts += [f'<rect {size} fill="white"/>']
    parts += [
        f'<text x="8" y="{LINE * i}" font-family="sans-serif" font-size="10">{escape(line)}</text>'
        for i, line in enumerate(lines, start=1)
    ]
    for i, svg in enumerate(figures(report)):
        place = f'<svg x="{i * WIDTH}" y="{LINE * len(lines) + 8}" width="{WIDTH}" height="{HEIGHT}" '
        parts.append(svg.replace("<svg ", place, 1))
    return "".join([*parts, "</svg>"])


def _drawn(report: Report) -> str:
    names = ", ".join(report.curves)
    parts = [_image(svg, f"{signal}: {names}") for signal, svg in zip("yu", figures(report), strict=True)]
    return f'<div class="pair">{"".join(parts)}</div>'


def _image(svg: str, alt: str) -> str:
    """As data: pages of Streamlit show no other SVG."""
    return f'<img alt="{escape(alt)}" src="data:image/svg+xml;base64,{b64encode(svg.encode()).decode()}">'


def _limit_of_u(report: Report, view: float) -> float:
    """|u| that is shown where a curve grows: that of the calmest."""
    return np.inf if np.isinf(view) else FAR * min(float(np.max(np.abs(each.u))) for each in report.curves.values())


def _section(name: str, content: str) -> str:
    return f"<section><h2>{escape(name)}</h2>{content}</section>"


def _list(rows: Sequence[Row], look: str = "plain") -> str:
    if not rows:
        return ""
    cells = "".join(
        f"<dt>{escape(row.name)}</dt><dd><span>{escape(row.value)}</span> {escape(row.unit)}</dd>" for row in rows
    )
    return f'<dl class="{look}">{cells}</dl>'


def _margins(report: Report) -> str:
    rows = table(report.margins, report.time)
    head = "".join(f"<th>{escape(name)}</th>" for name in rows[0])
    lines = ["<tr>" + "".join(f"<td>{escape(text)}</td>" for text in row.values()) + "</tr>" for row in rows]
    return f"<table><tr>{head}</tr>{''.join(lines)}</table>"


def _items(texts: Iterable[str]) -> str:
    return f"<ul>{''.join(f'<li>{escape(text)}</li>' for text in texts)}</ul>"


def _link(link: str) -> str:
    """The address of the design, and as a QR code where that can be read."""
    svg = qr_svg(link)
    code = f'<div class="qr">{_image(svg, "QR code of the address beside it")}</div>' if svg else ""
    said = f"This design, to be opened and changed: <span>{escape(link)}</span>"
    return f"<footer>{code}<p>{said}</p></footer>"
