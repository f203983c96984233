"""What is asked of the loop in the figures: set point and load. Pure: no streamlit."""

from dataclasses import dataclass

from simc_core import Scenario, checks


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
