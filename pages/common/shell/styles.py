"""The look of all pages: the colours of the palette, and the style.css of each room beside what it dresses."""

from functools import cache
from pathlib import Path

from simc_core.figures import palette

ROOMS = Path(__file__).parents[1]


@cache
def styles() -> str:
    """One `<style>` for all pages."""
    sheets = [file.read_text(encoding="utf-8") for file in sorted(ROOMS.glob("*/style.css"))]
    return "\n".join(["<style>", palette.css_variables(":root"), *sheets, "</style>"])
