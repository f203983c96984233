"""The live instruments: sliders, figures and panels in the browser, exact numbers from here.

While a slider moves, the browser reads the table it holds (table.py, cascade_table.py, table.js) and asks nobody. On
release the design changes, the script runs, and what it sends back replaces the numbers that were read between rows.
Tables and exact numbers travel apart: an unchanged table is a reference of a few bytes to what the browser has in its
cache. uPlot draws (uplot.LICENSE); measured against plotly.js and a canvas of our own, see benchmarks/ui.py.
"""

from pages.common.live.cascade.instrument import cascade_instrument
from pages.common.live.components import staged
from pages.common.live.hand.instrument import hand_instrument, put_back
from pages.common.live.plane.instrument import Ground, plane_instrument
from pages.common.live.tuning.instrument import as_choice, tuning_instrument

__all__ = [
    "Ground",
    "as_choice",
    "cascade_instrument",
    "hand_instrument",
    "plane_instrument",
    "put_back",
    "staged",
    "tuning_instrument",
]
