"""Boxes: numbers worked out by hand and by an independent program, the way back, rounding, refusals."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from simc_core import (
    BOXES,
    BoxError,
    FormError,
    IController,
    IdealPid,
    InvalidParameter,
    Loop,
    ParallelPid,
    Plant,
    SeriesPid,
    SimcError,
    from_box,
    margins,
    simulate,
    to_box,
)
from simc_core.implementation.boxes.filters import fixed_ratio_filter

P0 = Plant(1, 1, (10, 3))
SERIES = SeriesPid(5, 8, 3)  # SIMC, tau_c = theta: ideal 6.875, 11, 2.18182
FLOW = Plant(0.8, 0.6, (1.1,))
FLOW_PI = SeriesPid(1.1 / (0.8 * 1.2), 1.1)
INF = math.inf


def Ms(plant, controller):
    return margins(Loop(plant, controller)).Ms


def numbers(typed, *names):
    return tuple(typed.values[name] for name in names)


# What is typed for Kc = 2, tau_I = 30 s, tau_D = 6 s, PV 0-200 (K% = 2 200/50 = 8), output 0-50, by hand.
BY_HAND = {
    "rockwell_pide_dependent": {"PGain": 8, "IGain": 0.5, "DGain": 0.1},
    "rockwell_pide_independent": {"PGain": 8, "IGain": 16, "DGain": 0.8},
    "logix_pid_dependent": {"Kc": 8, "Ti": 0.5, "Td": 0.1},
    "logix_pid_independent": {"Kp": 8, "Ki": 8 / 30, "Kd": 48},
    "slc500": {"Kc": 8, "Ti": 0.5, "Td": 0.1},
    "slc500_rg": {"Kc": 8, "Ti": 0.5, "Td": 0.1},
    "siemens_cont_c": {"GAIN": 8, "TI": 30, "TD": 6, "TM_LAG": 0},
    "honeywell_udc": {"PB": 12.5, "RSET": 0.5, "RATE": 0.1},
    "honeywell_udc_gain": {"GAIN": 8, "RSET": 2, "RATE": 0.1},
    "honeywell_experion": {"K": 8, "T1": 0.5, "T2": 0.1},
    "yokogawa_centum": {"P": 12.5, "I": 30, "D": 6},
    "abb_acs880": {"gain": 8, "integration time": 30, "derivation time": 6, "derivation filter time": 0},
    "abb_infi90": {"K": 1, "KP": 8, "KI": 16, "KD": 0.8},
    "omron_pidat": {"P": 125, "Tik": 300, "Tdk": 60, "alpha": 0},
    "panasonic_fp": {"Kp": 80, "Ti": 300, "Td": 60},
    "eurotherm_3116": {"Pb": 25, "ti": 30, "td": 6},
    "beckhoff_ctrl_pid": {"fKp": 2, "tTn": 30, "tTv": 6, "tTd": 0},
    "codesys_pid": {"KP": 2, "TN": 30, "TV": 6},
    "oscat_ctrl_pid": {"KP": 2, "TN": 30, "TV": 6},
    "iec_draft_pid": {"KP": -2, "TR": 30, "TD": 6},
    "simple_pid": {"Kp": 2, "Ki": 1 / 15, "Kd": 12},
    "arduino_pid": {"Kp": 2, "Ki": 1 / 15, "Kd": 12},
    "matlab_pid": {"Kp": 2, "Ki": 1 / 15, "Kd": 12, "Tf": 0},
}
# A PI of the same gain for those that filter the derivative by a ratio of their own: it has nothing to filter.
PI_BY_HAND = {
    "siemens_pid_compact": {"Gain": 4, "Ti": 30, "Td": 0, "TdFiltRatio": 0.2},
    "siemens_pid_temp": {"Gain": 4, "Ti": 30, "Td": 0, "TdFiltRatio": 0.2},
    "siemens_tcont_cp": {"GAIN": 4, "TI": 30, "TD": 0, "D_F": 5},
    "siemens_pcs7": {"Gain": 8, "TI": 30, "TD": 0, "DiffGain": 5},
    "deltav_standard": {"GAIN": 8, "RESET": 30, "RATE": 0, "ALPHA": 0.125},
    "deltav_series": {"GAIN": 8, "RESET": 30, "RATE": 0, "ALPHA": 0.125},
    "emerson_fieldbus_standard": {"GAIN": 8, "RESET": 30, "RATE": 0},
    "emerson_fieldbus_series": {"GAIN": 8, "RESET": 30, "RATE": 0},
    "foxboro_ia": {"PBAND": 12.5, "INT": 0.5, "DERIV": 0, "KD": 10},
    "schneider_pidff": {"kp": 2, "ti": 30, "td": 0, "kd": 10},
    "schneider_pidff_parallel": {"kp": 2, "ti": 50 / 200 / (2 / 30), "td": 0, "kd": 10},
    "discrete_pids": {"K": 2, "Ti": 30, "Td": 0, "N": 10},
    "matlab_pidstd": {"Kp": 2, "Ti": 30, "Td": 0, "N": 10},
}


def test_every_box_is_compared_with_numbers_worked_out_by_hand():
    assert set(BY_HAND) | set(PI_BY_HAND) == set(BOXES)
    assert not set(BY_HAND) & set(PI_BY_HAND)


@pytest.mark.parametrize("key", BOXES)
def test_what_is_typed_is_what_is_worked_out_by_hand(key):
    controller = IdealPid(2, 30, 6 if key in BY_HAND else 0)
    expected = (BY_HAND | PI_BY_HAND)[key]
    found = to_box(controller, key, pv_span=200, out_span=50)
    assert {name: found.values[name] for name in expected} == pytest.approx(expected, rel=1e-12)
    assert found.action == "reverse"
    in_minutes = to_box(replace(controller, tau_I=0.5, tau_D=controller.tau_D / 60), key, 200, 50, "min")
    assert {name: in_minutes.values[name] for name in expected} == pytest.approx(expected, rel=1e-12)
    assert in_minutes.effective.to_parallel().Ki == pytest.approx(4, rel=1e-12)


@pytest.mark.parametrize("key", BOXES)
def test_a_direct_acting_controller_has_the_same_numbers_and_the_other_action(key):
    one, other = (to_box(IdealPid(Kc, 30), key, 200, 50) for Kc in (2, -2))
    assert (one.action, other.action) == ("reverse", "direct")
    gain = BOXES[key].field_of("gain", "PB").name
    assert other.values[gain] == (-1 if BOXES[key].sign else 1) * one.values[gain]
    assert other.effective.to_parallel().Kp == pytest.approx(-2, rel=1e-12)


def test_a_box_with_a_filter_of_the_derivative_keeps_zeros_and_integral_gain():
    found = to_box(SERIES, "deltav_standard")
    assert numbers(found, "GAIN", "RESET", "RATE") == pytest.approx((6.71999, 10.75199, 1.98406), abs=1e-4)
    assert found.effective.tau_F == pytest.approx(found.values["RATE"] / 8, rel=1e-12)
    assert Ms(P0, found.effective) == pytest.approx(1.8165, abs=6e-5)
    assert found.effective.to_parallel().Ki == pytest.approx(5 / 8, rel=1e-12)


def test_the_design_typed_without_thought_into_that_box_is_another_one():
    typed = {"GAIN": 6.875, "RESET": 11, "RATE": 2.18182, "ALPHA": 0.125}
    assert Ms(P0, from_box("deltav_standard", typed)) == pytest.approx(1.9358, abs=6e-5)


@pytest.mark.parametrize(("alpha", "peak"), [(8, 1.9142), (10, 1.8571), (16, 1.7679), (20, 1.7371)])
def test_peaks_of_a_series_box_with_a_filtered_lead(alpha, peak):
    found = to_box(SERIES, "deltav_series", N=alpha)
    assert numbers(found, "GAIN", "RESET", "RATE", "ALPHA") == (5, 8, 3, 1 / alpha)
    assert Ms(P0, found.effective) == pytest.approx(peak, abs=6e-5)


@pytest.mark.parametrize(("design", "peak"), [((3.6364, 10), 1.5487), ((4.2105, 9.5), 1.6787)])
def test_tuned_with_the_filter_in_the_dead_time_the_peak_is_low_again(design, peak):
    found = to_box(SeriesPid(*design, 3), "deltav_series")
    assert Ms(P0, found.effective) == pytest.approx(peak, abs=6e-5)


FILTERED = IdealPid(2, 30, 6, 1, b=0.8, c=0.3)


@pytest.mark.parametrize("key", [key for key, box in BOXES.items() if box.filter in ("time", "ratio")])
def test_a_filter_of_the_derivative_only_is_the_same_controller_on_the_frequency_axis(key):
    """The box's law written out from the typed numbers."""
    found = to_box(FILTERED if BOXES[key].form != "series" else FILTERED.to_series(), key)
    box, s = BOXES[key], 1j * np.geomspace(0.01, 10, 30)
    values = {field.quantity: found.values[field.name] for field in box.fields}
    if box.form in ("series", "interacting"):
        Kc, Ti, Td = values.get("gain", 100 / values.get("PB", 100)), values["Ti"], values["Td"]
        if box.form == "interacting":
            Ti, Td = 60 * Ti, 60 * Td
            Tf = 1 / values["N"] / (1 / Ti + 1 / Td)
        else:
            Tf = values["1/N"] * Td
        C = Kc * (1 + 1 / (Ti * s)) * (Td * s + 1) / (Tf * s + 1)
    else:
        Kp = values["gain"]
        Ki = values.get("Ki") or (Kp / values["Ti"] if "Ti" in values else 1 / values["1/Ki"])
        Kd = values["Kd"] if "Kd" in values else Kp * values["Td"]
        ratio = values["1/N"] if "1/N" in values else 1 / values.get("N", INF)
        C = Kp + Ki / s + Kd * s / (values.get("Tf", ratio * Kd / Kp) * s + 1)
    assert pytest.approx(FILTERED.response(s), rel=1e-10) == C


