"""The other experiments of the page From data: set-point overshoot, oscillation, relay."""

import re

import numpy as np
import pytest

from tests.pages.from_data import experiment
from tests.pages.tools import run_page, texts


def test_the_published_example_of_the_overshoot_experiment():
    """[SS10] E2: Kc 0.919 and tau_I 3.46 from Kc0 1.5, first peak 0.7816 at 4.446, first minimum 0.5443."""
    given = {"Kc0": "1.5", "setpoint": "1", "peak": "0.7816", "lowest": "0,5443", "peak_time": "4.446"}
    app = experiment(
        run_page("from_data"),
        "Set-point overshoot",
        **{f"experiment_overshoot_{name}": text for name, text in given.items()},
    )
    Kc, tau_I = map(float, re.findall(r"\*\*([\d.]+)\*\*", texts(app))[:2])
    assert Kc == pytest.approx(0.919, abs=0.0006)
    assert tau_I == pytest.approx(3.46, abs=0.006)


def test_an_overshoot_that_nobody_has_a_formula_for_is_refused():
    given = {"Kc0": "1.5", "setpoint": "1", "peak": "2", "lowest": "0.1", "peak_time": "4"}
    app = experiment(
        run_page("from_data"),
        "Set-point overshoot",
        **{f"experiment_overshoot_{name}": text for name, text in given.items()},
    )
    assert app.error
    assert "Tune this model" not in [button.label for button in app.button]


def test_a_slow_oscillation_asks_for_more_integral_time():
    """P0 = 40, tau_I = 4: F = (40/4)^2/pi^2 = 10.1, all of it on tau_I."""
    given = {"Kc": "0.5", "tau_I": "4", "period": "40"}
    app = experiment(
        run_page("from_data"),
        "Loop that oscillates",
        **{f"experiment_oscillation_{name}": text for name, text in given.items()},
    )
    assert re.search(r"\*\*40\.5\d*\*\*", texts(app))


def test_a_relay_test_of_the_present_plant():
    """1/((s+1)(10s+1)) e^{-0.3s}: omega_180 1.8402, gain there 0.02591; the relay shows a period of 3.5631."""
    app = experiment(
        run_page("from_data", plant="exp(-0.3s)/((s+1)(10s+1))"), "Relay test", experiment_relay_amplitude="1"
    )
    table = app.dataframe[-1].value
    assert float(table["exact"][0]) == pytest.approx(1 / 0.02591, rel=2e-3)
    assert float(table["exact"][1].split()[0]) == pytest.approx(2 * np.pi / 1.8402, rel=1e-3)
    assert float(table["describing function"][1].split()[0]) == pytest.approx(3.5631, rel=1e-3)


def test_what_is_typed_into_an_experiment_stays():
    app = experiment(run_page("from_data"), "Relay test", experiment_relay_amplitude="-1")
    assert app.error or "Still needed" in texts(app)
    assert app.text_input(key="experiment_relay_amplitude").value == "-1"
