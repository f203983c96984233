"""Sphinx: the API reference from the docstrings of simc_core, made by `make docs`; what it writes needs no network."""

import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

from sphinx.util.docutils import SphinxDirective

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

import simc_core  # noqa: E402 found only now

project = "simc_core"
release = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
extensions = ["sphinx.ext.autodoc", "numpydoc"]
html_theme = "alabaster"
html_theme_options = {"description": "SIMC tuning of PI/PID controllers with exact dead time"}
html_show_sourcelink = False
exclude_patterns = ["_build"]
autodoc_member_order = "bysource"
numpydoc_show_class_members = False


def rules() -> Iterator[tuple[str, ...]]:
    """A row for each rule, below the heads of the columns."""
    yield "name", "rule", "source", "controllers", "made from", "parameter", "domain"
    for rule in simc_core.RULES.values():
        knob = f"``{rule.knob}``" if rule.knob else ""
        yield f"``{rule.key}``", rule.title, rule.source, ", ".join(rule.kinds), rule.needs, knob, rule.domain


def boxes() -> Iterator[tuple[str, ...]]:
    """A row for each box, below the heads of the columns."""
    yield "name", "maker", "box", "form", "fields", "source"
    for box in simc_core.BOXES.values():
        fields = ", ".join(f"``{field.name}``" for field in box.fields)
        yield f"``{box.key}``", box.maker, box.title, box.form, fields, box.source


class Catalogue(SphinxDirective):
    """RULES or BOXES as a table."""

    required_arguments = 1

    def run(self) -> list:
        lines = [".. list-table::", "   :header-rows: 1", ""]
        for row in {"RULES": rules, "BOXES": boxes}[self.arguments[0]]():
            lines += [f"   {' ' if i else '*'} - {cell}" for i, cell in enumerate(row)]
        self.state_machine.insert_input([*lines, ""], f"simc_core.{self.arguments[0]}")
        return []


def setup(app) -> None:
    """The directive ``catalogue``."""
    app.add_directive("catalogue", Catalogue)
