"""Figures in words: their numbers are those of closed forms, and no figure goes without."""

import ast
import math
import re
from pathlib import Path

import numpy as np
import pytest

from pages.common.parts.figure_words import MOST, in_words
from simc_core import Plant
from simc_core.figures import bode_figure, plant_step_figure
from simc_core.figures.palette import axis, figure, line
from simc_core.plants.step_response import plant_step

PAGES = Path(__file__).parents[2] / "pages"
AXES = axis("t  [min]"), axis("y")


def numbers(words: str) -> list[float]:
    return [float(found) for found in re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", words)]


def test_a_first_order_step_ends_where_its_exponential_does():
    """k (1 - exp(-t/tau1)) at the last instant shown."""
    shown = plant_step_figure(plant_step(Plant(k=2.0, lags=(5.0,))))
    start, begin, end, last = numbers(in_words("Step response", shown))
    assert (start, begin) == (0, 0)
    assert end == pytest.approx(2 * (1 - math.exp(-last / 5)), rel=0.005)  # three digits of the time


def test_both_curves_of_a_bode_diagram_say_which_they_are():
    """A lag of 5: gain k = 2 and phase 0 far below its corner."""
    words = in_words("Bode diagram", bode_figure(Plant(k=2.0, lags=(5.0,))))
    assert re.search(r"G, \|G\|: from (2|1\.99\d?|1\.9) at ω", words)
    assert re.search(r"G, ∠G: from -\d", words)


def test_the_highest_and_the_lowest_point_are_told_where_they_are():
    t = np.linspace(0, 2 * math.pi, 4001)
    words = in_words("A sine", figure([line(t, np.sin(t), "y", "black")], *AXES))
    assert re.search(r"highest 1 at t 1.57, lowest -1 at t 4.71", words)


def test_a_circle_has_ranges_and_a_point_its_place():
    t = np.linspace(0, 2 * math.pi, 401)
    point = {"type": "scatter", "mode": "markers", "x": [-1.0], "y": [0.0], "name": "critical point"}
    words = in_words("Circle", figure([line(np.cos(t), 2 * np.sin(t), "L", "black"), point], *AXES))
    assert "L: t from -1 to 1, y from -2 to 2" in words
    assert "critical point at -1, 0" in words


def test_many_curves_stay_a_few_sentences():
    many = [line([0, 1], [0, i], f"y{i}", "black") for i in range(1, 31)]
    assert in_words("Many", figure(many, *AXES)).endswith(f"and {30 - MOST} more.")


def test_every_figure_of_every_page_is_told():
    calls = [
        (file.name, {word.arg: word.value for word in node.keywords})
        for file in PAGES.rglob("*.py")
        for node in ast.walk(ast.parse(file.read_text()))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "plotly_chart"
    ]
    assert calls
    for name, given in calls:
        assert isinstance(given.get("alt"), ast.Call), name
        assert given["alt"].func.id == "in_words", name
