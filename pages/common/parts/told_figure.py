"""A figure in the language in use: titles, names, labels, and the decimal sign on its axes."""

from typing import Any

from pages.common.words import language, translated
from pages.common.words.catalogues import ENGLISH
from simc_core.figures import Figure
from simc_core.wording import Numeral, Text

SEPARATORS = ",\N{NO-BREAK SPACE}"  # of decimals and of thousands, as plotly asks for them


def told_figure(figure: Figure) -> Figure:
    """The same figure with every Text told; what came is left as it was."""
    if language() == ENGLISH:
        return figure
    return _told({**figure, "layout": figure["layout"] | {"separators": SEPARATORS}})


def _told(node: Any) -> Any:
    if isinstance(node, Text | Numeral):
        return translated(node)
    if isinstance(node, dict):
        return {name: _told(each) for name, each in node.items()}
    if isinstance(node, list | tuple):
        return [_told(each) for each in node]
    return node
