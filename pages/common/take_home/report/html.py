"""A report as HTML that prints on one page of A4 and needs nothing else, in the language in use. Pure: no streamlit."""

from base64 import b64encode
from collections.abc import Iterable, Sequence
from html import escape
from pathlib import Path
from textwrap import wrap

import numpy as np

from pages.common.parts.qr import qr_svg
from pages.common.take_home.proof import table
from pages.common.take_home.report.record import Report, Row, beginning, plant_rows
from pages.common.words import language, numeral, translated, words
from simc_core.figures import palette
from simc_core.figures.svg import FAR, HEIGHT, WIDTH, Curve, figure
from simc_core.wording import joined, said

STYLE = (Path(__file__).parent / "report.css").read_text(encoding="utf-8")
PAPER = "@page { size: A4; margin: 12mm; }\nbody { margin: 0; }\n"
LINE, CHARACTERS = 14, 105  # px and length, of the texts of a picture


def document(report: Report) -> str:
    """The whole file."""
    return (
        f'<!doctype html>\n<html lang="{language()}">\n<head>\n<meta charset="utf-8">\n'
        f"<title>{escape(title(report))}</title>\n"
        f"<style>\n{PAPER}{STYLE}</style>\n</head>\n<body>\n{body(report)}\n</body>\n</html>\n"
    )


def body(report: Report) -> str:
    """The report itself, as an <article>; its styles are those of report.css."""
    plant = plant_rows(report)
    design = [Row(said("controller"), report.how, ""), *report.settings]
    asked = translated(report.asked)
    parts = [
        f"<header><h1>{escape(title(report))}</h1><p>{escape(report.made)}</p></header>",
        _section(words("Plant"), f'<div class="pair">{_list(plant)}{_list(report.signals)}</div>'),
        '<div class="pair">',
        _section(words("Design"), _list(design)),
        _section(words("Typed into {box}", box=report.box), _list(report.typed, "large")) if report.typed else "",
        "</div>",
        _section(words("Margins"), _margins(report)),
        _section(words("Responses: {asked}", asked=asked), _drawn(report)),
        _section(words("What to watch"), _items(report.watch)) if report.watch else "",
        _section(words("Sources"), _items(report.sources)) if report.sources else "",
        _link(report.link),
    ]
    return f'<article class="report">{"".join(parts)}</article>'


def title(report: Report) -> str:
    """What it is called."""
    return words("{tag}: controller settings", tag=report.tag) if report.tag else words("Controller settings")


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
            translated(name): (curve.t, getattr(curve, signal), palette.shade(colour, position))
            for position, (name, curve) in enumerate(report.curves.items())
        }
        if signal == "y":
            curves["r"] = first.t, first.r, (palette.R, "dash", 1.4)
        limit = view["y"] if signal == "y" else _limit_of_u(report, view["y"])
        y_title = f"{signal} [{unit}]" if unit else signal
        label = words("{y_title} over {x_title}", y_title=y_title, x_title=x_title)
        found.append(figure(curves, x_title, y_title, f"view_{signal}", limit, label, lambda x: numeral(f"{x:g}")))
    return found[0], found[1]


def picture(report: Report) -> str:
    """Both figures as one SVG, with plant and settings in it."""
    settings = [joined(filter(None, row), " ") for row in report.typed or report.settings]
    shown = joined((report.box or report.how, joined(settings)), ": ")
    texts = (title(report), report.plant, translated(shown))
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
    names = ", ".join(map(translated, report.curves))
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
        f"<dt>{name}</dt><dd><span>{value}</span> {unit}</dd>"
        for name, value, unit in ((escape(translated(text)) for text in row) for row in rows)
    )
    return f'<dl class="{look}">{cells}</dl>'


def _margins(report: Report) -> str:
    rows = table(report.margins, report.time)
    head = "".join(f"<th>{escape(translated(name))}</th>" for name in rows[0])
    lines = [
        "<tr>" + "".join(f"<td>{escape(translated(text))}</td>" for text in row.values()) + "</tr>" for row in rows
    ]
    return f"<table><tr>{head}</tr>{''.join(lines)}</table>"


def _items(texts: Iterable[str]) -> str:
    return f"<ul>{''.join(f'<li>{escape(beginning(translated(text)))}</li>' for text in texts)}</ul>"


def _link(link: str) -> str:
    """The address of the design, and as a QR code where that can be read."""
    svg = qr_svg(link)
    code = f'<div class="qr">{_image(svg, words("QR code of the address beside it"))}</div>' if svg else ""
    told = words("This design, to be opened and changed: {link}", link=f"<span>{escape(link)}</span>")
    return f"<footer>{code}<p>{told}</p></footer>"
