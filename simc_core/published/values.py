"""Numbers computed once outside this program, with mpmath in 60 digits or more, by methods that share no code with it.

tests/oracles/high_precision.py holds the methods, tests/published/test_checks.py computes every number here again.
"""

from dataclasses import dataclass

from simc_core.controllers.forms import IController, SeriesPid
from simc_core.loops.loop import Loop
from simc_core.plants.plant import Plant
from simc_core.wording import said

FIRST_ORDER = Loop(Plant(1, 1, (1,)), SeriesPid(0.5, 1))  # L = e^{-s}/(2 s)
INTEGRATING = Loop(Plant(1, 1, integrators=1), SeriesPid(0.5, 8))
DOUBLE_INTEGRATING = Loop(Plant(1, 1, integrators=2), SeriesPid(0.0625, 8, 8))
PURE_DELAY = Loop(Plant(1, 1), IController(0.5))  # L = e^{-s}/(2 s)


@dataclass(frozen=True, slots=True)
class TimeCase:
    """y at t after a unit step of the set point, and after one of the load, each at t = 0. One degree of freedom."""

    what: str
    plant: Plant
    controller: SeriesPid
    t: float
    setpoint: float
    load: float


TIME_CASES = (
    TimeCase(
        said("Lag dominant, τ = 8 θ"),
        *(Plant(1, 1, (8,)), SeriesPid(4, 8, c=1)),
        *(9.0, 0.9984405033172123015873, 0.1036893305130427403986),
    ),
    TimeCase(
        said("Delay dominant, τ = 0.1 θ"),
        *(Plant(1, 1, (0.1,)), SeriesPid(0.05, 0.1, c=1)),
        *(5.3, 1.034792039062500003064, -0.03045005103530858102086),
    ),
    TimeCase(
        said("Integrating"),
        *(Plant(1, 1, integrators=1), SeriesPid(0.5, 8, c=1)),
        *(12.0, 1.076433252791202915716, 0.5152505434265529397323),
    ),
    TimeCase(
        said("Two lags, PID with filter"),
        *(Plant(1, 1, (6, 3)), SeriesPid(3, 6, 3, 0.3, c=1)),
        *(8.1, 0.9878618531700845308026, 0.1583201063354427009485),
    ),
    TimeCase(
        said("Unstable, 1/(4s − 1)"),
        *(Plant(-1, 1, (-4,)), SeriesPid(2.0, 20, c=1)),
        *(9.3, 1.916694589556226380332, 0.6796218770786712122774),
    ),
    TimeCase(
        said("Order 12, lags 0.01 to 100"),
        *(Plant(1, 2, (100, 50, 20, 10, 5, 2, 1, 0.5, 0.2, 0.1, 0.05, 0.01)), SeriesPid(2, 100, c=1)),
        *(60.0, 0.1200230400427599281473, 0.0530305838547057872708),
    ),
    TimeCase(
        said("1/(s + 1)⁸, no dead time"),
        *(Plant(1, 0, (1,) * 8), SeriesPid(0.2, 1.5, c=1)),
        *(12.0, 0.7126218242027221515155, 0.8466712866354586759385),
    ),
    TimeCase(
        said("RHP zero, pair of ζ = 0.2"),
        *(Plant(1, 1, (2,), (-0.7,), 0, ((1, 0.2),)), SeriesPid(0.3, 2, c=1)),
        *(9.3, 0.8196850398551739865281, 0.3519073472032808533352),
    ),
)

# Unit set-point step of PURE_DELAY: y is a polynomial between whole times
STEP_METRICS = {
    "IAE": 2.168690618938564624381,
    "ISE": 1.685796417168339635569,
    "ITAE": 2.877926621142298549564,
    "TV": 1.08434530946928231219,
    "overshoot": 0.04051959973794072653282,
    "peak_time": 4.740078950105126835233,
}

# Smallest distance of L(j omega) from -1, and crossings, by root finding
MARGIN_CASES = {
    "first order": (FIRST_ORDER, {"Ms": 1.59049023318958292563}),
    "integrating": (
        INTEGRATING,
        {
            "GM": 2.963402245951233223675,
            "PM_deg": 46.86428690933410488481,
            "delay_margin": 1.589636813130134357352,
            "Ms": 1.703521690410479574815,
        },
    ),
    "double integrating": (
        DOUBLE_INTEGRATING,
        {
            "GM": 2.760987935510925660859,
            "PM_deg": 33.10939847532740542561,
            "delay_margin": 1.094402989244054647274,
            "Ms": 1.958818514397180307083,
        },
    ),
}