def controllers(kind):
    gain = st.floats(0.5, 10) | st.floats(-10, -0.5)
    return st.builds(
        lambda Kc, tau_I, ratio, tau_F: IdealPid(Kc, tau_I, ratio * tau_I, ratio * tau_I * tau_F, 1, 1),
        gain,
        st.floats(40, 50),
        st.just(0.0) if kind == "PI" else st.floats(0.15, 0.2),
        st.floats(0.12, 0.16),
    )


@pytest.mark.parametrize("kind", ["PI", "PID"])
@pytest.mark.parametrize("key", BOXES)
@settings(max_examples=25)  # of each box and structure: 72 times
@given(data=st.data(), unit=st.sampled_from(["s", "min"]), pv=st.floats(50, 200), out=st.floats(50, 200))
def test_what_is_read_back_from_a_box_is_the_design(key, kind, data, unit, pv, out):
    box, design = BOXES[key], data.draw(controllers(kind))
    if unit == "min":
        design = replace(design, tau_I=design.tau_I / 60, tau_D=design.tau_D / 60, tau_F=design.tau_F / 60)
    if box.filter == "fixed" and kind == "PID":
        tau_F = (
            fixed_ratio_filter(design.to_parallel(), box.N) if box.form == "ideal" else design.to_series().tau_D / 10
        )
        design = replace(design, tau_F=tau_F)
    found = to_box(design, key, pv, out, unit)
    back = from_box(key, found.values, found.action, pv, out, unit)
    assert back == found.effective
    one, other = back.to_parallel(), design.to_parallel()
    for name in ("Kp", "Ki", "Kd", "tau_F"):
        assert getattr(one, name) == pytest.approx(getattr(other, name), rel=1e-11), name
    again = to_box(back, key, pv, out, unit).values
    assert {name: value for name, value in again.items() if name != "structure"} == pytest.approx(
        {name: value for name, value in found.values.items() if name != "structure"}, rel=1e-10, abs=1e-12
    )


