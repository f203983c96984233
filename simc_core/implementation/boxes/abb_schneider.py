"""ABB drives and Infi 90, Schneider."""

from functools import partial

from simc_core.implementation.boxes.box import D_ON_PV, ON_E, Box, Field
from simc_core.wording import said

_SCHNEIDER = partial(
    Box,
    maker="Schneider",
    source=said("description of PIDFF and PI_B, its formulas are pictures"),
    verified="maker",
    filter="ratio",
    N=10.0,
    structures=D_ON_PV,
)
_KD = Field("kd", "N", "", 1e-3)

BOXES = (
    Box(
        "abb_acs880",
        maker="ABB",
        title=said("ACS880, ACQ580 process PID"),
        source=said("firmware manual"),
        verified="maker",
        form="ideal",
        filter="time",
        fields=(
            Field(said("gain"), "gain", "%/%", 0.01, 100.0),
            Field(said("integration time"), "Ti", "s", 0.0, 9999.0, off=0.0),
            Field(said("derivation time"), "Td", "s", 0.0, 10.0),
            Field(said("derivation filter time"), "Tf", "s", 0.0, 10.0),
        ),
        structures=ON_E,
        unread=(said("unit of gain, taken as %/%"),),
        notes=(said("the derivative acts on e every 2 ms: a set-point step kicks"),),
    ),
    Box(
        "abb_infi90",
        maker="ABB",
        title="Infi 90 FC19, FC156",
        source=said("a text on Infi 90"),
        verified="third party",
        form="parallel",
        fields=(
            Field("K", "factor"),
            Field("KP", "gain", "%/%"),
            Field("KI", "Ki", "%/% 1/min"),
            Field("KD", "Kd", "%/% min"),
        ),
        structures=D_ON_PV,
        unread=(said("where the derivative acts"),),
        notes=(said("K multiplies KP, KI and KD"), said("FC156 has a lag KA in the derivative, not in this law")),
    ),
    _SCHNEIDER(
        "schneider_pidff",
        title=said("PIDFF, PI_B, mixed"),
        form="ideal",
        fields=(Field("kp", "gain"), Field("ti", "Ti", "s", off=0.0), Field("td", "Td", "s"), _KD),
        unread=(said("lag of the derivative, taken as td/kd"), said("where the derivative acts")),
        notes=(said("kp in units of output and PV; ti = 0 is the absolute form, without integral action"),),
    ),
    _SCHNEIDER(
        "schneider_pidff_parallel",
        title=said("PIDFF, parallel"),
        form="parallel",
        fields=(Field("kp", "gain"), Field("ti", "1/Ki", "%/% s", off=0.0), Field("td", "Kd", "%/% s"), _KD),
        unread=(said("lag of the derivative, taken as td/kd"), said("where the derivative acts")),
        notes=(said("ti and td are for a range of the output over a range of PV, whatever kp is"),),
    ),
)
