"""How the loop is built: limits, sampling, noise, and what the actuator does to u. Pure: no streamlit."""

from dataclasses import dataclass, fields

from pages.common.session.excitation import Excitation
from simc_core import Actuation, Scenario, checks

ACTUATION = tuple(each.name for each in fields(Actuation))


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

    def scenario(self, excitation: Excitation | None = None) -> Scenario:
        """The excitation with all of this."""
        given = {name: getattr(self, name) for name in ACTUATION if getattr(self, name) is not None}
        return (excitation or Excitation()).scenario(actuation=Actuation(**given))

    @property
    def on(self) -> bool:
        """Whether the loop as built is another one than the linear loop."""
        return not self.scenario().actuation.linear