@pytest.mark.parametrize("key", BOXES)
def test_rounded_numbers_are_on_the_safe_side_and_within_a_step(key):
    design = IdealPid(1.2345678, 123.45678, 23.45678 if BOXES[key].filter == "none" else 0)
    exact, rounded = (to_box(design, key, rounded=how) for how in (False, True))
    for field in BOXES[key].fields:
        if field.step:
            change = rounded.values[field.name] - exact.values[field.name]
            assert abs(change) < field.step
            steps = rounded.values[field.name] / field.step
            assert steps == pytest.approx(round(steps), abs=1e-9)
    assert abs(rounded.effective.to_parallel().Kp) <= abs(design.Kc) * (1 + 1e-12)
    assert rounded.effective.to_ideal().tau_I >= design.tau_I * (1 - 1e-12)


@pytest.mark.parametrize(
    ("Ti", "peak"),
    [(1, 1.638), (2, 1.456), (0.6, 2.33), (1.2, 1.557), (6, 1.401)],
)
def test_peaks_of_a_fast_flow_loop_with_rounded_integral_times(Ti, peak):
    typed = {"gain": FLOW_PI.Kc, "integration time": Ti}
    assert Ms(FLOW, from_box("abb_acs880", typed)) == pytest.approx(peak, abs=6e-3 if peak > 2 else 6e-4)


