"""Figures reach the browser as plotly itself would write them, which also checks every node of them."""

import json

import pytest

from pages.common.from_data import figure
from pages.common.parts import panel

from .tools import run_page

PAGES = {
    "plant": ("plant", ""),
    "half rule": ("half_rule", "Bode", "comparison"),
    "responses": ("tuning", "Figures"),
    "open loop": ("tuning", "Bode of L"),
    "model error": ("tuning", "Model error"),
    "as built": ("tuning", "As built"),
    "rules": ("rules", ""),
    "cascade": ("cascade", "Figures", "cascade_views"),
    "windup": ("cascade", "Windup", "cascade_views"),
    "record": ("from_data", ""),
    "auto-tuning": ("from_data", "Auto-tuning", "ways"),
}
RECORD = {"example": "noisy", "begin": "10.0", "bad": "100~120"}


def drawn(page: str, *view: str) -> list[dict]:
    here = {"plant": "2 exp(-3s)/((20s+1)(4s+1))", "noise": "0.02", "unit": "min", "PV_unit": "<b>"}
    app = run_page(page, *view, **(RECORD if page == "from_data" else here))
    return [without_nothing(json.loads(chart.proto.spec)) for chart in app.get("plotly_chart")]


def without_nothing(figure: dict) -> dict:
    """plotly leaves out an empty list of annotations, which says the same."""
    return figure | {"layout": {name: each for name, each in figure["layout"].items() if each != []}}


@pytest.mark.parametrize("where", PAGES)
def test_every_figure_is_what_plotly_makes_of_it(monkeypatch, where):
    ours = drawn(*PAGES[where])
    for room in (panel, figure):
        monkeypatch.setattr(room, "ReadyFigure", lambda drawn: drawn)
    assert ours == drawn(*PAGES[where])
    assert ours
