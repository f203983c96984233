"""Yokogawa CENTUM and Foxboro I/A."""

from simc_core.implementation.boxes.box import Box, Field
from simc_core.wording import said

BOXES = (
    Box(
        "yokogawa_centum",
        maker="Yokogawa",
        title="CENTUM PID",
        source=said("IM 21B04C01 (fieldbus) and texts on CENTUM"),
        verified="third party",
        form="ideal",
        fields=(
            Field("P", "PB", "%", 0.0, 1000.0),
            Field("I", "Ti", "s", 0.1, 10_000.0),
            Field("D", "Td", "s", 0.0, 10_000.0),
        ),
        structures={"I-PD (AUT)": (0.0, 0.0), "PI-D (CAS)": (1.0, 0.0)},
        unread=(said("the filter of the derivative"),),
        notes=(said("velocity form: with its output at a limit it acts like a tracking time of one sampling period"),),
    ),
    Box(
        "foxboro_ia",
        maker="Foxboro",
        title="I/A PID",
        source=said("a text on I/A Series"),
        verified="third party",
        form="interacting",
        filter="ratio",
        N=10.0,
        fields=(
            Field("PBAND", "PB", "%"),
            Field("INT", "Ti", "min"),
            Field("DERIV", "Td", "min"),
            Field("KD", "N", "", 1e-3),
        ),
        unread=(said("units of INT and DERIV"), said("the range of KD")),
        notes=(
            said(
                "the filter of PV is a second-order Butterworth: the controller in effect has one lag of the same "
                "delay instead, so its margins are approximate"
            ),
        ),
    ),
)
