"""A Design as query parameters and back. Pure: no streamlit, so that it can be tested alone.

    plant, order, h, tau_c, b, filter, rules, form   the design itself; from h on only where not the default
    pins                                             order~h~tau_c~b~filter~rules, several separated by !
    Ga, Gb, method, inner, ...                       the cascade, only where it is not the default
    u_min, u_max, T_t, noise, seed, sampling, r, d   the loop as built, only where it is not the default

Numbers are written with all their digits, so that a link opens the very same design.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from urllib.parse import quote, urlencode

from pages.common.session.design import Design, Tuning
from simc_core import parse_plant
from simc_core.errors import SimcError
from simc_core.notation import plain

LONGEST_VALUE = 2000  # characters of one parameter; a plant of 40 poles needs fewer
TUNING_FIELDS = ("order", "h", "tau_c", "b", "filter", "rules")
CASCADE_FIELDS = {
    "Ga": "primary",
    "Gb": "secondary",
    "method": "method",
    "inner": "inner",
    "outer": "outer",
    "tau_c_inner": "tau_c_inner",
    "tau_c_outer": "tau_c_outer",
    "Ms_inner": "Ms_inner",
    "Ms_outer": "Ms_outer",
    "b_outer": "b",
    "N_inner": "N_inner",
    "N_outer": "N_outer",
    "filter_outer": "filter_outer",
}
ACTUATOR_FIELDS = {
    "u_min": "u_min",
    "u_max": "u_max",
    "T_t": "tracking_time",
    "noise": "noise",
    "seed": "seed",
    "sampling": "h",
    "r": "setpoint",
    "d": "disturbance",
}
TEXTS = ("rules", "form", "method", "inner", "outer", "filter_outer")
PLANTS = ("plant", "Ga", "Gb")
ALWAYS = ("plant", "order")


@dataclass(frozen=True, slots=True)
class Ignored:
    """A parameter of an address that could not be used, and why."""

    name: str
    value: str
    why: str

    def __str__(self) -> str:
        return f"{self.given} was ignored: {self.why}"

    @property
    def given(self) -> str:
        """What stood there, shortened."""
        return f"{_short(self.name)} = {_short(self.value)}"


def encode(design: Design) -> dict[str, str]:
    """The query parameters of a design."""
    usual = _usual()
    return {name: text for name, text in _flat(design).items() if text and (name in ALWAYS or text != usual[name])}


def query(design: Design) -> str:
    """The query part of an address, escaped."""
    return urlencode(encode(design), quote_via=quote, safe="()*^/,~!")


def decode(parameters: Mapping[str, str]) -> tuple[Design, list[Ignored]]:
    """The design that the parameters say, and what of them could not be used.

    What they do not mention has its default, whatever was there before: a link always opens the same design.
    Parameters are taken one by one: a bad one leaves the default and does not spoil the others.
    """
    design, ignored = Design(), []
    for name, value in parameters.items():
        try:
            design = _changed(design, name, value)
        except SimcError as error:
            ignored.append(Ignored(name, value, str(error)))
    return design, ignored


def number_text(value: float | None) -> str:
    """The shortest text that reads back as the same number; empty for None."""
    if value is None:
        return ""
    return repr(value).removesuffix(".0")


def _short(text: str) -> str:
    return text if len(text) <= 60 else text[:57] + "..."


@cache
def _usual() -> dict[str, str]:
    """The default design, which nothing changes."""
    return _flat(Design())


def _flat(design: Design) -> dict[str, str]:
    flat = {"plant": plain(design.plant)}
    flat |= {name: _text(name, getattr(design.tuning, name)) for name in TUNING_FIELDS}
    flat |= {"form": design.form, "pins": "!".join(map(_pin_text, design.pins))}
    for name, field in CASCADE_FIELDS.items():
        flat[name] = _text(name, getattr(design.cascade, field))
    for name, field in ACTUATOR_FIELDS.items():
        flat[name] = _text(name, getattr(design.actuator, field))
    return flat


def _changed(design: Design, name: str, text: str) -> Design:
    if len(text) > LONGEST_VALUE:
        raise SimcError(f"at most {LONGEST_VALUE} characters are read, got {len(text)}")
    if name == "pins":
        return replace(design, pins=tuple(_pin(pin) for pin in text.split("!")))
    if name in ("plant", "form"):
        return replace(design, **{name: _read(name, text)})
    if name in TUNING_FIELDS:
        return replace(design, tuning=replace(design.tuning, **{name: _read(name, text)}))
    if name in CASCADE_FIELDS:
        return replace(design, cascade=replace(design.cascade, **{CASCADE_FIELDS[name]: _read(name, text)}))
    if name in ACTUATOR_FIELDS:
        return replace(design, actuator=replace(design.actuator, **{ACTUATOR_FIELDS[name]: _read(name, text)}))
    raise SimcError("there is no parameter of this name")


def _text(name: str, value) -> str:
    if name in TEXTS:
        return value
    return plain(value) if name in PLANTS else number_text(value)


def _read(name: str, text: str):
    if name in TEXTS:
        return text
    if name in PLANTS:
        return parse_plant(text)
    try:
        return float(text)
    except ValueError:
        raise SimcError("a number was expected") from None


def _pin_text(pin: Tuning) -> str:
    return "~".join(_text(name, getattr(pin, name)) for name in TUNING_FIELDS)


def _pin(text: str) -> Tuning:
    values = text.split("~")
    if len(values) != len(TUNING_FIELDS):
        raise SimcError(f"a pinned tuning has {len(TUNING_FIELDS)} values separated by ~, got {len(values)}")
    given = dict(zip(TUNING_FIELDS, values, strict=True))
    return Tuning(**{name: _read(name, value) for name, value in given.items() if value})
