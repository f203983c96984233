"""The sentence about a change of settings: its numbers are those of the two loops."""

import pytest

from simc_core import FirstOrderDelay, IdealPid, Loop, Plant, SeriesPid, margins, performance, simc
from simc_core.studies.retune import what_changes

HEATER = Plant(2.2, 20.0, (180.0,))


def judged(controller):
    loop = Loop(HEATER, controller)
    found = margins(loop)
    return found, performance(loop) if found.stable else None


def test_the_heater_that_a_process_engineer_brought():
    """Load IAE of one sign is tau_I/Kc: 240/1.2 = 200 now; SIMC at tau_c = theta has Kc 180/(2.2 40), tau_I 160."""
    now, new = IdealPid(1.2, 240.0), simc(FirstOrderDelay(2.2, 20.0, 180.0))
    _, measured = judged(now)
    assert pytest.approx(200.0, rel=1e-9) == measured.disturbance.IAE
    assert (new.tau_I / new.Kc) == pytest.approx(160 / (180 / 88))
    said = what_changes(judged(now), judged(new))
    assert said.startswith("Load IAE 2.6 times smaller, ")
    assert said.endswith("; Ms 1.29 → 1.6.")


def test_without_integrals_only_the_peaks_are_compared():
    (peaks, _), new = judged(IdealPid(1.2, 240.0)), judged(simc(FirstOrderDelay(2.2, 20.0, 180.0)))
    assert what_changes((peaks, None), new) == "Integrals of the error cannot be compared; Ms 1.29 → 1.6."


def test_the_same_settings_change_nothing():
    same = judged(IdealPid(1.2, 240.0))
    assert what_changes(same, same) == "Load IAE as before, set-point IAE as before; Ms 1.29 → 1.29."


def test_a_loop_that_is_not_stable_has_no_figures_to_compare():
    stable, not_stable = judged(IdealPid(1.2, 240.0)), judged(SeriesPid(50.0, 240.0))
    assert what_changes(stable, not_stable) == "With the new settings the loop is not stable; without it is."
    assert what_changes(not_stable, stable).startswith("The loop is not stable; with the new settings it is")


def test_a_changed_plant_is_not_called_new_settings():
    settings = IdealPid(1.2, 240.0)
    slower = Loop(Plant(2.2, 800.0, (180.0,)), settings)
    said = what_changes(judged(settings), (margins(slower), None), "this change of the plant")
    assert said == "With this change of the plant the loop is not stable; without it is."
