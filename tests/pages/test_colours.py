"""Colours have one owner, and what is written in them can be read: contrast as WCAG 2.2 has it, 1.4.3 and 1.4.11."""

import re
import tomllib
from pathlib import Path

import pytest

from simc_core.figures import palette

ROOT = Path(__file__).parents[2]
OWNER = ROOT / "simc_core" / "figures" / "palette.py"
THEME = tomllib.loads((ROOT / ".streamlit" / "config.toml").read_text())["theme"]
PAGES = {name: THEME[name]["backgroundColor"] for name in ("light", "dark")}
CAPTION = 0.6  # opacity of captions in Streamlit
HEX = re.compile(r"#(?:[0-9A-Fa-f]{8}|[0-9A-Fa-f]{6}|[0-9A-Fa-f]{3,4})\b")


def rgb(color: str) -> tuple[float, ...]:
    """Red, green, blue from 0 to 1."""
    return tuple(int(color[i : i + 2], 16) / 255 for i in (1, 3, 5))


def contrast(one: tuple[float, ...], other: tuple[float, ...]) -> float:
    """(L1 + 0.05)/(L2 + 0.05) of the relative luminances, as WCAG 2.2 defines them."""

    def luminance(color):
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in color]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def over(color: str, page: str, opacity: float) -> tuple[float, ...]:
    """The colour as seen on the page."""
    return tuple(opacity * c + (1 - opacity) * p for c, p in zip(rgb(color), rgb(page), strict=True))


def test_the_formula_gives_the_known_ends():
    assert contrast(rgb("#000000"), rgb("#FFFFFF")) == pytest.approx(21.0)
    assert contrast(rgb("#767676"), rgb("#FFFFFF")) == pytest.approx(4.54, abs=0.005)  # the lightest grey that passes


def test_no_colour_stands_outside_the_palette():
    files = [file for room in ("simc_core", "pages") for file in (ROOT / room).rglob("*") if file.is_file()]
    read = [file for file in files if file.suffix in (".py", ".js", ".css", ".html") and "vendor" not in file.parts]
    assert len(read) > 100
    assert {file.name: HEX.findall(file.read_text()) for file in read if HEX.search(file.read_text())}.keys() == {
        OWNER.name
    }


def test_the_theme_takes_its_colours_of_curves_from_the_palette():
    for name in PAGES:
        assert THEME[name]["chartCategoricalColors"] == [palette.Y, palette.U, palette.D, palette.REDUCED]
    assert THEME["light"]["primaryColor"] == palette.Y


@pytest.mark.parametrize("name", PAGES)
def test_small_text_has_four_and_a_half_to_one(name):
    page, side, text = (THEME[name][f"{part}olor"] for part in ("backgroundC", "secondaryBackgroundC", "textC"))
    for background in (page, side):
        assert contrast(rgb(text), rgb(background)) >= 7
        assert contrast(over(text, background, CAPTION), rgb(background)) >= 4.5
    assert contrast(rgb("#FFFFFF"), rgb(THEME[name]["primaryColor"])) >= 4.5  # words on the primary button
    assert THEME[name]["linkColor"] == palette.CHOSEN[name == "dark"]
    chosen_on = over(THEME[name]["primaryColor"], page, 0.1)  # the ground of a chosen segment
    assert contrast(rgb(palette.CHOSEN[name == "dark"]), chosen_on) >= 4.5


@pytest.mark.parametrize("page", PAGES.values())
def test_curves_pinned_ones_too_have_three_to_one(page):
    curves = [palette.Y, palette.U, palette.D, palette.R, palette.REDUCED, palette.INNER, palette.S, palette.ALARM]
    for color in [*curves, *(shade for shades in palette.PIN_SHADES.values() for shade in shades)]:
        assert contrast(rgb(color), rgb(page)) >= 3, color


def test_every_variable_that_styles_and_scripts_name_is_written():
    written = set(re.findall(r"--simc-[a-z0-9-]+(?=:)", palette.css_variables(":root")))
    files = [file for file in (ROOT / "pages").rglob("*") if file.suffix in (".js", ".css", ".py")]
    named = {name for file in files for name in re.findall(r"--simc-[a-z][a-z0-9-]*", file.read_text())}
    assert named
    assert named <= written
