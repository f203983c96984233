"""Address and project file: what goes in comes out, and nonsense says why it was not taken."""

import json
import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pages.common.session import links, project
from pages.common.session.actuator import Actuator
from pages.common.session.cascade import Cascade
from pages.common.session.design import Design
from pages.common.session.excitation import Excitation
from pages.common.session.fields import put
from pages.common.session.home import EXPORTED, LANGUAGES, ROUNDINGS, Home
from pages.common.session.loops import Entry, Loops
from pages.common.session.sheet import TIME_UNITS, Sheet
from pages.common.session.tuning import Tuning
from simc_core import IController, IdealPid, ParallelPid, Plant, SeriesPid
from simc_core.plants.step_facts import SettlingFacts, SlopeFacts

times = st.floats(1e-3, 1e3)
plants = st.builds(
    Plant,
    k=st.floats(-1e3, 1e3).filter(lambda k: abs(k) > 1e-3),
    theta=st.just(0.0) | times,
    lags=st.lists(times, min_size=1, max_size=4).map(tuple),
    leads=st.lists(times.map(lambda T: -T), max_size=1).map(tuple),
    integrators=st.integers(0, 2),
)
settling = st.builds(
    SettlingFacts,
    dOP=st.floats(-50, 50).filter(lambda change: abs(change) > 1e-2),
    dPV=st.floats(-500, 500).filter(lambda change: abs(change) > 1e-2),
    theta=st.just(0.0) | times,
    t63=times.map(lambda t: 2e3 + t),
    from_movement=st.booleans(),
)
slopes = st.builds(SlopeFacts, dOP=st.floats(1, 50), dPV=st.floats(-9, -1), theta=times, duration=times)
tunings = st.builds(
    Tuning,
    order=st.sampled_from([1, 2]),
    h=st.just(0.0) | times,
    tau_c=st.none() | times,
    b=st.floats(0, 2),
    filter=st.floats(0, 10),
    rules=st.sampled_from(["2003", "1998"]),
    speed=st.sampled_from(["", "1.5theta", "2theta", "moderate"]),
    tau_F=st.just(0.0) | times,
)
gains = st.floats(1e-3, 1e3)
lines = st.text(st.characters(categories=("L", "N", "P", "S", "Zs")), max_size=16).map(str.strip)
weights = {"tau_F": st.just(0.0) | times, "b": st.floats(0, 2), "c": st.floats(0, 2)}
standard = {"Kc": gains, "tau_I": times | st.just(math.inf), "tau_D": times, **weights}
settings_ = st.one_of(
    st.builds(SeriesPid, **standard),
    st.builds(IdealPid, **standard),
    st.builds(ParallelPid, Kp=gains, Ki=gains, Kd=gains, **weights),
    st.builds(IController, gains),
)
sheets = st.builds(
    Sheet,
    tag=lines,
    note=lines,
    time_unit=st.sampled_from(["", *TIME_UNITS]),
    PV=lines,
    PV_unit=lines,
    PV_low=st.none() | st.floats(-1e3, -1),
    PV_high=st.none() | st.floats(1, 1e3),
    PV_now=st.none() | st.floats(-1, 1),
)
peaks = st.none() | st.floats(1.05, 10)
kinds = st.sampled_from(["PI", "PID"])
cascades = st.builds(
    Cascade,
    primary=plants,
    secondary=plants,
    method=st.sampled_from(["simc", "synthesis"]),
    inner=kinds,
    outer=kinds,
    tau_c_inner=st.none() | times,
    tau_c_outer=st.none() | times,
    Ms_inner=peaks,
    Ms_outer=peaks,
    b=st.floats(0, 2),
    N_inner=st.floats(0.1, 1000),
    N_outer=st.floats(0.1, 1000),
    filter_outer=st.sampled_from(["N", "zero"]),
)
excitations = st.builds(
    Excitation,
    setpoint=st.floats(-10, 10),
    disturbance=st.floats(-10, 10),
    load_time=st.none() | times,
    setpoint_ramp=st.just(0.0) | times,
    disturbance_ramp=st.just(0.0) | times,
    setpoint_low=st.none() | st.floats(-10, 0),
    setpoint_high=st.none() | st.floats(0, 10),
    setpoint_rate=st.none() | times,
)
actuators = st.builds(
    Actuator,
    u_min=st.none() | st.floats(-1e3, -1e-3) | st.just(0.0),
    u_max=st.none() | times,
    tracking_time=st.none() | times,
    noise=st.just(0.0) | times,
    seed=st.integers(0, 2**32 - 1),
    resolution=st.just(0.0) | times,
    dead_band=st.just(0.0) | times,
    backlash=st.just(0.0) | times,
    rate_limit=st.none() | times,
    h=st.just(0.0) | times,
    delay_scans=st.sampled_from([0, 1]),
)
homes = st.builds(
    Home,
    rounding=st.sampled_from(ROUNDINGS),
    language=st.sampled_from(sorted(LANGUAGES)),
    exported=st.sampled_from(EXPORTED),
    between=st.sampled_from(["model", "PB"]),
    points=st.just(())
    | st.lists(st.tuples(gains, times, times), min_size=2, max_size=5).map(
        lambda rows: tuple((float(x), *row) for x, row in enumerate(rows))
    ),
)
designs = st.builds(
    Design,
    plant=plants,
    tuning=tunings,
    form=st.sampled_from(["series", "ideal", "parallel"]),
    own=st.none() | settings_,
    now=st.none() | settings_,
    pins=st.lists(tunings | settings_, max_size=4).map(tuple),
    sheet=sheets,
    home=homes,
    cascade=cascades,
    actuator=actuators,
    excitation=excitations,
).map(lambda design: replace(design, source="simc" if design.own is None else "own"))

