"""A report as Markdown and as CSV, and its curves as CSV: for programs, so in English. Pure: no streamlit."""

import csv
from collections.abc import Iterable
from io import StringIO

from pages.common.parts.foreign_text import exact, printable
from pages.common.take_home.proof import QUANTITY, table
from pages.common.take_home.report.record import Report, Row, beginning, plant_rows

FORMULA = ("=", "+", "-", "@")  # with one of these a spreadsheet would begin to compute


def markdown(report: Report) -> str:
    """The report as Markdown, without its figures; what was typed by people stands in code spans."""
    name = f"{exact(report.tag)}: controller settings" if report.tag else "Controller settings"
    lines = [f"# {name}", "", report.made, "", *_rows("Plant", [*plant_rows(report), *report.signals])]
    lines += _rows("Design", [Row("controller", report.how, ""), *report.settings])
    lines += _rows(f"Typed into {report.box}", report.typed) if report.typed else []
    margins = table(report.margins, report.time)
    lines += ["## Margins", "", _line(margins[0]), _line(["---"] * len(margins[0]))]
    lines += [*(_line(map(_cell, row.values())) for row in margins), ""]
    for name, texts in (("What to watch", report.watch), ("Sources", report.sources)):
        lines += [f"## {name}", "", *(f"- {exact(beginning(text))}" for text in texts), ""] if texts else []
    return "\n".join([*lines, "## This design", "", f"<{report.link}>", ""])


def settings_csv(report: Report) -> str:
    """section, name, value, unit: one line for each number."""
    rows = [("plant", "tag", report.tag, ""), ("plant", "transfer function", report.plant, "")]
    rows += [("plant", "from", report.came_from, ""), ("plant", "made", report.made, "")]
    for section, found in (("signals", report.signals), ("design", report.settings), ("typed", report.typed)):
        rows += [(section, *row) for row in found]
    for row in table(report.margins, report.time):
        name = row.pop(QUANTITY)
        rows += [("margins", f"{name}, {column}", text, "") for column, text in row.items()]
    rows += [("watch", "", beginning(text), "") for text in report.watch]
    return _csv(("section", "name", "value", "unit"), [*rows, ("link", "", report.link, "")])


def curves_csv(report: Report) -> str:
    """curve, t, r, d, y, u: every point of every curve, both values where one jumps."""
    rows = [
        (name, *map(repr, map(float, point)))
        for name, found in report.curves.items()
        for point in zip(found.t, found.r, found.d, found.y, found.u, strict=True)
    ]
    names = {"t": report.time, "r": report.y, "d": report.u, "y": report.y, "u": report.u}
    head = [f"{name} [{unit}]" if unit else name for name, unit in names.items()]
    return _csv(("curve", *head), rows, safe=True)


def _csv(head: Iterable[str], rows: Iterable[Iterable[str]], safe: bool = False) -> str:
    """safe: rows are numbers."""
    out = StringIO()
    writer = csv.writer(out, lineterminator="\r\n")
    writer.writerow(map(_harmless, head))
    writer.writerows(rows if safe else (map(_harmless, row) for row in rows))
    return out.getvalue()


def _harmless(text: str) -> str:
    """Text that no spreadsheet takes for a formula; numbers as they are."""
    text = printable(text)
    return f"'{text}" if text.lstrip().startswith(FORMULA) and not _is_number(text) else text


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _rows(name: str, rows: Iterable[Row]) -> list[str]:
    lines = [f"## {name}", "", _line(("name", "value", "unit")), _line(["---"] * 3)]
    return [*lines, *(_line((_cell(row.name), _cell(row.value), _cell(row.unit))) for row in rows), ""]


def _line(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _cell(text: str) -> str:
    return exact(text).replace("|", r"\|") if text else ""
