"""Tracking times by their closed forms."""

import math

import pytest

from simc_core import IController, ParallelPid, SeriesPid
from simc_core.controllers.tracking import tracking_time


def test_with_proportional_action():
    assert tracking_time(SeriesPid(4.0, 8.0), k=2.0) == 8.0
    assert tracking_time(SeriesPid(4.0, 8.0, 2.0), k=2.0) == pytest.approx(4.0)  # ideal: tau_I = 10, tau_D = 1.6
    assert tracking_time(SeriesPid(4.0, math.inf), k=2.0) == math.inf


def test_without_it_the_time_is_that_of_the_loop():
    assert tracking_time(IController(0.25), k=2.0) == 2.0  # K_I k/s
    assert tracking_time(IController(-0.02), k=-2.0, integrators=1) == pytest.approx(5.0)  # 0.04/s^2
    assert tracking_time(ParallelPid(0.0, 0.5, 4.5), k=7.0) == pytest.approx(3.0)  # sqrt(Kd/Ki)
