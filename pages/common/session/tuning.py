"""How a controller is made from the plant: the record behind the tuning page. Pure: no streamlit."""

from dataclasses import dataclass

from simc_core import checks
from simc_core.errors import InvalidParameter
from simc_core.rules.simc_family import FAMILY
from simc_core.rules.speed import WORDS, is_speed, times_theta
from simc_core.wording import said

KINDS = ("PI", "PID")
RULES = ("2003", "1998")


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
            choices = ", ".join(WORDS)
            raise InvalidParameter(
                said(
                    "speed must be one of {choices} or like 1.5theta, found {speed}",
                    choices=choices,
                    speed=str(self.speed)[:40],
                )
            )
        put(self, "order", checks.whole("order", self.order, 1, 2))
        put(self, "h", checks.optional_time("h", self.h))
        put(self, "tau_F", checks.optional_time("tau_F", self.tau_F))
        if self.tau_c is not None:
            put(self, "tau_c", checks.positive_time("tau_c", self.tau_c))
        put(self, "b", checks.real("b", self.b, 0.0, 2.0))
        put(self, "filter", checks.real("filter", self.filter, 0.0, 10.0))
        checks.one_of("rules", self.rules, RULES)
        checks.one_of("rule", self.rule, FAMILY)

    @property
    def kind(self) -> str:
        """PI or PID, which follows from the order of the model."""
        return KINDS[self.order - 1]

    @property
    def times_theta(self) -> float | None:
        """The multiple of theta that tau_c is to be, None where the choice is another."""
        return None if self.tau_c is not None else times_theta(self.speed)
