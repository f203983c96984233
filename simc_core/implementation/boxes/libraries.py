"""Function blocks and libraries: Beckhoff, CODESYS, OSCAT, IEC draft, simple-pid, Arduino, DiscretePIDs.jl, MATLAB."""

from functools import partial

from simc_core.implementation.boxes.box import D_ON_PV, I_ON_E, ON_E, Box, Field
from simc_core.wording import said

_SECONDS = (Field("TN", "Ti", "s", 1e-9), Field("TV", "Td", "s"))
_SIGNED = partial(Box, sign=1, actions=(said("positive gains"), said("negative gains")))
_MATLAB = partial(
    _SIGNED,
    maker="MathWorks",
    source=said("reference of pid, pidstd"),
    verified="maker",
    structures=ON_E,
)
_FORWARD = (said("as a discrete object ForwardEuler is the default: it needs Tf > h/2"),)
_UNFILTERED = said("the law has no filter")

BOXES = (
    Box(
        "beckhoff_ctrl_pid",
        maker="Beckhoff",
        title="FB_CTRL_PID, FB_BasicPID",
        source=said("Infosys, its formula is a picture"),
        verified="maker",
        form="ideal",
        filter="time",
        fields=(
            Field("fKp", "gain"),
            Field("tTn", "Ti", "s", off=0.0),
            Field("tTv", "Td", "s"),
            Field("tTd", "Tf", "s"),
        ),
        structures=D_ON_PV | ON_E | I_ON_E,
        sign=1,
        actions=(said("positive {field}", field="fKp"), said("negative {field}", field="fKp")),
        unread=(said("how reverse and direct action are set, taken as the sign of fKp"),),
        notes=(said("P and D go into the feedback path by two switches"),),
    ),
    _SIGNED(
        "codesys_pid",
        maker="CODESYS",
        title="Util PID",
        source=said("parameters and formula of PD in the Util library"),
        verified="maker",
        form="ideal",
        fields=(Field("KP", "gain"), *_SECONDS),
        structures=ON_E,
        notes=(
            _UNFILTERED,
            said("Y_MIN = Y_MAX = 0 means no limits"),
            said("new parameters act after a reset or in manual only"),
            said("it measures its period in whole milliseconds: PID_FIXCYCLE does not"),
        ),
    ),
    _SIGNED(
        "oscat_ctrl_pid",
        maker="OSCAT",
        title="CTRL_PID, FT_PIDWL",
        source=said("OSCAT Basic, source text"),
        verified="maker",
        form="ideal",
        fields=(Field("KP", "gain"), *_SECONDS),
        structures=ON_E,
        notes=(_UNFILTERED, said("the integral is a trapezoid")),
    ),
    Box(
        "iec_draft_pid",
        maker="OpenPLC",
        title=said("PID of the IEC 61131-3 draft"),
        source=said("source text in OpenPLC"),
        verified="maker",
        form="ideal",
        fields=(Field("KP", "gain"), Field("TR", "Ti", "s", 1e-9), Field("TD", "Td", "s")),
        structures=ON_E,
        sign=-1,
        actions=(said("negative {field}", field="KP"), said("positive {field}", field="KP")),
        notes=(
            said("its error is PV - SP: a positive KP is direct acting"),
            said("no limits and no anti-windup; TR = 0 divides by zero"),
            said("the manual output is KP X0"),
            said("the derivative is a slope through four samples, (3 (x0 - x3) + x1 - x2)/(10 h)"),
        ),
    ),
    _SIGNED(
        "simple_pid",
        maker="Python",
        title="simple-pid 2.0",
        source=said("source text"),
        verified="maker",
        form="parallel",
        fields=(Field("Kp", "gain"), Field("Ki", "Ki", "1/s"), Field("Kd", "Kd", "s")),
        structures=D_ON_PV | I_ON_E,
        notes=(_UNFILTERED, said("the integral is clamped to the limits of the output")),
    ),
    Box(
        "arduino_pid",
        maker="Arduino",
        title="PID_v1",
        source=said("source text"),
        verified="maker",
        form="parallel",
        fields=(Field("Kp", "gain"), Field("Ki", "Ki", "1/s"), Field("Kd", "Kd", "s")),
        structures=D_ON_PV | I_ON_E,
        actions=("DIRECT", "REVERSE"),
        notes=(
            _UNFILTERED,
            said("what it calls DIRECT is reverse acting elsewhere: the output rises when the measurement is too low"),
            said("the output is limited to 0-255 unless told otherwise"),
        ),
    ),
    _SIGNED(
        "discrete_pids",
        maker="Julia",
        title="DiscretePIDs.jl",
        source=said("source text"),
        verified="maker",
        form="ideal",
        filter="ratio",
        N=10.0,
        fields=(
            Field("K", "gain"),
            Field("Ti", "Ti", "s", 1e-9),
            Field("Td", "Td", "s"),
            Field("N", "N", "", 1e-3),
            Field("b", "b", "", 0.0, 2.0),
        ),
        notes=(said("the integral is updated after use; tracking time sqrt(Ti Td)"),),
    ),
    _MATLAB(
        "matlab_pid",
        title="pid",
        form="parallel",
        filter="time",
        fields=(Field("Kp", "gain"), Field("Ki", "Ki", "1/s"), Field("Kd", "Kd", "s"), Field("Tf", "Tf", "s")),
        notes=_FORWARD,
    ),
    _MATLAB(
        "matlab_pidstd",
        title="pidstd",
        form="ideal",
        filter="ratio",
        N=10.0,
        fields=(
            Field("Kp", "gain"),
            Field("Ti", "Ti", "s", 1e-9),
            Field("Td", "Td", "s"),
            Field("N", "N", "", 1e-3),
        ),
        notes=_FORWARD,
    ),
)