def test_a_proportional_band_is_rounded_up():
    found = to_box(FLOW_PI, "eurotherm_3116", rounded=True)
    assert numbers(found, "Pb", "ti") == (88, 2)
    assert to_box(FLOW_PI, "yokogawa_centum").values["P"] == pytest.approx(87.27, abs=0.005)
    assert Ms(FLOW, from_box("yokogawa_centum", {"P": 90, "I": 1.1})) == pytest.approx(1.566, abs=6e-4)


def test_seconds_typed_as_minutes_are_a_lazy_loop_and_minutes_as_seconds_an_unstable_one():
    typed = {"GAIN": 5, "RESET": 480, "RATE": 3, "ALPHA": 0.125}
    lazy = from_box("deltav_series", typed)
    assert Ms(P0, replace(lazy, tau_F=0)) == pytest.approx(1.535, abs=6e-4)
    assert not margins(Loop(P0, from_box("deltav_series", typed | {"RESET": 8 / 60}))).stable


def test_a_pi_filter_goes_before_a_box_that_filters_the_derivative_only():
    found = to_box(IdealPid(2, 30, 0, 3), "deltav_standard")
    assert found.values["PV filter"] == 3
    assert found.effective == IdealPid(2, 30, 0, 3)
    assert "must be set at the measurement" in found.warnings[0]


def test_the_set_point_response_in_effect_is_that_of_the_box():
    """u(0+) of a box that filters the derivative on PV only is b Kp r: nothing filters the set point."""
    found = to_box(replace(SERIES, tau_F=0.25), "deltav_standard")
    response = simulate(Loop(P0, found.effective)).u
    assert response[response != 0][0] == pytest.approx(found.values["GAIN"], rel=1e-6)


@pytest.mark.parametrize(("b", "c", "name"), [(1, 1, "PID-A"), (0, 0, "PID-B")])
def test_set_point_structures_go_both_ways(b, c, name):
    found = to_box(IdealPid(2, 60, 12, b=b, c=c), "honeywell_udc")
    assert found.values["structure"] == name
    assert (found.effective.b, found.effective.c) == (b, c)
    assert not [text for text in found.warnings if "set-point" in text]


def test_a_structure_that_the_box_has_not_is_told():
    found = to_box(IdealPid(2, 60, 12, b=0.5), "honeywell_udc")
    assert any("set-point response" in text for text in found.warnings)


