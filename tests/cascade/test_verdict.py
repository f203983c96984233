"""Whether a cascade pays is told with all its numbers, not with the best of them."""

import numpy as np
import pytest

from simc_core import Plant, margins, performance, simc_cascade
from simc_core.cascade.by_simc import single_loop
from simc_core.cascade.verdict import CascadeVerdict, cascade_verdict

FAST, SLOW = Plant(2.2, 3, (20,)), Plant(0.9, 20, (180,))


def compared(primary, secondary):
    design = simc_cascade(primary, secondary, inner="PID", outer="PID")
    single = single_loop(primary, secondary)
    peaks = (margins(each).Ms for each in (design.loop.outer_loop, design.loop.inner_loop))
    return cascade_verdict(performance(design.loop), *peaks, performance(single), margins(single.outer_loop).Ms)


def test_an_inner_loop_slower_than_the_outer_one_does_not_pay():
    """Load d2 alone is answered 2.9 times better; r and d1 are not, and the loop is less robust."""
    found = compared(FAST, SLOW)
    assert pytest.approx((82, 130, 31.8), rel=0.01) == found.IAE
    assert found.IAE_single == pytest.approx((80.3, 107, 91.1), rel=0.01)
    x = np.linspace(0.5, 3, 100_000)  # theta omega; the PID cancels both lags: e^{-theta s}/(2 theta s), filtered
    S = 1 / np.abs(1 + np.exp(-1j * x) / (2j * x * (1 + 0.05j * x)))
    assert (found.Ms_outer, found.Ms_single) == pytest.approx((2.18, S.max()), abs=0.006)
    assert not found.pays
    assert found.text.startswith("The cascade does not pay: load d2 2.9 times better, but worse: IAE d1, outer Ms.")
    for number in ("82", "130", "107", "31.8", "91.1", "2.18", "1.63"):
        assert number in found.text


def test_a_fast_inner_loop_pays():
    """The jacket: 4.64 instead of 91.1."""
    found = compared(Plant(2.2, 20, (180,)), Plant(0.9, 3, (20,)))
    assert (found.IAE[2], found.IAE_single[2]) == pytest.approx((4.64, 91.1), rel=0.01)
    assert found.pays, found.text
    assert found.text.startswith("The cascade pays: load d2 20 times better.")


@pytest.mark.parametrize(
    ("IAE", "peaks", "worse"),
    [
        ((10, 10, 5), (1.6, 1.6), ()),
        ((10, 10, 12), (1.6, 1.6), ("IAE d2",)),
        ((12, 10, 5), (1.6, 1.6), ("IAE r",)),
        ((10, 12, 5), (2.4, 1.6), ("IAE d1", "outer Ms")),
        ((10, 10, 5), (1.6, 3.0), ("inner Ms",)),
    ],
)
def test_everything_that_is_worse_is_named(IAE, peaks, worse):
    found = CascadeVerdict(IAE, (10, 10, 10), *peaks, 1.6)
    assert found.worse == worse
    assert found.pays == (not worse)
    assert all(name in found.text for name in worse)
