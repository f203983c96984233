"""What the user has decided: the records behind every page, their defaults and their bounds.

Pure Python, no streamlit. links.py writes a Design as an address, project.py as a file, state.py keeps one a session.
"""

from dataclasses import dataclass, field, fields, replace
from fractions import Fraction

from pages.common.session.compared import PRESENT, Compared
from pages.common.session.home import Home
from pages.common.session.record import MOST_STRUCTURES, Chosen, Origin
from pages.common.session.sheet import Sheet, one_of, ratio
from simc_core import BOXES, Actuation, Plant, Scenario, Uncertainty, checks
from simc_core.cascade.design import HIGHEST_MS, LOWEST_MS
from simc_core.controllers.forms import FORMS, Controller
from simc_core.errors import InvalidParameter
from simc_core.plants.step_facts import StepFacts
from simc_core.rules.simc_family import FAMILY
from simc_core.rules.speed import WORDS, is_speed, times_theta

KINDS = ("PI", "PID")
METHODS = ("simc", "synthesis")
FILTERS = ("N", "zero")
RULES = ("2003", "1998")
SOURCES = ("simc", "own")
MOST_PINS = 4
LOWEST_N, HIGHEST_N = 0.1, 1000.0


@dataclass(frozen=True, slots=True)
class Tuning:
    """How a controller is made from the plant.

    rule: SIMC, or one of its later forms, which take the model of order 1.
    order: of the reduced model; 1 gives a PI, 2 a PID controller.   h, tau_F: sampling period, and filter of the box,
    that theta allows for; 0 for none. The sampling period of the design is Actuator.h, and h is that or 0.
    speed: tau_c as a choice that follows the plant, "1.5theta" or one of WORDS; "" for tight, the model's own theta.
    tau_c: closed-loop time constant as a number, which goes before speed; None for none.
    b: set-point weight.   filter: tau_F/tau_D, 0 for no filter.   rules: of the reduction, [SK03] or [SK98].
    """

    order: int = 1
    h: float = 0.0
    tau_c: float | None = None
    b: float = 1.0
    filter: float = 0.0
    rules: str = "2003"
    speed: str = ""
    tau_F: float = 0.0
    rule: str = "simc"

    def __post_init__(self):
        put = object.__setattr__
        if not is_speed(self.speed):
            words = ", ".join(WORDS)
            raise InvalidParameter(f"speed must be one of {words} or like 1.5theta, found {str(self.speed)[:40]}")
        put(self, "order", checks.whole("order", self.order, 1, 2))
        put(self, "h", checks.optional_time("h", self.h))
        put(self, "tau_F", checks.optional_time("tau_F", self.tau_F))
        if self.tau_c is not None:
            put(self, "tau_c", checks.positive_time("tau_c", self.tau_c))
        put(self, "b", checks.real("b", self.b, 0.0, 2.0))
        put(self, "filter", checks.real("filter", self.filter, 0.0, 10.0))
        one_of("rules", self.rules, RULES)
        one_of("rule", self.rule, FAMILY)

    @property
    def kind(self) -> str:
        """PI or PID, which follows from the order of the model."""
        return KINDS[self.order - 1]

    @property
    def times_theta(self) -> float | None:
        """The multiple of theta that tau_c is to be, None where the choice is another."""
        return None if self.tau_c is not None else times_theta(self.speed)


ACTUATION = tuple(each.name for each in fields(Actuation))
IN_LINKS = {"tracking_time": "T_t", "h": "sampling", "delay_scans": "scans"}  # h alone is taken, by Tuning