of_step_tests = st.builds(
    lambda design, facts, block: replace(
        design,
        plant=facts.plant,
        facts=facts,
        cascade=replace(design.cascade, secondary=block.plant, secondary_facts=block),
    ),
    designs,
    settling | slopes,
    settling | slopes,
)


@settings(max_examples=50, deadline=None)
@given(designs | of_step_tests)
def test_a_link_opens_the_very_same_design(design):
    assert links.decode(links.encode(design)) == (design, [])


@settings(max_examples=25, deadline=None)
@given(designs | of_step_tests)
def test_a_project_file_opens_the_very_same_design(design):
    loops = Loops((Entry(Design()), Entry(design)), 1)
    assert project.load(project.dump(loops).encode()) == (loops, "")


def test_complex_pairs_keep_fourteen_digits():
    plant = Plant(1.0, 0.3, lag_pairs=((0.7, 0.13),))
    back, _ = links.decode(links.encode(Design(plant)))
    assert back.plant.lag_pairs[0] == pytest.approx((0.7, 0.13), rel=1e-14)


def test_the_address_of_the_default_is_short():
    assert list(links.encode(Design())) == ["plant", "order"]


@pytest.mark.parametrize(
    ("name", "value", "why"),
    [
        ("tau_c", "abc", "number"),
        ("tau_c", "-1", "> 0"),
        ("tau_c", "nan", "finite"),
        ("tau_c", "1e300", "1e+09"),
        ("order", "3", "<= 2"),
        ("order", "1.5", "whole"),
        ("plant", "1/(s+", "1/(s+"),
        ("plant", "s", ""),
        ("plant", "2/(10 s 1 1)", ""),  # a plus that was not written %2B arrives as a blank
        ("form", "PID", "series, ideal, parallel"),
        ("speed", "2 furlongs", "1.5theta"),
        ("own", "series~1~2", "6 values"),
        ("own", "zigzag~1~2", "series, ideal, parallel, I"),
        ("controller", "own", "my settings"),
        ("unit", "fortnight", "s, min, h, ms"),
        ("tag", "T" * 41, "40 characters"),
        ("PV_low", "a lot", "number"),
        ("pins", "1~2", "9 values"),
        ("pins", "!".join(["1~0~2~1~0~2003"] * 5), "at most 4"),
        ("Ms_inner", "0.5", ">= 1.05"),
        ("u_min", "0.5", "u_min must be <= 0"),
        ("d_time", "-1", "load_time must be >= 0"),
        ("r_ramp", "-1", "setpoint_ramp must be >= 0"),
        ("u_min", "-inf", "finite"),
        ("u_max", "1e-15", "1e-12"),
        ("T_t", "0", "tracking_time must not be zero"),
        ("noise", "-1", ">= 0"),
        ("seed", "1.5", "whole"),
        ("sampling", "nan", "finite"),
        ("r", "1e20", "<= 1e+12"),
        ("method", "magic", "simc, synthesis"),
        ("N_outer", "0.01", ">= 0.1"),
        ("filter_outer", "pole", "N, zero"),
        ("facts", "ramp~1~2~3~4", "step, movement, slope"),
        ("facts", "step~5~11~20", "4 values"),
        ("facts", "step~5~11~20~10", "t63 must be >= theta = 20"),
        ("facts", "slope~0~11~20~10", "dOP must not be zero"),
        ("colour", "red", "no parameter"),
        ("plant", "1" * 5000, "2000 characters"),
    ],
)
def test_nonsense_is_left_out_and_told(name, value, why):
    design, ignored = links.decode({name: value, "b": "0.5"})
    assert design == Design(tuning=Tuning(b=0.5))
    assert [(one.name, one.value) for one in ignored] == [(name, value)]
    if name != "plant":
        assert why in ignored[0].why
    assert len(str(ignored[0])) < 400


def test_facts_of_another_plant_are_left_out_and_go_when_the_plant_changes():
    facts = SettlingFacts(5, 11, 20, 200)
    assert links.decode({"plant": "1/(s+1)", "facts": links.facts_text(facts)})[0].facts is None
    heater, _ = links.decode({"facts": "step~5~11~20~200", "plant": "2.2 exp(-20s)/(180s+1)"})
    assert heater.facts == facts
    assert put(heater, "plant", Plant(2.0, 20.0, (180.0,))).facts is None
    assert put(heater, "b", 0.5).facts == facts