def test_an_interacting_box_weighs_the_set_point_as_its_law_says():
    """u = Kc (1 + 1/(Ti s)) [r - (Td s + 1) PV]: from r Kc (1 + 1/(Ti s))."""
    found = to_box(SERIES, "foxboro_ia").effective
    s = 1j * np.array([0.01, 0.1])
    expected = 5 * (1 + 1 / (8 * s)) / (1 + found.tau_F * s)
    assert found.setpoint_response(s) == pytest.approx(expected, rel=1e-12)
    assert found.tau_F == pytest.approx(1 / (10 * (1 / 8 + 1 / 3)), rel=1e-12)


def test_no_integral_action_is_zero_in_one_box_and_9999_in_another():
    assert to_box(IdealPid(2, INF), "siemens_pid_compact").values["Ti"] == 0
    assert to_box(IdealPid(2, INF), "omron_pidat").values["Tik"] == 9999
    assert from_box("omron_pidat", {"P": 500, "Tik": 9999}).tau_I == INF
    with pytest.raises(BoxError, match=r"TN of Util PID must be from 1e-09 to 1e\+09 s, found inf"):
        to_box(IdealPid(2, INF), "codesys_pid")


def test_pure_integral_action_has_a_parallel_box_only():
    found = to_box(IController(-0.3), "rockwell_pide_independent")
    assert numbers(found, "PGain", "IGain", "DGain") == pytest.approx((0, 18, 0))
    assert found.action == "direct"
    assert found.effective == ParallelPid(0, -0.3)
    with pytest.raises(FormError):
        to_box(IController(0.3), "deltav_standard")


def test_complex_zeros_have_no_series_box():
    with pytest.raises(FormError, match="tau_I >= 4 tau_D"):
        to_box(IdealPid(1, 3, 1), "deltav_series")
    double = to_box(IdealPid(1, 4, 1), "deltav_series")
    assert numbers(double, "GAIN", "RESET", "RATE") == pytest.approx((0.5, 2, 2))


@pytest.mark.parametrize(
    ("design", "key", "field", "nearest", "text"),
    [
        (IdealPid(0.05, 30), "honeywell_udc", "PB", 1000, r"PB .* from 0.1 to 1000 %, found 2000: the nearest is 1000"),
        (IdealPid(2, 6000), "honeywell_udc", "RSET", 50, r"RSET .* found 100: the nearest is 50"),
        (IdealPid(2, 60, 3), "honeywell_udc", "RATE", 0.09, r"\(0 is off\), found 0.05"),
        (IdealPid(2, 60, 12), "abb_acs880", "derivation time", 10, "must be from 0 to 10 s, found 12"),
        (IdealPid(2, 20_000), "yokogawa_centum", "I", 10_000, "found 20000"),
        (IdealPid(5000, 30), "slc500", "Kc", 3276.7, "must be from 0 to 3276.7 %/%, found 5000"),
    ],
)
def test_what_is_out_of_range_is_refused_with_the_nearest(design, key, field, nearest, text):
    with pytest.raises(BoxError, match=text) as refused:
        to_box(design, key)
    assert refused.value.field == field
    assert refused.value.nearest == nearest


def test_rounding_to_nothing_is_refused():
    with pytest.raises(BoxError, match=r"Kc of SLC 500 PID must be >= 0.1, found 0.05"):
        to_box(IdealPid(0.05, 30), "slc500", rounded=True)