@dataclass(frozen=True, slots=True)
class Excitation:
    """What is asked of the loop in the figures. Metrics are those of unit steps in any case.

    setpoint, disturbance: heights of r and of the load d at the plant input.   load_time: when d begins, None for when
    the loop has settled.   setpoint_ramp, disturbance_ramp: times in which the heights are reached, 0 for steps.
    setpoint_low, setpoint_high, setpoint_rate: limits of the set point and of its speed in the controller; None for
    none. At rest r = 0, which is within.
    """

    setpoint: float = 1.0
    disturbance: float = 1.0
    load_time: float | None = None
    setpoint_ramp: float = 0.0
    disturbance_ramp: float = 0.0
    setpoint_low: float | None = None
    setpoint_high: float | None = None
    setpoint_rate: float | None = None

    def __post_init__(self):
        for name in ("setpoint_low", "setpoint_high"):
            if getattr(self, name) is not None:
                bounds = (-checks.LARGEST_GAIN, 0.0) if name == "setpoint_low" else (0.0, checks.LARGEST_GAIN)
                object.__setattr__(self, name, checks.real(name, getattr(self, name), *bounds))
        if self.setpoint_rate is not None:
            object.__setattr__(self, "setpoint_rate", checks.positive("setpoint_rate", self.setpoint_rate))
        if self.load_time is not None:
            object.__setattr__(self, "load_time", checks.optional_time("load_time", self.load_time))
        scenario = self.scenario()  # which checks the others
        for name in ("disturbance", "disturbance_ramp"):
            object.__setattr__(self, name, getattr(scenario, name))
        largest = checks.LARGEST_GAIN
        object.__setattr__(self, "setpoint", checks.real("setpoint", self.setpoint, -largest, largest))
        object.__setattr__(self, "setpoint_ramp", checks.optional_time("setpoint_ramp", self.setpoint_ramp))

    def scenario(self, **rest) -> Scenario:
        """The scenario with this and with `rest`, which goes before it."""
        own = {
            "setpoint": self.reached,
            "disturbance": self.disturbance,
            "disturbance_time": self.load_time,
            "setpoint_ramp": self.ramp,
            "disturbance_ramp": self.disturbance_ramp,
        }
        return Scenario(**own | rest)

    @property
    def reached(self) -> float:
        """The set point that its limits let through."""
        r = self.setpoint if self.setpoint_low is None else max(self.setpoint, self.setpoint_low)
        return r if self.setpoint_high is None else min(r, self.setpoint_high)

    @property
    def ramp(self) -> float:
        """The time in which it is reached, with its rate limit."""
        fastest = abs(self.reached) / self.setpoint_rate if self.setpoint_rate else 0.0
        return max(self.setpoint_ramp, fastest if fastest >= 1 / checks.LONGEST_TIME else 0.0)


@dataclass(frozen=True, slots=True)
class Actuator:
    """How the loop is built: the fields of Actuation, None for no limit.

    tracking_time: None for the default.   h: sampling period, 0 if continuous.   law: of the sampled controller.
    delay_scans: after which its output is written, 0 or 1.
    resolution, dead_band, backlash: of the actuator, 0 for none.   rate_limit: None for none.
    """

    u_min: float | None = None
    u_max: float | None = None
    tracking_time: float | None = None
    noise: float = 0.0
    seed: int = 0
    h: float = 0.0
    law: str = "backward"
    delay_scans: int = 0
    resolution: float = 0.0
    dead_band: float = 0.0
    backlash: float = 0.0
    rate_limit: float | None = None

    def __post_init__(self):
        put = object.__setattr__
        for name in ("u_min", "u_max"):
            if getattr(self, name):
                put(self, name, checks.gain(name, getattr(self, name)))
        if self.tracking_time is not None:
            put(self, "tracking_time", checks.positive_time("tracking_time", self.tracking_time))
        checks.whole("scans", self.delay_scans, 0, 1)
        scenario = self.scenario()  # which checks what it is made of
        for name in ("noise", "seed", "h", "delay_scans", "resolution", "dead_band", "backlash"):
            put(self, name, getattr(scenario.actuation, name))

    def scenario(self, excitation: Excitation = Excitation()) -> Scenario:
        """The excitation with all of this."""
        given = {name: getattr(self, name) for name in ACTUATION if getattr(self, name) is not None}
        return excitation.scenario(actuation=Actuation(**given))

    @property
    def on(self) -> bool:
        """Whether the loop as built is another one than the linear loop."""
        return not self.scenario().actuation.linear


