"""Siemens: PID_Compact, PID_Temp, FB41 CONT_C, TCONT_CP, PCS 7."""

from functools import partial

from simc_core.implementation.boxes.box import D_ON_PV, Box, Field
from simc_core.wording import said

_TI, _TD = Field("TI", "Ti", "s"), Field("TD", "Td", "s")
_COMPACT = partial(
    Box,
    maker="Siemens",
    verified="maker",
    form="ideal",
    filter="ratio",
    N=5.0,
    fields=(
        Field("Gain", "gain", "%/PV"),
        Field("Ti", "Ti", "s", off=0.0),
        Field("Td", "Td", "s"),
        Field("TdFiltRatio", "1/N", "", 1e-6),
        Field("PWeighting", "b", "", 0.0, 1.0),
        Field("DWeighting", "c", "", 0.0, 1.0),
    ),
    actions=("InvertControl = FALSE", "InvertControl = TRUE"),
    unread=(said("unit of Gain, taken as % of output for one unit of PV"),),
    notes=(said("TdFiltRatio = 0 takes the derivative away, not its filter"),),
)

BOXES = (
    _COMPACT(
        "siemens_pid_compact",
        title="PID_Compact, PID_3Step",
        source=said("Function Manual 03/2017; S7-1200 manual"),
    ),
    _COMPACT("siemens_pid_temp", title="PID_Temp", source=said("parameters of PID_Temp")),
    Box(
        "siemens_cont_c",
        maker="Siemens",
        title="FB41 CONT_C",
        source=said("a text on FB41"),
        verified="third party",
        form="ideal",
        filter="time",
        fields=(Field("GAIN", "gain", "%/%"), _TI, _TD, Field("TM_LAG", "Tf", "s")),
        structures=D_ON_PV,
        sign=1,
        actions=(said("positive {field}", field="GAIN"), said("negative {field}", field="GAIN")),
        unread=(said("unit of GAIN, taken as %/%"), said("where the derivative acts")),
    ),
    Box(
        "siemens_tcont_cp",
        maker="Siemens",
        title="TCONT_CP",
        source=said("description of TCONT_CP"),
        verified="maker",
        form="ideal",
        filter="ratio",
        N=5.0,
        fields=(
            Field("GAIN", "gain", "%/PV"),
            _TI,
            _TD,
            Field("D_F", "N", "", 5.0, 10.0),
            Field("PFAC_SP", "b", "", 0.0, 1.0),
        ),
        unread=(said("unit of GAIN, taken as % of output for one unit of PV"), said("where the derivative acts")),
    ),
    Box(
        "siemens_pcs7",
        maker="Siemens",
        title="PCS 7 CTRL_PID, PIDConL",
        source=said("a text on PCS 7"),
        verified="third party",
        form="ideal",
        filter="ratio",
        N=5.0,
        fields=(Field("Gain", "gain", "%/%"), _TI, _TD, Field("DiffGain", "N", "", 1.0, 10.0)),
        structures=D_ON_PV,
        unread=(said("unit of Gain, taken as %/%"), said("where the derivative acts")),
    ),
)
