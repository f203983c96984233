"""Gain schedules: the peaks between rows of an independent program, and settings worked out by hand."""

import math

import numpy as np
import pytest

from simc_core import (
    FirstOrderDelay,
    GainSchedule,
    IController,
    IdealPid,
    IntegratingDelay,
    InvalidParameter,
    Loop,
    ParallelPid,
    SecondOrderDelay,
    SeriesPid,
    margins,
    simc,
)

VALUES = (20, 50, 80)
MODELS = (FirstOrderDelay(1, 4, 20), FirstOrderDelay(2, 3, 15), FirstOrderDelay(5, 2, 8))
Kc, TAU_I = (2.5, 1.25, 0.4), (20, 15, 8)


def peaks(schedule, settings, gain="linear"):
    """Ms at 121 points under settings that are made here."""
    return np.array([Ms(schedule.model(x, gain), settings(x)) for x in np.linspace(20, 80, 121)])


def Ms(model, controller):
    found = margins(Loop(model.plant, controller))
    return found.Ms if found.stable else math.inf


def test_settings_at_the_rows_are_those_of_the_rule():
    for between in ("model", "PB"):
        schedule = GainSchedule(VALUES, MODELS, between=between)
        for x, gain, time in zip(VALUES, Kc, TAU_I, strict=True):
            assert schedule.settings(x) == SeriesPid(gain, time)
        assert schedule.settings(-100) == SeriesPid(2.5, 20)
        assert schedule.settings(1000) == SeriesPid(0.4, 8)


def test_half_way_the_band_and_the_integral_time_are_half_way():
    found = GainSchedule(VALUES, MODELS, between="PB").settings(65)
    assert 1 / found.Kc == pytest.approx((1 / 1.25 + 1 / 0.4) / 2)
    assert found.tau_I == pytest.approx(11.5)
    assert GainSchedule(VALUES, MODELS).settings(65) == simc(FirstOrderDelay(3.5, 2.5, 11.5))


@pytest.mark.parametrize("between", ["model", "PB"])
def test_the_worst_peak_is_that_of_the_rows(between):
    assert GainSchedule(VALUES, MODELS, between=between).worst_Ms() == pytest.approx(1.590, abs=6e-4)


def test_the_plant_between_rows_makes_the_known_peaks_of_worse_schedules():
    schedule = GainSchedule(VALUES, MODELS)
    by_gain = peaks(schedule, lambda x: SeriesPid(np.interp(x, VALUES, Kc), np.interp(x, VALUES, TAU_I)))
    assert by_gain.max() == pytest.approx(1.831, abs=6e-4)
    assert np.linspace(20, 80, 121)[by_gain.argmax()] == 65.5
    zone = peaks(
        schedule, lambda x: SeriesPid(*[column[np.searchsorted(VALUES, x, "right") - 1] for column in (Kc, TAU_I)])
    )
    assert zone.max() == pytest.approx(16.4, abs=0.06)


def test_an_exponential_gain_makes_the_known_peaks():
    schedule = GainSchedule(VALUES, MODELS)
    by_gain = peaks(schedule, lambda x: SeriesPid(np.interp(x, VALUES, Kc), np.interp(x, VALUES, TAU_I)), "exponential")
    assert by_gain.max() == pytest.approx(1.715, abs=6e-4)
    by_log = peaks(
        schedule,
        lambda x: SeriesPid(math.exp(np.interp(x, VALUES, np.log(Kc))), np.interp(x, VALUES, TAU_I)),
        "exponential",
    )
    assert by_log.max() == pytest.approx(1.590, abs=6e-4)


def test_one_setting_for_all_rows_and_the_settings_of_the_first_at_the_last():
    assert [Ms(model, SeriesPid(0.4, 8)) for model in MODELS] == pytest.approx([1.29, 1.28, 1.59], abs=0.006)
    assert math.isinf(Ms(MODELS[2], SeriesPid(2.5, 20)))