@dataclass(frozen=True, slots=True)
class Cascade:
    """Both blocks and how their controllers are designed; None for what the method chooses itself.

    primary: Ga, the block of the outer loop.   secondary: Gb, the block of the inner loop.
    tau_c_inner, tau_c_outer: also serve as lambda of the direct synthesis; they go before the Ms of the same loop.
    N_inner, N_outer: lambda/tau_F of a PID by direct synthesis.
    filter_outer: "zero" where tau_F of the outer one is to cancel the zero of the inner loop instead.
    primary_facts, secondary_facts: as Design.facts.
    """

    primary: Plant = field(default_factory=lambda: Plant(2.0, 2.0, (5.0,)))
    secondary: Plant = field(default_factory=lambda: Plant(1.0, 1.0, (2.0, 3.0)))
    method: str = "simc"
    inner: str = "PID"
    outer: str = "PID"
    tau_c_inner: float | None = None
    tau_c_outer: float | None = None
    Ms_inner: float | None = None
    Ms_outer: float | None = None
    b: float = 1.0
    N_inner: float = 20.0
    N_outer: float = 20.0
    filter_outer: str = "N"
    primary_facts: StepFacts | None = None
    secondary_facts: StepFacts | None = None

    def __post_init__(self):
        put = object.__setattr__
        for block in ("primary", "secondary"):
            put(self, f"{block}_facts", of_plant(getattr(self, f"{block}_facts"), getattr(self, block)))
        one_of("filter_outer", self.filter_outer, FILTERS)
        one_of("method", self.method, METHODS)
        one_of("inner", self.inner, KINDS)
        one_of("outer", self.outer, KINDS)
        for name in ("tau_c_inner", "tau_c_outer"):
            if getattr(self, name) is not None:
                put(self, name, checks.positive_time(name, getattr(self, name)))
        for name in ("Ms_inner", "Ms_outer"):
            if getattr(self, name) is not None:
                put(self, name, checks.real(name, getattr(self, name), LOWEST_MS, HIGHEST_MS))
        for name in ("N_inner", "N_outer"):
            put(self, name, checks.real(name, getattr(self, name), LOWEST_N, HIGHEST_N))
        put(self, "b", checks.real("b", self.b, 0.0, 2.0))


