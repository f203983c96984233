"""The honest no on the page From data: what the record is, in words, and no settings from it."""

import re

import numpy as np
import pytest

from tests.identification.simulated import closed_loop, rise
from tests.pages.tools import run_page, texts

N = 600
T = np.arange(N) * 0.5
NOISE = 0.02 * np.random.default_rng(0).normal(size=N)


def loop(setpoint, load):
    return closed_loop(N, 0.5, 2.0, 3.2, 12.0, 0.9, 12.0, setpoint, NOISE, load)


def table(**columns) -> str:
    rows = zip(*columns.values(), strict=True)
    return "\n".join([";".join(columns), *(";".join(f"{value:.4f}" for value in row) for row in rows)]) + "\n"


STEP = np.where(T >= 20, 1.0, 0.0)
LOADED = loop(np.zeros(N), np.where(T > 100, 1.0, 0.0))
MOVED = loop(STEP, np.zeros(N))
RISE = 50 + 2 * rise(T - 24, 12.0) + NOISE
BACK = np.where(np.arange(N) < 300, T, T - 150)
CASES = {
    "OP never moves": (table(t=T, PV=RISE, OP=np.full(N, 40.0)), "OP never moves"),
    "no OP": (table(t=T, SP=np.full(N, 50.0), PV=RISE), "No column is the controller output"),
    "load at constant set point": (table(t=T, SP=LOADED.r + 50, PV=LOADED.y + 50, OP=LOADED.u + 40), "loop was closed"),
    "closed at constant set point": (
        table(t=T, PV=loop(np.zeros(N), NOISE).y, OP=loop(np.zeros(N), NOISE).u),
        "closed",
    ),
    "OP and SP are one": (table(t=T, SP=STEP, PV=MOVED.y, OP=STEP), "same series"),
}


@pytest.mark.parametrize("case", CASES)
def test_it_is_refused_and_nothing_is_offered(case):
    text, said = CASES[case]
    app = run_page("from_data")
    app.text_area(key="trend_paste_0").set_value(text)
    next(button for button in app.button if button.label == "Read").click().run()
    assert not app.exception
    assert any(said in item.value for item in app.error), texts(app)
    assert not [button for button in app.button if str(button.key).startswith("tune")]


WARNED = {
    "SP taken for OP": (table(t=T, PV=MOVED.y, OP=STEP), "are they the set point?"),
    "time goes backwards": (table(t=BACK, PV=RISE, OP=40 + STEP), "backwards|begins anew|sorted"),
    "the actuator did not follow": (
        table(t=T, PV=RISE, OP=40 + STEP + (T >= 150)),
        "did not follow|differs from move to move",
    ),
    "two inputs at once": (table(t=T, PV=RISE, OP=40 + STEP, Feed=100 + 10 * (T >= 21)), "moved at once with OP"),
}


@pytest.mark.parametrize("case", WARNED)
def test_there_are_numbers_with_the_warning_on_them(case):
    text, said = WARNED[case]
    app = run_page("from_data")
    app.text_area(key="trend_paste_0").set_value(text)
    next(button for button in app.button if button.label == "Read").click().run()
    assert not app.exception
    shown = texts(app) + " ".join(item.value for item in app.info)
    assert re.search(said, shown), shown
