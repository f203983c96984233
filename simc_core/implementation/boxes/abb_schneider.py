"""ABB drives and Infi 90, Schneider."""

from functools import partial

from simc_core.implementation.boxes.box import D_ON_PV, ON_E, Box, Field

_SCHNEIDER = partial(
    Box,
    maker="Schneider",
    source="description of PIDFF and PI_B, its formulas are pictures",
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
        title="ACS880, ACQ580 process PID",
        source="firmware manual",
        verified="maker",
        form="ideal",
        filter="time",
        fields=(
            Field("gain", "gain", "%/%", 0.01, 100.0),
            Field("integration time", "Ti", "s", 0.0, 9999.0, off=0.0),
            Field("derivation time", "Td", "s", 0.0, 10.0),
            Field("derivation filter time", "Tf", "s", 0.0, 10.0),
        ),
        structures=ON_E,
        unread=("unit of gain, taken as %/%",),
        notes=("the derivative acts on e every 2 ms: a set-point step kicks",),
    ),
    Box(
        "abb_infi90",
        maker="ABB",
        title="Infi 90 FC19, FC156",
        source="a text on Infi 90",
        verified="third party",
        form="parallel",
        fields=(
            Field("K", "factor"),
            Field("KP", "gain", "%/%"),
            Field("KI", "Ki", "%/% 1/min"),
            Field("KD", "Kd", "%/% min"),
        ),
        structures=D_ON_PV,
        unread=("where the derivative acts",),
        notes=("K multiplies KP, KI and KD", "FC156 has a lag KA in the derivative, not in this law"),
    ),
    _SCHNEIDER(
        "schneider_pidff",
        title="PIDFF, PI_B, mixed",
        form="ideal",
        fields=(Field("kp", "gain"), Field("ti", "Ti", "s", off=0.0), Field("td", "Td", "s"), _KD),
        unread=("lag of the derivative, taken as td/kd", "where the derivative acts"),
        notes=("kp in units of output and PV; ti = 0 is the absolute form, without integral action",),
    ),
    _SCHNEIDER(
        "schneider_pidff_parallel",
        title="PIDFF, parallel",
        form="parallel",
        fields=(Field("kp", "gain"), Field("ti", "1/Ki", "%/% s", off=0.0), Field("td", "Kd", "%/% s"), _KD),
        unread=("lag of the derivative, taken as td/kd", "where the derivative acts"),
        notes=("ti and td are for a range of the output over a range of PV, whatever kp is",),
    ),
)