@dataclass(frozen=True, slots=True)
class Design:
    """Everything a link or a project file holds.

    facts: of the step test that the plant was made from; None for a plant that came otherwise, or has changed since.
    source: where the controller comes from, "simc" by tuning, or "own", the settings in `own`.
    own: my settings, None until there are any.   now: what is in the plant now, the baseline; None where not told.
    pins: tunings and settings set aside to compare with the present one.
    box: what the settings are typed into, a key of BOXES, "" where not told.   home: how they are taken there.
    record: what is chosen of the record on the page From data.
    origin: of a plant that was identified; None for one that came otherwise, or has changed since.
    uncertainty: what its record leaves open, the model's own structure first; empty without an origin.
    compared: what the page of rules compares.
    """

    plant: Plant = field(default_factory=lambda: Plant(1.0, 3.0, (6.0, 4.0, 2.0)))  # [V06] example 1
    tuning: Tuning = field(default_factory=Tuning)
    form: str = "series"
    source: str = "simc"
    own: Controller | None = None
    now: Controller | None = None
    pins: tuple[Tuning | Controller, ...] = ()
    sheet: Sheet = field(default_factory=Sheet)
    cascade: Cascade = field(default_factory=Cascade)
    actuator: Actuator = field(default_factory=Actuator)
    facts: StepFacts | None = None
    excitation: Excitation = field(default_factory=Excitation)
    box: str = ""
    record: Chosen = field(default_factory=Chosen)
    origin: Origin | None = None
    uncertainty: tuple[Uncertainty, ...] = ()
    compared: Compared = field(default_factory=Compared)
    home: Home = field(default_factory=Home)

    def __post_init__(self):
        one_of("form", self.form, FORMS)
        one_of("source", self.source, SOURCES)
        one_of("box", self.box, ("", *BOXES))
        if self.source == "own" and self.own is None:
            raise InvalidParameter("own must be given where the controller is my settings, found nothing")
        object.__setattr__(self, "pins", checks.items("pins", self.pins, MOST_PINS))
        object.__setattr__(self, "facts", of_plant(self.facts, self.plant))
        if self.origin is not None and self.origin.plant != self.plant:
            object.__setattr__(self, "origin", None)
        known = checks.items("uncertainty", self.uncertainty, MOST_STRUCTURES)
        object.__setattr__(self, "uncertainty", known if self.origin is not None else ())
        if self.tuning.h not in (0.0, self.actuator.h):  # there is one sampling period
            if self.actuator.h:
                object.__setattr__(self, "tuning", replace(self.tuning, h=self.actuator.h))
            else:
                object.__setattr__(self, "actuator", replace(self.actuator, h=self.tuning.h))


# Where the field of each name lies, "" for the design itself. Links and widgets know fields by these names.
PLACES: dict[str, tuple[str, str]] = {
    **{name: ("", name) for name in ("plant", "facts", "form", "own", "now", "pins", "box", "origin", "uncertainty")},
    "controller": ("", "source"),
    **{name: ("tuning", name) for name in ("order", "h", "tau_c", "b", "filter", "rules", "speed", "tau_F", "rule")},
    **{name: ("sheet", name) for name in ("tag", "note")},
    "unit": ("sheet", "time_unit"),
    **{
        f"{signal}{end}": ("sheet", f"{signal}{end}")
        for signal in ("PV", "OP")
        for end in ("", "_unit", "_low", "_high", "_now")
    },
    "Ga": ("cascade", "primary"),
    "Gb": ("cascade", "secondary"),
    "Ga_facts": ("cascade", "primary_facts"),
    "Gb_facts": ("cascade", "secondary_facts"),
    **{name: ("cascade", name) for name in ("method", "inner", "outer")},
    **{f"{name}_{loop}": ("cascade", f"{name}_{loop}") for name in ("tau_c", "Ms", "N") for loop in ("inner", "outer")},
    "b_outer": ("cascade", "b"),
    "filter_outer": ("cascade", "filter_outer"),
    **{IN_LINKS.get(name, name): ("actuator", name) for name in ACTUATION},
    **{name: ("record", name) for name in ("example", "structure", "begin", "end", "bad")},
    **{name: ("home", name) for name in ("rounding", "language", "exported", "points", "between")},
    "r": ("excitation", "setpoint"),
    "d": ("excitation", "disturbance"),
    "d_time": ("excitation", "load_time"),
    "r_ramp": ("excitation", "setpoint_ramp"),
    "d_ramp": ("excitation", "disturbance_ramp"),
    **{f"r_{end}": ("excitation", f"setpoint_{end}") for end in ("low", "high", "rate")},
    **{f"compared_{name}": ("compared", name) for name in ("plant", "kind", "tau_F", "Ms", "criterion", "rule")},
}


def get(design: Design, name: str):
    """The field of this name in PLACES."""
    record, field_name = PLACES[name]
    return getattr(getattr(design, record) if record else design, field_name)


