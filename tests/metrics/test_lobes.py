"""Lobes that hardly pass a level, wherever the samples lie: zeros in closed form, integrals by quadrature."""

import numpy as np
import pytest
from numpy.polynomial import Chebyshev, Polynomial

from simc_core import Loop, Plant, performance, simc
from simc_core.metrics.piece_zeros import INTERVALS, SAMPLES, SLOPE, Turns, crossings
from simc_core.plants.parse import parse_plant
from simc_core.reduction.half_rule import reduced_model
from simc_core.simulation.collocation.elements import NODES_PER_ELEMENT as P
from simc_core.simulation.simulate import settled


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("beside", [1e-2, 1e-4, 1e-8])
@pytest.mark.parametrize("wide", [0.05, 0.3, 0.65, 0.98, 1.3])
def test_both_zeros_of_a_lobe_beside_a_sample(mirrored, beside, wide):
    """(x - a)(b - x)(2 + x): a just before a sample, b behind it, also where the lobe turns behind b's middle."""
    for i in range(2, INTERVALS - 2):
        step = SAMPLES[i + 1] - SAMPLES[i]
        a, b = SAMPLES[i] - beside * step, SAMPLES[i] + wide * step
        if mirrored:
            a, b = -b, -a
        f = (Polynomial([-a, 1.0]) * Polynomial([b, -1.0]) * Polynomial([2.0, 1.0])).convert(kind=Chebyshev).coef
        series, level = np.pad(f, (0, P - len(f)))[None], np.zeros((1, 1))
        turns = crossings(series @ SLOPE, level)
        found = crossings(series, level, Turns(turns.row, turns.interval, turns.x, turns.of(series)))
        rounding = 1e-14 / (b - a)  # of f, over its slope
        assert sorted(found.x) == pytest.approx([a, b], rel=0, abs=rounding)


def test_a_load_response_whose_lobe_passes_the_band_of_two_per_cent_by_a_thousandth_settles_behind_it():
    """Its last way back into the band, by bisection on the response itself, at 8.7031."""
    plant = Plant(3.374, 0.4206, (0.9401, 0.66))
    loop = Loop(plant, simc(reduced_model(plant)))
    course, found = settled(loop), performance(loop).disturbance
    t = np.linspace(2.0, 20.0, 60_001)
    outside = np.abs(course(t)[0, 0, 1]) > 0.02 * abs(found.peak)
    left = np.flatnonzero(outside)[-1]
    assert t[left] <= found.settling_time <= t[left + 1]


def test_an_IAE_whose_error_passes_zero_beside_a_sample():
    """Against Gauss quadrature of |e| over every piece of the response, between its zeros far away."""
    plant = parse_plant("0.208621exp(-1.81145s)/((19.3394s+1)(9.66969s+1)(3.86788s+1)(0.966969s+1))")
    loop = Loop(plant, simc(reduced_model(plant)))
    course, (x, weights) = settled(loop), np.polynomial.legendre.leggauss(2000)
    IAE = ITAE = 0.0
    for begin, length in zip(course.begin, course.length, strict=True):
        t = begin + length / 2 * (x + 1)
        e = length / 2 * weights * np.abs(course(t)[0, 0, 1])
        IAE, ITAE = IAE + e.sum(), ITAE + (t * e).sum()
    found = performance(loop).disturbance
    assert pytest.approx((IAE, ITAE), rel=1e-10) == (found.IAE, found.ITAE)