def test_rows_that_are_too_far_apart_are_warned_of():
    """k theta is 5 at both rows and 9 half way, where the band is still that for 5: a gain 1.8 times too large."""
    rows = (FirstOrderDelay(1, 5, 8), FirstOrderDelay(5, 1, 8))
    told = GainSchedule((0, 1), rows, between="PB").warnings()
    assert "if the gain of the plant is linear between rows, 1.59 at the rows: add a row there" in told[0]
    assert GainSchedule((0, 1), rows).warnings() == ()
    half_way = GainSchedule((0, 1), rows, between="PB").settings(0.5)
    assert half_way.Kc == pytest.approx(1.8 * simc(FirstOrderDelay(3, 3, 8)).Kc)


def test_peaks_are_those_of_the_loops_one_by_one():
    schedule = GainSchedule((0, 1), (FirstOrderDelay(1, 1, 8), FirstOrderDelay(1, 5, 8)), between="PB")
    x, found = schedule.peaks(points=5)
    assert x.tolist() == [0, 0.25, 0.5, 0.75, 1]
    assert found == pytest.approx([Ms(schedule.model(at), schedule.settings(at)) for at in x], rel=1e-12)


def test_unstable_points_have_no_peak():
    schedule = GainSchedule((0, 1), (FirstOrderDelay(1, 1, 8),) * 2, rule=lambda model: SeriesPid(40, 8))
    assert math.isinf(schedule.worst_Ms())


@pytest.mark.parametrize(
    ("rule", "half_way"),
    [
        (lambda model: IController(1 / model.k), IController(1 / 2)),
        (lambda model: ParallelPid(1 / model.k, 1 / (8 * model.k)), IdealPid(1 / 2, 8)),
        (lambda model: IdealPid(1 / model.k, math.inf), IdealPid(1 / 2, math.inf)),
    ],
)
def test_settings_of_every_form_are_interpolated(rule, half_way):
    schedule = GainSchedule((0, 1), (FirstOrderDelay(1, 1, 8), FirstOrderDelay(3, 1, 8)), rule, "PB")
    assert schedule.settings(0.5) == half_way


def test_second_order_and_negative_gains():
    schedule = GainSchedule((1, 2), (SecondOrderDelay(-1, 1, 8, 2), SecondOrderDelay(-4, 2, 10, 6)))
    assert schedule.model(1.5) == SecondOrderDelay(-2.5, 1.5, 9, 4)
    assert schedule.model(1.5, "exponential").k == pytest.approx(-2)
    assert schedule.settings(1.5).tau_D == 4


@pytest.mark.parametrize(
    ("values", "models", "how", "text"),
    [
        ((1,), MODELS[:1], {}, "as many, 2 at least, found 1 and 1"),
        ((1, 2, 3), MODELS[:2], {}, "found 3 and 2"),
        ((2, 1), MODELS[:2], {}, "values must increase, found 2, 1"),
        ((1, math.nan), MODELS[:2], {}, r"values\[1\] must be finite"),
        (
            (1, 2),
            (MODELS[0], IntegratingDelay(1, 1)),
            {},
            "of one kind, found a first-order one in row 1 and an integrating one in row 2",
        ),
        ((1, 2), (MODELS[0], FirstOrderDelay(-1, 1, 8)), {}, "gains must have one sign, found -1 in row 2"),
        ((1, 2), MODELS[:2], {"between": "Kc"}, "between must be one of model, PB, found 'Kc'"),
        ((1, 2), (None, None), {}, "reduced models of one kind, found NoneType"),
    ],
)
def test_tables_that_make_no_schedule_are_refused(values, models, how, text):
    with pytest.raises(InvalidParameter, match=text):
        GainSchedule(values, models, **how)


def test_settings_of_two_forms_are_not_interpolated():
    """Whose rule gives an I controller where there is no lag."""
    models = FirstOrderDelay(1, 1, 0), FirstOrderDelay(1, 1, 8)
    with pytest.raises(
        InvalidParameter, match="found pure integral action in row 1 and the series form in row 2: inter"
    ):
        GainSchedule((0, 1), models, between="PB").settings(0.5)
