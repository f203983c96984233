"""A design in another unit of time. Pure: no streamlit."""

from dataclasses import replace
from fractions import Fraction

from pages.common.session.compared import PRESENT
from pages.common.session.design import Design
from pages.common.session.facts import rescaled
from pages.common.session.sheet import ratio
from pages.common.session.tuning import Tuning

TIMES = (
    *("tau_c", "h", "tau_F", "tracking_time", "tau_c_inner", "tau_c_outer"),
    *("load_time", "setpoint_ramp", "disturbance_ramp"),
)
RATES = ("rate_limit", "setpoint_rate")


def in_time_unit(design: Design, unit: str) -> Design:
    """The same design with its times in another unit: plant, controllers, cascade, sampling, everything.

    Where the unit had no name so far, this names it and converts nothing.
    """
    time = ratio(design.sheet.time_unit, unit)
    if time == 1:
        return replace(design, sheet=replace(design.sheet, time_unit=unit))
    plant, facts = rescaled(design.plant, design.facts, time)
    primary, primary_facts = rescaled(design.cascade.primary, design.cascade.primary_facts, time)
    secondary, secondary_facts = rescaled(design.cascade.secondary, design.cascade.secondary_facts, time)
    return replace(
        design,
        sheet=replace(design.sheet, time_unit=unit),
        plant=plant,
        facts=facts,
        origin=None if design.origin is None else design.origin.rescaled(plant, time),
        uncertainty=tuple(each.rescaled(time) for each in design.uncertainty),
        tuning=_in_time(design.tuning, time),
        own=None if design.own is None else design.own.rescaled(time),
        now=None if design.now is None else design.now.rescaled(time),
        pins=tuple(_in_time(pin, time) if isinstance(pin, Tuning) else pin.rescaled(time) for pin in design.pins),
        actuator=_in_time(design.actuator, time),
        excitation=_in_time(design.excitation, time),
        home=design.home.in_time(time),
        compared=_in_time(design.compared, time) if design.compared.plant == PRESENT else design.compared,
        cascade=replace(
            _in_time(design.cascade, time),
            primary=primary,
            secondary=secondary,
            primary_facts=primary_facts,
            secondary_facts=secondary_facts,
        ),
    )


def _in_time(record, time: Fraction):
    """The record with those of its fields that are times multiplied, and its rates divided."""
    given = {name: getattr(record, name) for name in (*TIMES, *RATES) if getattr(record, name, None)}
    return replace(
        record, **{name: _scaled(value, 1 / time if name in RATES else time) for name, value in given.items()}
    )


def _scaled(value: float, ratio: Fraction) -> float:
    return value * ratio.numerator / ratio.denominator