def put(design: Design, name: str, value) -> Design:
    """The design with another value of this field. Raises InvalidParameter."""
    record, field_name = PLACES[name]
    if name == "OP_now":
        design = replace(design, actuator=_moved(design.actuator, design.sheet.OP_now, value))
    if name == "h" and value:  # what theta allows for is the sampling period
        design = replace(design, actuator=replace(design.actuator, h=value))
    if name == "sampling" and not value:
        design = replace(design, tuning=replace(design.tuning, h=0.0))
    if not record:
        return replace(design, **{field_name: value})
    return replace(design, **{record: replace(getattr(design, record), **{field_name: value})})


def _moved(actuator: Actuator, old: float | None, new: float | None) -> Actuator:
    """Limits of u that stay where they are on the scale of OP when its operating point moves."""
    if old is None or new is None or old == new:
        return actuator
    low, high = (None if u is None else u + old - new for u in (actuator.u_min, actuator.u_max))
    if (low or 0.0) > 0 or (high or 0.0) < 0:
        ends = "no limit" if low is None else f"{low + new:g}", "no limit" if high is None else f"{high + new:g}"
        raise InvalidParameter(f"OP_now must be within the limits of the output, {' to '.join(ends)}, found {new:g}")
    return replace(actuator, u_min=low, u_max=high)


def in_time_unit(design: Design, unit: str) -> Design:
    """The same design with its times in another unit: plant, controllers, cascade, sampling, everything.

    Where the unit had no name so far, this names it and converts nothing.
    """
    time = ratio(design.sheet.time_unit, unit)
    if time == 1:
        return replace(design, sheet=replace(design.sheet, time_unit=unit))
    plant, facts = _rescaled(design.plant, design.facts, time)
    primary, primary_facts = _rescaled(design.cascade.primary, design.cascade.primary_facts, time)
    secondary, secondary_facts = _rescaled(design.cascade.secondary, design.cascade.secondary_facts, time)
    return replace(
        design,
        sheet=replace(design.sheet, time_unit=unit),
        plant=plant,
        facts=facts,
        origin=None if design.origin is None else design.origin.rescaled(plant, time),
        uncertainty=tuple(each.rescaled(time) for each in design.uncertainty),
        tuning=_in_time(design.tuning, time),
        own=None if design.own is None else design.own.rescaled(time),
        now=None if design.now is None else design.now.rescaled(time),
        pins=tuple(_in_time(pin, time) if isinstance(pin, Tuning) else pin.rescaled(time) for pin in design.pins),
        actuator=_in_time(design.actuator, time),
        excitation=_in_time(design.excitation, time),
        home=design.home.in_time(time),
        compared=_in_time(design.compared, time) if design.compared.plant == PRESENT else design.compared,
        cascade=replace(
            _in_time(design.cascade, time),
            primary=primary,
            secondary=secondary,
            primary_facts=primary_facts,
            secondary_facts=secondary_facts,
        ),
    )


TIMES = (
    *("tau_c", "h", "tau_F", "tracking_time", "tau_c_inner", "tau_c_outer"),
    *("load_time", "setpoint_ramp", "disturbance_ramp"),
)
RATES = ("rate_limit", "setpoint_rate")


def _rescaled(plant: Plant, facts: StepFacts | None, time: Fraction) -> tuple[Plant, StepFacts | None]:
    """A plant with its facts; where there are some, the plant is made from them again."""
    if facts is None:
        return plant.rescaled(time), None
    facts = facts.rescaled(time)
    return facts.plant, facts


def of_plant(facts: StepFacts | None, plant: Plant) -> StepFacts | None:
    """The facts if this is their plant; those of another plant tell nothing here."""
    return facts if facts is not None and facts.plant == plant else None


def _in_time(record, time: Fraction):
    """The record with those of its fields that are times multiplied, and its rates divided."""
    given = {name: getattr(record, name) for name in (*TIMES, *RATES) if getattr(record, name, None)}
    return replace(
        record, **{name: _scaled(value, 1 / time if name in RATES else time) for name, value in given.items()}
    )


def _scaled(value: float, ratio: Fraction) -> float:
    return value * ratio.numerator / ratio.denominator
