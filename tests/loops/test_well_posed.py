"""Loops without dead time that answer themselves at once: everything refuses the same ones in the same words."""

import re

import pytest

from simc_core import (
    Actuation,
    InvalidParameter,
    Loop,
    NestedLoops,
    Plant,
    Scenario,
    SeriesPid,
    margins,
    performance,
    simulate,
    stability,
)
from simc_core.certificate.poles import rightmost
from simc_core.interop import closed_loop

WORDS = re.escape("1 + L(inf) must not be 0 in a loop without dead time, found 0: u is not defined")
LOOP = Loop(Plant(-1.0), SeriesPid(1.0, 8.0))  # L = -(8 s + 1)/(8 s)
NESTED = NestedLoops((LOOP.plant,), (LOOP.controller,))
LIMITED = Scenario(t_end=5.0, actuation=Actuation(u_max=1.0))


@pytest.mark.parametrize("function", [stability, margins, performance, simulate])
@pytest.mark.parametrize("loop", [LOOP, NESTED])
def test_the_loop_is_refused_wherever_it_is_given(function, loop):
    with pytest.raises(InvalidParameter, match=WORDS):
        function(loop)


def test_an_actuator_or_another_library_does_not_help():
    with pytest.raises(InvalidParameter, match=WORDS):
        simulate(LOOP, LIMITED)
    with pytest.raises(InvalidParameter, match=WORDS):
        closed_loop(LOOP)
    assert rightmost(LOOP.L).size == 0


def test_any_other_gain_makes_it_a_loop():
    """L = -K (8 s + 1)/(8 s): 1 + L = 0 at s = K/(8 (1 - K)) alone."""
    for K, verdict in ((0.999, "unstable"), (1.001, "stable"), (-0.5, "stable")):
        assert stability(Loop(Plant(-1.0), SeriesPid(K, 8.0))).verdict == verdict
