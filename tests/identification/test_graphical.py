"""Graphical methods on responses for which they are exact, and where they are not."""

import numpy as np
import pytest

from simc_core import NotIdentifiable, Trend, graphical_methods, identify
from tests.identification.simulated import rise, two_lags


def trend(step, end=150.0, n=6001, noise=0.0) -> Trend:
    t = np.linspace(0, end, n)
    y = 20 - 1.5 * step(t - 14) + noise * np.random.default_rng(0).normal(size=n)
    return Trend(t, y, [40.0, 41.0], t_u=[0.0, 10.0])


@pytest.mark.parametrize(("method", "tolerance"), [("two-point", 0.01), ("tangent", 0.15), ("areas", 0.02)])
def test_a_first_order_response_without_noise(method, tolerance):
    """Smoothing the slope costs the tangent some of its steepness; the others are exact but for the sampling."""
    found = graphical_methods(trend(lambda t: rise(t, 8.0), end=100.0))[method]
    assert found.k == pytest.approx(-1.5, rel=0.01)
    assert found.theta == pytest.approx(4, rel=2 * tolerance)
    assert found.tau1 == pytest.approx(8, rel=tolerance)


def test_areas_keep_the_sum_of_dead_time_and_lags():
    found = graphical_methods(trend(lambda t: two_lags(t, 9.0, 5.0)))["areas"]
    assert found.theta + found.tau1 == pytest.approx(4 + 9 + 5, rel=0.01)


def test_the_tangent_of_a_second_order_response_gives_too_long_a_lag():
    """tau1/(1 - x) at the inflection is longer than either lag, which is what makes the method sluggish."""
    assert graphical_methods(trend(lambda t: two_lags(t, 9.0, 5.0)))["tangent"].tau1 > 14


def test_noise_that_the_fit_does_not_mind_misleads_the_ruler():
    noisy = trend(lambda t: rise(t, 8.0), noise=0.08, n=600)
    ruler = graphical_methods(noisy)
    fitted = identify(noisy).parameters
    assert abs(fitted["theta"] - 4) < 0.6
    assert abs(fitted["theta"] - 4) < min(abs(model.theta - 4) for model in ruler.values())


def test_a_response_that_is_too_short_is_refused():
    with pytest.raises(NotIdentifiable, match="At least 10 samples"):
        graphical_methods(Trend(range(20), range(20), [0, 1], t_u=[0, 15]))