def good() -> dict:
    return {"format": "simc-project", "version": 1, "design": links.encode(Design())}


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"\xff\xfe", "not JSON"),
        (b"{", "not JSON"),
        (b"[" * 100_000, "not JSON"),
        (b" " * 300_000, "at most"),
        (b"[1, 2]", "not a project file"),
        (json.dumps(good() | {"version": 3}).encode(), "version must be 1 or 2, found 3"),
        (json.dumps(good() | {"version": 2, "loops": []}).encode(), "1 to 50 loops"),
        (json.dumps(good() | {"version": 2, "loops": [good()], "current": 1}).encode(), "must be one of 1, found 2"),
        (json.dumps(good() | {"version": 2, "loops": [good()], "current": "0"}).encode(), "place of a loop"),
        (json.dumps(good() | {"version": True}).encode(), "version must be 1"),
        (json.dumps(good() | {"design": {"order": "1"}}).encode(), "must hold a plant"),
        (json.dumps(good() | {"design": {"plant": 3}}).encode(), "object of texts"),
        (json.dumps(good() | {"design": good()["design"] | {"tau_c": "-2"}}).encode(), "tau_c"),
        (json.dumps(good() | {"design": good()["design"] | {"colour": "red"}}).encode(), "colour"),
    ],
)
def test_a_wrong_file_gives_no_design_and_the_reason(data, why):
    loops, reason = project.load(data)
    assert loops is None
    assert why in reason


def test_a_file_of_version_1_holds_one_loop():
    loops, reason = project.load(json.dumps(good()).encode())
    assert (loops.design, len(loops.entries), reason) == (Design(), 1, "")


def test_tight_is_written_as_nothing_and_infinity_is_not_a_number_here():
    assert "tau_c" not in links.encode(Design(tuning=Tuning(tau_c=None)))
    _, ignored = links.decode({"tau_c": str(math.inf)})
    assert ignored


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("exp(-3s)/((6s 1)(4s 1)(2s 1))", "exp(-3s)/((6s+1)(4s+1)(2s+1))"),
        ("(10s 1)exp(-100s)/((0.001s 1)(20s 1))", "(10s+1)exp(-100s)/((0.001s+1)(20s+1))"),
        ("1/(s^2 3s 1)", "1/(s^2+3s+1)"),
        ("exp(-s)/(s**2 .5s 1)", "exp(-s)/(s**2+.5s+1)"),
    ],
)
def test_a_plus_that_an_address_has_turned_into_a_space_is_read(typed, meant):
    # RFC 3986 leaves + alone, forms (WHATWG URL, application/x-www-form-urlencoded) read it as a space
    assert links.decode({"plant": typed}) == links.decode({"plant": meant})


@pytest.mark.parametrize("text", ["1/(6s 1)(s x)", "1/(5 3s)", "2 3/(s 1)"])
def test_other_spaces_of_an_address_are_refused(text):
    _, ignored = links.decode({"plant": text})
    assert [bad.name for bad in ignored] == ["plant"]


def test_a_lost_plus_elsewhere_names_the_way_out():
    _, (bad,) = links.decode({"plant": "1/(s 1 3s)"})
    assert "%2B" in bad.why


def test_there_is_one_sampling_period():
    """What theta allows for is the sampling period or nothing; links of before, with two, keep the one of the loop."""
    design = put(Design(), "sampling", 2.0)
    assert (design.actuator.h, design.tuning.h) == (2, 0)
    design = put(design, "h", 2.0)
    assert (design.actuator.h, design.tuning.h) == (2, 2)
    design = put(design, "sampling", 0.5)
    assert (design.actuator.h, design.tuning.h) == (0.5, 0.5)
    assert (put(design, "h", 0.0).actuator.h, put(design, "h", 0.0).tuning.h) == (0.5, 0)
    assert (put(design, "sampling", 0.0).actuator.h, put(design, "sampling", 0.0).tuning.h) == (0, 0)
    assert links.decode({"h": "3"})[0].actuator.h == 3
    design, ignored = links.decode({"h": "3", "sampling": "2"})
    assert (design.actuator.h, design.tuning.h, ignored) == (2, 2, [])


def test_pinned_tunings_of_before_are_read():
    design, ignored = links.decode({"pins": "1~0~~1~0~2003~!2~0~5~1~0.1~2003"})
    assert not ignored
    assert design.pins == (Tuning(), Tuning(order=2, tau_c=5.0, filter=0.1))


@pytest.mark.parametrize("name", ["utm_source", "UTM_Campaign", "fbclid", "gclid", "msclkid", "mc_eid", "_ga"])
def test_what_follows_readers_is_dropped_and_nothing_is_said(name):
    assert links.without_trackers({"tau_c": "3", name: "x"}) == {"tau_c": "3"}


def test_no_field_of_the_design_is_taken_for_what_follows_readers():
    assert links.without_trackers(dict.fromkeys(links.ORDER, "")) == dict.fromkeys(links.ORDER, "")
