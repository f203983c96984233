"""Many loops at once: equal to one at a time, and none changes another."""

import math

import numpy as np
import pytest

from simc_core import (
    IdealPid,
    InvalidParameter,
    Loop,
    Margins,
    Plant,
    SeriesPid,
    Stability,
    count_unstable,
    margins,
    margins_many,
    stability_many,
)
from simc_core.certificate.characteristic import characteristic
from simc_core.certificate.winding import windings
from simc_core.sensitivity.crossings import search, search_many
from simc_core.sensitivity.log_response import FactoredResponse


def random_plant(rng: np.random.Generator) -> Plant:
    """Unstable, integrating, oscillating, with RHP zeros, without dead time: a fifth or so of each."""
    theta = 0.0 if rng.random() < 0.2 else 10 ** rng.uniform(-1.5, 0.7)
    lags = 10 ** rng.uniform(-1, 1, rng.integers(1, 4))
    gain = 10 ** rng.uniform(-0.5, 0.5)
    if rng.random() < 0.25:
        lags[0], gain = -lags.max() - 4 * theta, -gain
    leads = rng.choice([-1, 1], rng.integers(0, 2)) * 10 ** rng.uniform(-1.5, 0.3)
    pairs = [(10 ** rng.uniform(-0.5, 0.5), 10 ** rng.uniform(-2, 0))] if rng.random() < 0.25 else []
    return Plant(gain, theta, lags, leads, int(rng.random() < 0.2), pairs)


def family(rng: np.random.Generator, size: int) -> list[Loop]:
    """One plant, controllers of one form; some cancel a lag. Unfiltered derivative action makes neutral loops."""
    plant = random_plant(rng)
    form, filtered = rng.choice([SeriesPid, IdealPid]), rng.choice([0.0, 0.1])
    tau_D = rng.choice([0.0, 10 ** rng.uniform(-1, 0.3)])
    times = np.abs(plant.lags).max() * 10 ** rng.uniform(-0.5, 1, size)
    times[rng.random(size) < 0.3] = np.abs(plant.lags).max()
    gains = 10 ** rng.uniform(-1.5, 1.5, size)
    return [Loop(plant, form(Kc, tau_I, tau_D, filtered * tau_D)) for Kc, tau_I in zip(gains, times, strict=True)]


def judged(loop: Loop) -> Stability | str:
    """The verdict on one loop alone, or why there is none."""
    try:
        return count_unstable([loop.L])
    except InvalidParameter as refused:
        return str(refused)


def assert_equal(found: Margins, expected: Margins) -> None:
    for name in Margins.__slots__:
        assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=1e-10, nan_ok=True), name


def test_random_families():
    rng = np.random.default_rng(60)
    seen = {"stable": 0, "unstable": 0, "neutral": 0, "no dead time": 0, "integrating": 0, "unstable plant": 0}
    for _ in range(60):
        loops = [loop for loop in family(rng, 12) if isinstance(judged(loop), Stability)]
        verdicts = stability_many(loops)
        assert verdicts == [judged(loop) for loop in loops]
        for loop, verdict, found in zip(loops, verdicts, margins_many(loops), strict=True):
            assert_equal(found, margins(loop))
            seen[verdict.verdict] += 1
            seen["neutral"] += 0 < verdict.neutral < 1
            seen["no dead time"] += loop.plant.theta == 0
            seen["integrating"] += loop.plant.integrators > 0
            seen["unstable plant"] += loop.plant.unstable_poles > 0 and verdict.verdict == "stable"
    assert min(seen.values()) >= 10, seen


def test_no_loop_changes_another():
    """Whatever stands beside them: other plants, other forms, loops that are unstable, marginal or neutral."""
    rng = np.random.default_rng(61)
    loops = [loop for _ in range(8) for loop in family(rng, 3) if isinstance(judged(loop), Stability)]
    loops.append(Loop(Plant(1.0, 1.0), SeriesPid(0.999, math.inf)))
    verdicts, found = stability_many(loops), margins_many(loops)
    for keep in (slice(0, 5), slice(3, None), slice(None, None, 3), slice(None, None, -1)):
        assert stability_many(loops[keep]) == verdicts[keep]
        for one, other in zip(margins_many(loops[keep]), found[keep], strict=True):
            assert_equal(one, other)


def test_the_limit_of_stability_inside_a_family():
    """e^{-theta s}/((tau_c + theta) s) at gains about pi/2, and exactly there."""
    offs = (-1e-2, -1e-9, -1e-12, 0.0, 1e-9, 1e-2)
    loops = [Loop(Plant(1.0, 1.0, (8.0,)), SeriesPid(8 * math.pi / 2 * (1 + off), 8.0)) for off in offs]
    expected = [("stable", 0)] * 3 + [("marginal", 0)] + [("unstable", 2)] * 2
    assert [(found.verdict, found.unstable_poles) for found in stability_many(loops)] == expected
    limits = [1 / (1 + off) for off in offs[:2]]
    assert [found.GM for found in margins_many(loops)[:2]] == pytest.approx(limits, rel=1e-13)
    assert [found.stable for found in margins_many(loops)] == [True] * 3 + [False] * 3


def test_first_order_closed_form_for_a_whole_family():
    """GM = (pi/2)(tau_c/theta + 1), PM = pi/2 - theta/(tau_c + theta) [theory.md, section 3], for 500 tau_c."""
    ratio = np.geomspace(0.05, 50, 500)
    loops = [Loop(Plant(2.0, 3.0, (5.0,)), SeriesPid(5 / (2 * 3 * (1 + r)), 5.0)) for r in ratio.tolist()]
    found = margins_many(loops)
    assert [m.GM for m in found] == pytest.approx(math.pi / 2 * (ratio + 1), rel=1e-13)
    assert [m.PM_deg for m in found] == pytest.approx(90 - np.degrees(1 / (ratio + 1)), rel=1e-13)


def test_verdicts_that_are_known_are_taken():
    loops = family(np.random.default_rng(62), 6)
    verdicts = stability_many(loops)
    for one, other in zip(margins_many(loops, verdicts), margins_many(loops), strict=True):
        assert_equal(one, other)
    assert not any(m.stable for m in margins_many(loops, [Stability("unstable", 1)] * len(loops)))


def test_work_grows_with_the_number_of_loops_and_not_faster():
    """Segments of the certificate and crossings of each loop are those of the loop alone."""
    loops = family(np.random.default_rng(63), 300)
    functions = [characteristic([loop.L]) for loop in loops]
    assert windings(functions)[::25] == [windings([f])[0] for f in functions[::25]]
    responses = [FactoredResponse(loop.L) for loop in loops]
    for many, response in zip(search_many(responses)[::25], responses[::25], strict=True):
        alone = search(response)
        for name in ("gain_omega", "phase_omega", "S_omega", "T_omega"):
            assert getattr(many, name) == pytest.approx(getattr(alone, name), rel=1e-9)


def test_none_and_one():
    loop = Loop(Plant(1.0, 1.0, (8.0,)), SeriesPid(4.0, 8.0))
    assert stability_many([]) == []
    assert margins_many([]) == []
    assert margins_many([loop]) == [margins(loop)]


def test_an_ill_posed_loop_is_named():
    with pytest.raises(InvalidParameter, match=r"1 \+ L\(inf\)"):
        stability_many([Loop(Plant(-1.0), SeriesPid(Kc, math.inf)) for Kc in (0.5, 1.0)])