def test_a_derivative_time_next_to_off_is_rounded_to_what_is_nearer():
    assert to_box(IdealPid(2, 60, 2), "honeywell_udc", rounded=True).values["RATE"] == 0
    assert to_box(IdealPid(2, 60, 4), "honeywell_udc", rounded=True).values["RATE"] == 0.09


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"RSET": 1}, "PB of .* must be given"),
        ({"PB": 50, "RSET": 1, "Ti": 3}, "has no field Ti; it has PB, RATE, RSET"),
        ({"PB": 50, "RSET": 1, "structure": "PID-C"}, "structure must be one of PID-A, PID-B, found 'PID-C'"),
        ({"PB": -50, "RSET": 1}, "PB .* from 0.1 to 1000 %, found -50"),
        ({"PB": 50, "RSET": 0}, "RSET .* found 0"),
    ],
)
def test_numbers_that_no_box_has_are_refused(values, text):
    with pytest.raises(BoxError, match=text):
        from_box("honeywell_udc", values)


def test_a_sign_against_the_action_is_refused():
    with pytest.raises(BoxError, match=r"KP .* must have the sign of a reverse acting controller, found 2") as refused:
        from_box("iec_draft_pid", {"KP": 2, "TR": 30}, "reverse")
    assert refused.value.nearest == -2
    assert from_box("iec_draft_pid", {"KP": 2, "TR": 30}, "direct") == IdealPid(-2, 30, c=1)


def test_two_filters_in_a_row_are_refused():
    values = {"GAIN": 2, "RESET": 30, "RATE": 5, "PV filter": 1}
    with pytest.raises(BoxError, match="PV filter must be 0 beside the filter of DeltaV"):
        from_box("deltav_standard", values)


def test_a_filter_ratio_that_is_too_small_is_refused_with_the_smallest():
    with pytest.raises(BoxError, match=r"N must be >= 4 tau_D/tau_I - 1 = 3 in pidstd, found 2") as refused:
        to_box(IdealPid(1, 5, 5), "matlab_pidstd", N=2)
    assert refused.value.nearest == pytest.approx(3)
    with pytest.raises(BoxError, match="has no ratio N"):
        to_box(SERIES, "codesys_pid", N=8)


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"key": "abb_800xa"}, f"key must be one of {', '.join(BOXES)}, found 'abb_800xa'"),
        ({"key": "slc500", "pv_span": 0}, "pv_span must not be zero"),
        ({"key": "slc500", "out_span": -100}, "out_span must be > 0, found -100"),
        ({"key": "slc500", "time_unit": "h"}, "time_unit must be one of s, min, found 'h'"),
    ],
)
def test_what_is_asked_of_no_box_is_refused(given, text):
    with pytest.raises(InvalidParameter, match=text):
        to_box(SERIES, **given)


def test_boxes_read_in_no_text_of_their_maker_say_so():
    for box in BOXES.values():
        told = to_box(IdealPid(2, 60), box.key).warnings
        assert any("check your manual" in text for text in told) == (box.verified != "maker" or bool(box.unread))


def test_the_two_filters_are_inverse_to_each_other_also_without_integral_action():
    design = ParallelPid(2, 0, 3, fixed_ratio_filter(ParallelPid(2, 0, 3), 9))
    assert design.tau_F == pytest.approx(0.15)
    found = to_box(design, "matlab_pid")
    assert found.values["Kd"] / found.values["Kp"] / found.values["Tf"] == pytest.approx(9)


def test_derivative_action_without_a_gain_has_no_filter_ratio():
    with pytest.raises(BoxError, match="filters D by a ratio to P"):
        from_box("schneider_pidff_parallel", {"kp": 0, "ti": 10, "td": 2})
    with pytest.raises(InvalidParameter, match=r"N must be >= 0.001, found -3"):
        to_box(SERIES, "deltav_standard", N=-3)


@pytest.mark.parametrize("key", BOXES)
@given(data=st.data())
def test_whatever_is_typed_makes_a_controller_or_is_refused_in_words(key, data):
    number = st.sampled_from([0, -1, 1e-12, 0.08, 1, 9999, 1e5, 1e300]) | st.floats()
    values = {field.name: data.draw(number) for field in BOXES[key].fields}
    try:
        found = from_box(key, values, data.draw(st.sampled_from(["reverse", "direct"])), 50, 20)
    except SimcError:
        return
    assert found.tau_F >= 0
