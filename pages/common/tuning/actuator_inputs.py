"""What the actuator and the controller can do, typed: limits, sampling, what the mechanism does, noise."""

from dataclasses import dataclass

import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from pages.common.parts.number_field import design_number
from pages.common.parts.units import with_unit
from pages.common.session import state
from pages.common.session.design import Design
from pages.common.words import number, translated, words
from simc_core.errors import InvalidParameter
from simc_core.wording import Text, said


@dataclass(frozen=True, slots=True)
class Fault:
    """Something an actuator does: label, unit and help of its field; told: in a few words, of a {size}."""

    label: Text
    unit: str
    help: Text
    told: Text


LIMIT = said(
    "What the actuator can do; empty for no limit. The loop starts from u = 0, which must be within. "
    "With OP now in the loop sheet, limits are on the scale of OP."
)
LIMIT_OF_OP = said("What the actuator can do, on the scale of OP; empty for no limit. OP now must be within.")
TRACKING = said(
    "Anti-windup by back calculation: while u is at a limit, the integral is led back to it with this time constant. "
    r"Empty: $\sqrt{\tau_I \tau_D}$, or $\tau_I$ for PI [Åström and Hägglund 2006]."
)
SAMPLING = said("The controller acts every so often and holds u in between; 0 for a continuous one.")
MECHANISM = {
    "resolution": Fault(
        said("Resolution"),
        "OP",
        said("The output moves in steps of this size; 0 for none."),
        said("resolution {size}", size=""),
    ),
    "dead_band": Fault(
        said("Dead band"),
        "OP",
        said("A positioner rests until the output is farther away than this; 0 for none."),
        said("dead band {size}", size=""),
    ),
    "backlash": Fault(
        said("Backlash"),
        "OP",
        said("Play of the linkage: lost at every turn of direction; 0 for none."),
        said("backlash {size}", size=""),
    ),
    "rate_limit": Fault(
        said("Fastest move"),
        "OP/time",
        said("Largest speed of the actuator; empty for no limit."),
        said("fastest move {size}", size=""),
    ),
}
NOISE = said("Standard deviation of the measurement noise; a new value at each step of the controller.")
SEED = said("The same number gives the same noise.")


def inputs(design: Design) -> None:
    """All fields, and the limits that the loop sheet tells."""
    fields, under = st.container(key="actuator_inputs"), st.container()
    with fields:
        u = design.sheet.u_name
        _limit(said("Lowest {u}", u=u), "u_min", design, under)
        _limit(said("Highest {u}", u=u), "u_max", design, under)
        _number(said("Tracking time"), "T_t", TRACKING, said("automatic"), unit="time", under=under)
        _number(said("Sampling of the controller"), "sampling", SAMPLING, unit="time", under=under)
        for name, each in MECHANISM.items():
            empty = said("none", context="no limit") if name == "rate_limit" else None
            _number(each.label, name, each.help, empty, unit=each.unit, under=under)
        _number(said("Noise (std. dev.)"), "noise", NOISE, unit="PV", under=under)
        _number(said("Random seed"), "seed", SEED, under=under)
    _range_of_OP(design)


def _number(
    label: Text, name: str, help_: Text, empty: Text | None = None, *, unit: str = "", under: DeltaGenerator
) -> None:
    """A number of the actuator by its name in design.py; empty: what no number means, None where there must be one."""
    design_number(
        name,
        translated(label),
        quantity=unit,
        optional=empty is not None,
        under=under,
        help=translated(help_),
        placeholder=empty and translated(empty),
    )


def _limit(label: Text, name: str, design: Design, under: DeltaGenerator) -> None:
    """A limit of u, on the scale of OP where the operating point is known."""
    sheet = design.sheet

    def read(value: float | None) -> float | None:
        if value is None or sheet.OP_now is None:
            return value
        beyond = value > sheet.OP_now if name == "u_min" else value < sheet.OP_now
        if beyond:
            raise InvalidParameter(
                said(
                    "{label} must be {sign} {OP:g}, which is OP now, found {value:g}",
                    label=label,
                    sign="<=" if name == "u_min" else ">=",
                    OP=sheet.OP_now,
                    value=value,
                )
            )
        return sheet.off_scale(value)

    design_number(
        name,
        translated(label),
        show=lambda u: None if u is None else sheet.on_scale(u),
        read=read,
        quantity="OP",
        optional=True,
        under=under,
        help=translated(LIMIT if sheet.OP_now is None else LIMIT_OF_OP),
        placeholder=words("no limit"),
    )


def _range_of_OP(design: Design) -> None:
    """The limits that the loop sheet tells, as a button where others are in use."""
    sheet, actuator = design.sheet, design.actuator
    if None in (sheet.OP_low, sheet.OP_high, sheet.OP_now):
        return
    limits = {"u_min": sheet.off_scale(sheet.OP_low), "u_max": sheet.off_scale(sheet.OP_high)}
    if (actuator.u_min, actuator.u_max) != tuple(limits.values()):
        st.button(
            with_unit(
                words(
                    "Limits as in the loop sheet: OP {low} to {high}",
                    low=number(sheet.OP_low),
                    high=number(sheet.OP_high),
                ),
                sheet.OP_unit,
            ),
            key="range_of_OP",
            type="tertiary",
            icon=":material/arrow_forward:",
            on_click=state.change,
            kwargs=limits,
        )
