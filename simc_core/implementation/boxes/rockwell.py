"""Rockwell: Logix PIDE and PID, SLC 500. Two instructions of one maker have two units."""

from functools import partial

from simc_core.implementation.boxes.box import D_ON_PV, I_ON_E, ON_E, Box, Field
from simc_core.wording import said

_TI = Field("Ti", "Ti", "min", 0.0, off=0.0)
_TD = Field("Td", "Td", "min")
_SWITCHED = D_ON_PV | ON_E | I_ON_E
_SMOOTHING = (said("how the derivative is smoothed"),)
_PIDE = partial(Box, maker="Rockwell", source="1756-RM006K p. 80", verified="maker", structures=_SWITCHED)
_PID = partial(Box, maker="Rockwell", source="1756-RM003N p. 519", verified="maker", structures=D_ON_PV | ON_E)
_NDF = (said("the smoothing of the derivative grows with Kd unless .NDF is set"),)
_SLC = partial(Box, maker="Rockwell", source="1747-RM001G", verified="maker", structures=D_ON_PV)

BOXES = (
    _PIDE(
        "rockwell_pide_dependent",
        title=said("Logix PIDE, dependent gains"),
        form="ideal",
        fields=(Field("PGain", "gain", "%/%"), Field("IGain", "Ti", "min", off=0.0), Field("DGain", "Td", "min")),
        unread=_SMOOTHING,
    ),
    _PIDE(
        "rockwell_pide_independent",
        title=said("Logix PIDE, independent gains"),
        form="parallel",
        fields=(Field("PGain", "gain", "%/%"), Field("IGain", "Ki", "%/% 1/min"), Field("DGain", "Kd", "%/% min")),
        unread=_SMOOTHING,
    ),
    _PID(
        "logix_pid_dependent",
        title=said("Logix PID, dependent gains"),
        form="ideal",
        fields=(Field("Kc", "gain", "%/%"), _TI, _TD),
        unread=(said("units, which are those of the text for PLC-5"),),
        notes=_NDF,
    ),
    _PID(
        "logix_pid_independent",
        title=said("Logix PID, independent gains"),
        form="parallel",
        fields=(Field("Kp", "gain", "%/%"), Field("Ki", "Ki", "%/% 1/s"), Field("Kd", "Kd", "%/% s")),
        unread=(said("units, which are those of the text for PLC-5"),),
        notes=(*_NDF, said("Ki is per second and Kd in seconds, unlike PIDE")),
    ),
    _SLC(
        "slc500",
        title="SLC 500 PID",
        form="ideal",
        fields=(
            Field("Kc", "gain", "%/%", 0.0, 3276.7, 0.1),
            Field("Ti", "Ti", "min", 0.0, 3276.7, 0.1, off=0.0),
            Field("Td", "Td", "min"),
        ),
        unread=(said("unit and step of Td"), said("where the derivative acts"), said("the filter of the derivative")),
    ),
    _SLC(
        "slc500_rg",
        title="SLC 500 PID, RG = 1",
        form="ideal",
        fields=(
            Field("Kc", "gain", "%/%", 0.0, 327.67, 0.01),
            Field("Ti", "Ti", "min", 0.0, 327.67, 0.01, off=0.0),
            Field("Td", "Td", "min"),
        ),
        unread=(said("unit and step of Td"), said("where the derivative acts"), said("the filter of the derivative")),
    ),
)
