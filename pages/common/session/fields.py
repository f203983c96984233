"""The fields of a design by the names that links and widgets know them by. Pure: no streamlit."""

from dataclasses import replace

from pages.common.session.actuator import ACTUATION, Actuator
from pages.common.session.design import Design
from simc_core.errors import InvalidParameter
from simc_core.wording import Numeral, said

IN_LINKS = {"tracking_time": "T_t", "h": "sampling", "delay_scans": "scans"}  # h alone is taken, by Tuning

# Where the field of each name lies, "" for the design itself. Links and widgets know fields by these names.
PLACES: dict[str, tuple[str, str]] = {
    **{name: ("", name) for name in ("plant", "facts", "form", "own", "now", "pins", "box", "origin", "uncertainty")},
    "controller": ("", "source"),
    **{name: ("tuning", name) for name in ("order", "h", "tau_c", "b", "filter", "rules", "speed", "tau_F", "rule")},
    **{name: ("sheet", name) for name in ("tag", "note")},
    "unit": ("sheet", "time_unit"),
    **{
        f"{signal}{end}": ("sheet", f"{signal}{end}")
        for signal in ("PV", "OP")
        for end in ("", "_unit", "_low", "_high", "_now")
    },
    "Ga": ("cascade", "primary"),
    "Gb": ("cascade", "secondary"),
    "Ga_facts": ("cascade", "primary_facts"),
    "Gb_facts": ("cascade", "secondary_facts"),
    **{name: ("cascade", name) for name in ("method", "inner", "outer")},
    **{f"{name}_{loop}": ("cascade", f"{name}_{loop}") for name in ("tau_c", "Ms", "N") for loop in ("inner", "outer")},
    "b_outer": ("cascade", "b"),
    "filter_outer": ("cascade", "filter_outer"),
    **{IN_LINKS.get(name, name): ("actuator", name) for name in ACTUATION},
    **{name: ("record", name) for name in ("example", "structure", "begin", "end", "bad")},
    **{name: ("home", name) for name in ("rounding", "language", "exported", "points", "between")},
    "r": ("excitation", "setpoint"),
    "d": ("excitation", "disturbance"),
    "d_time": ("excitation", "load_time"),
    "r_ramp": ("excitation", "setpoint_ramp"),
    "d_ramp": ("excitation", "disturbance_ramp"),
    **{f"r_{end}": ("excitation", f"setpoint_{end}") for end in ("low", "high", "rate")},
    **{f"compared_{name}": ("compared", name) for name in ("plant", "kind", "tau_F", "Ms", "criterion", "rule")},
}


def get(design: Design, name: str):
    """The field of this name in PLACES."""
    record, field_name = PLACES[name]
    return getattr(getattr(design, record) if record else design, field_name)


def put(design: Design, name: str, value) -> Design:
    """The design with another value of this field. Raises InvalidParameter."""
    record, field_name = PLACES[name]
    if name == "OP_now":
        design = replace(design, actuator=_moved(design.actuator, design.sheet.OP_now, value))
    if name == "h" and value:  # what theta allows for is the sampling period
        design = replace(design, actuator=replace(design.actuator, h=value))
    if name == "sampling" and not value:
        design = replace(design, tuning=replace(design.tuning, h=0.0))
    if not record:
        return replace(design, **{field_name: value})
    return replace(design, **{record: replace(getattr(design, record), **{field_name: value})})


def _moved(actuator: Actuator, old: float | None, new: float | None) -> Actuator:
    """Limits of u that stay where they are on the scale of OP when its operating point moves."""
    if old is None or new is None or old == new:
        return actuator
    low, high = (None if u is None else u + old - new for u in (actuator.u_min, actuator.u_max))
    if (low or 0.0) > 0 or (high or 0.0) < 0:
        lowest, highest = (said("no limit") if end is None else Numeral(f"{end + new:g}") for end in (low, high))
        raise InvalidParameter(
            said(
                "OP_now must be within the limits of the output, {low} to {high}, found {new:g}",
                low=lowest,
                high=highest,
                new=new,
            )
        )
    return replace(actuator, u_min=low, u_max=high)
