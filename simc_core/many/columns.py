"""The columns of a list of loops: what each is called, what it means, and other names people give it."""

from dataclasses import dataclass

from simc_core.wording import said


@dataclass(frozen=True, slots=True)
class Column:
    """One column of a list.

    name: in a row.   meaning: for people.   unit: what its numbers are in, "" for none.   text: whether it holds words
    rather than a number.   also: other headings, in small letters, letters and digits alone.
    """

    name: str
    meaning: str
    unit: str = ""
    text: bool = False
    also: tuple[str, ...] = ()


# Headings that may mean two things ("gain", "reset", "unit", "type") are nobody's: a guess would be a wrong plant.
COLUMNS: tuple[Column, ...] = (
    Column("tag", said("name of the loop"), text=True, also=("loop", "name", "loopname", "looptag", "tagname")),
    Column("plant", said("transfer function, as exp(-2s)/(8s+1)"), text=True, also=("g", "gs", "transferfunction")),
    Column(
        "k", said("gain of the process, instead of a transfer function"), "PV/OP", also=("processgain", "plantgain")
    ),
    Column("theta", said("dead time"), "time", also=("deadtime", "delay", "totzeit", "θ")),
    Column("tau1", said("time constant"), "time", also=("tau", "lag", "lag1", "timeconstant", "t1", "τ1", "τ")),
    Column("tau2", said("second time constant, may stay empty"), "time", also=("lag2", "t2", "τ2")),
    Column("k_prime", said("slope of an integrating process, instead of k and tau1"), "PV/(OP time)", also=("slope",)),
    Column("kind", said("PI or PID; empty: PI"), text=True, also=("controllertype",)),
    Column("rule", said("a tuning rule; empty: simc"), text=True, also=("tuningrule",)),
    Column("tau_c", said("closed-loop time constant; empty: theta"), "time", also=("lambda", "τc")),
    Column("Ms", said("max(Ms, Mt) asked for, instead of tau_c"), also=("targetms",)),
    Column("filter", said("tau_F/tau_D of the new settings; empty: 0"), also=("filterratio",)),
    Column("form", said("of the present settings: ideal, series or parallel; empty: ideal"), text=True),
    Column("Kc", said("present gain"), "OP/PV", also=("controllergain",)),
    Column("tau_I", said("present integral time; empty: none"), "time", also=("ti", "integraltime", "τi")),
    Column("tau_D", said("present derivative time"), "time", also=("td", "derivativetime", "τd")),
    Column("tau_F", said("present filter time"), "time", also=("tf", "filtertime", "τf")),
    Column("Kp", said("present proportional gain of a parallel form"), "OP/PV"),
    Column("Ki", said("present integral gain of a parallel form"), "OP/(PV time)"),
    Column("Kd", said("present derivative gain of a parallel form"), "OP time/PV"),
    Column("box", said("what the settings are typed into, a key of BOXES"), text=True),
    Column("pv_span", said("range of the measurement; empty: 100"), "PV", also=("pvrange",)),
    Column("out_span", said("range of the output; empty: 100"), "OP", also=("opspan", "outrange", "oprange")),
    Column("time_unit", said("s or min, of all times; empty: s"), text=True),
)
BY_NAME = {column.name: column for column in COLUMNS}
