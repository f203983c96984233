"""Emerson: DeltaV, Rosemount fieldbus PID."""

from functools import partial

from simc_core.implementation.boxes.box import D_ON_PV, Box, Field
from simc_core.wording import said

_SETTINGS = (Field("GAIN", "gain", "%/%"), Field("RESET", "Ti", "s"), Field("RATE", "Td", "s"))
_DELTAV = partial(
    Box,
    maker="Emerson",
    source=said("DeltaV Books Online; units and forms from a third party"),
    verified="maker",
    filter="ratio",
    N=8.0,
    fields=(
        *_SETTINGS,
        Field("ALPHA", "1/N", "", 0.05, 1.0),
        Field("BETA", "b", "", 0.0, 1.0),
        Field("GAMMA", "c", "", 0.0, 1.0),
    ),
    notes=(said("beyond the anti-reset-windup limits RESET acts 16 times as fast"),),
)
_FIELDBUS = partial(
    Box,
    maker="Emerson",
    source=said("Rosemount fieldbus PID"),
    verified="maker",
    filter="fixed",
    N=10.0,
    fields=_SETTINGS,
    structures=D_ON_PV,
    unread=(said("where the derivative acts"),),
)

BOXES = (
    _DELTAV("deltav_standard", title="DeltaV PID, Standard", form="ideal"),
    _DELTAV(
        "deltav_series",
        title="DeltaV PID, Series",
        form="series",
        unread=(said("what BETA and GAMMA do in the series form"),),
    ),
    _FIELDBUS("emerson_fieldbus_standard", title=said("Fieldbus PID, standard"), form="ideal"),
    _FIELDBUS("emerson_fieldbus_series", title=said("Fieldbus PID, series"), form="series"),
)
