"""Controllers of a panel or a small PLC that take integers: Omron, Panasonic, Eurotherm."""

from simc_core.implementation.boxes.box import D_ON_PV, I_ON_E, Box, Field
from simc_core.wording import said

BOXES = (
    Box(
        "omron_pidat",
        maker="Omron",
        title="PIDAT(191)",
        source=said("instruction manual of PIDAT(191)"),
        verified="maker",
        form="ideal",
        fields=(
            Field("P", "PB", "%", 1, 9999, 1, word=0.1),
            Field("Tik", "Ti", "s", 1, 8191, 1, off=9999, word=0.1),
            Field("Tdk", "Td", "s", 0, 8191, 1, word=0.1),
            Field("alpha", "1-b", "", 0.0, 1.0, 0.01),
        ),
        unread=(said("that the set point weighs 1 - alpha"), said("the filter of the derivative")),
        notes=(said("integer words of 0.1 % and 0.1 s; times can also be set in samples"),),
    ),
    Box(
        "panasonic_fp",
        maker="Panasonic",
        title="FP PID",
        source=said("instruction manual of FP"),
        verified="maker",
        form="ideal",
        fields=(
            Field("Kp", "gain", "%/%", 1, 9999, 1, word=0.1),
            Field("Ti", "Ti", "s", 1, 30_000, 1, word=0.1),
            Field("Td", "Td", "s", 1, 10_000, 1, off=0, word=0.1),
        ),
        structures={"I-PD": (0.0, 0.0), "PI-D": (1.0, 0.0)},
        unread=(
            said("unit of Kp, taken as %/%"),
            said("how the derivative is switched off"),
            said("the filter of the derivative"),
        ),
        notes=(said("integer words of 0.1 and 0.1 s"),),
    ),
    Box(
        "eurotherm_3116",
        maker="Eurotherm",
        title="3116",
        source=said("3116 manual"),
        verified="maker",
        form="ideal",
        fields=(
            Field("Pb", "PB", "units", 1, 9999, 1),
            Field("ti", "Ti", "s", 1, 9999, 1, off=0),
            Field("td", "Td", "s", 1, 9999, 1, off=0),
        ),
        structures=D_ON_PV | I_ON_E,
        unread=(said("form"), said("where P and D act"), said("the filter of the derivative")),
        notes=(said("the band is in units of PV; off is written as 0 here"), said("integers")),
    ),
)
