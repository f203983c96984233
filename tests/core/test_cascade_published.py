"""The paper's cascade pairs [PSB]: parameters at the printed lambda, and from the specified Ms."""

import pytest

from simc_core import Plant, margins
from simc_core.cascade_design import synthesis_cascade

PAIR_1 = (Plant(2, 2, (5,)), Plant(1, 1, (2, 3)))
PAIR_6 = (Plant(2, 2, (20,)), Plant(-1, 1, (-20,)))
PAIR_10 = (Plant(1, 0.7, integrators=2), Plant(1, 0.3, (1,)))
# pair, lambda inner and outer, kind outside, outer (k, ki, kd), inner (k, ki, kd), Ms outer and inner as printed
ROWS = {
    "1a": (PAIR_1, 1.04275, 2.05, "PID", (0.5524, 0.1061, 0.4884), (3.3928, 0.8250, 3.7773), 2.0, 2.0),
    "1b": (PAIR_1, 1.04275, 2.77, "PI", (0.3788, 0.0763, 0.0), (3.3928, 0.8250, 3.7773), 1.8, 2.0),
    "6a": (PAIR_6, 1.5293, 3.67, "PI", (1.3709, 0.1479, 0.0), (15.614, 3.2769, 5.8002), 2.0, 2.0),
    "10a": (PAIR_10, 0.28255, 1.17, "PID", (0.2086, 0.0305, 0.6076), (2.9959, 4.0580, 0.3078), 3.05, 2.0),
}


@pytest.mark.parametrize("row", ROWS)
def test_settings_and_peaks_at_the_printed_lambda(row):
    pair, inner, outer, kind, Ca, Cb, Msa, Msb = ROWS[row]
    design = synthesis_cascade(*pair, Msb, Msa, outer=kind, lambda_inner=inner, lambda_outer=outer)
    for got, printed in ((design.outer, Ca), (design.inner, Cb)):
        # 1e-3 of the value, or half a printed digit where that is more
        assert (got.Kp, got.Ki, got.Kd) == pytest.approx(printed, rel=1e-3, abs=5.1e-5)
    assert margins(design.loop.outer_loop).Ms == pytest.approx(Msa, abs=0.01)
    assert margins(design.loop.inner_loop).Ms == pytest.approx(Msb, abs=0.01)


@pytest.mark.parametrize("row", ROWS)
def test_settings_from_the_specified_Ms(row):
    """The authors rounded lambda: 1.5 % [cascade.md]."""
    pair, _, _, kind, Ca, Cb, Msa, Msb = ROWS[row]
    design = synthesis_cascade(*pair, Msb, Msa, outer=kind)
    for got, printed in ((design.outer, Ca), (design.inner, Cb)):
        assert (got.Kp, got.Ki, got.Kd) == pytest.approx(printed, rel=0.015, abs=5.1e-5)
