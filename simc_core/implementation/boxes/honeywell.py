"""Honeywell: UDC, TDC 3000 and Experion. Equation B of the one is not PID-B of the other."""

from functools import partial

from simc_core.implementation.boxes.box import D_ON_PV, I_ON_E, ON_E, Box, Field
from simc_core.wording import said

_UDC = partial(
    Box,
    maker="Honeywell",
    source=said("UDC2500 and UDC3300 manuals"),
    verified="maker",
    form="ideal",
    structures={"PID-A": (1.0, 1.0), "PID-B": (0.0, 0.0)},
    unread=(said("the filter of the derivative"),),
    notes=(said("RATE up to 0.08 min is off"),),
)
_RATE = Field("RATE", "Td", "min", 0.09, 10.0, 0.01, off=0.0)

BOXES = (
    _UDC(
        "honeywell_udc",
        title=said("UDC2500, UDC3300, proportional band"),
        fields=(
            Field("PB", "PB", "%", 0.1, 1000.0, 0.1),
            Field("RSET", "Ti", "min", 0.02, 50.0, 0.01),
            _RATE,
        ),
    ),
    _UDC(
        "honeywell_udc_gain",
        title=said("UDC2500, UDC3300, gain and repeats per minute"),
        fields=(
            Field("GAIN", "gain", "%/%", 0.01, 1000.0, 0.01),
            Field("RSET", "1/Ti", "1/min", 0.02, 50.0, 0.01),
            _RATE,
        ),
    ),
    Box(
        "honeywell_experion",
        maker="Honeywell",
        title="TDC 3000, Experion PID",
        source=said("texts on TDC and Experion"),
        verified="third party",
        form="ideal",
        fields=(Field("K", "gain", "%/%"), Field("T1", "Ti", "min"), Field("T2", "Td", "min")),
        structures={"Equation B": D_ON_PV["P on e, D on PV"], "Equation A": ON_E["P and D on e"]}
        | {"Equation C": I_ON_E["I on e, P and D on PV"]},
        unread=(
            said("unit of T2"),
            said("where D acts in Equation B"),
            said("ideal or interacting form"),
            said("the filter of the derivative"),
        ),
    ),
)
