"""Plants to begin with: everyday processes with typical numbers, and those of the papers, each with its source.

The ten cascade pairs are in cascade/pairs.py.

[SK98] Skogestad 1998; [SK03] Skogestad, J. Process Control 13 (2003) 291; [V06] Viteckova 2006;
[SG12] Skogestad and Grimholt 2012.
"""

from dataclasses import dataclass

from simc_core.plants.plant import Plant
from simc_core.wording import said


@dataclass(frozen=True, slots=True)
class Example:
    """A named plant. note: what it is there to show."""

    key: str
    name: str
    plant: Plant
    source: str
    note: str


TYPICAL = said("Typical values.")

EVERYDAY = (
    Example(
        "temperature",
        said("Temperature, slow"),
        Plant(2.2, 20.0, (180.0,)),
        TYPICAL,
        said("A heater: lag of minutes, dead time of seconds. Times in s."),
    ),
    Example("flow", said("Flow"), Plant(0.8, 0.5, (1.5, 0.3)), TYPICAL, said("A valve and a short line. Times in s.")),
    Example("level", said("Level"), Plant(0.05, 2.0, integrators=1), TYPICAL, said("A tank integrates. Times in s.")),
    Example(
        "pressure",
        said("Pressure"),
        Plant(-1.5, 4.0, (20.0, 3.0)),
        TYPICAL,
        said("Opening the vent lowers it: negative gain, direct action. Times in s."),
    ),
    Example(
        "exchanger",
        said("Temperature behind a heat exchanger"),
        Plant(1.4, 12.0, (45.0, 20.0, 8.0)),
        TYPICAL,
        said("Three lags and transport: here derivative action is worth a look. Times in s."),
    ),
    Example(
        "drum",
        said("Drum level, shrink and swell"),
        Plant(0.02, 5.0, (8.0,), (-10.0,), 1),
        TYPICAL,
        said("First it goes the wrong way: an inverse response on an integrator. Times in s."),
    ),
)

SK03 = said("[SK03] Table 4")

EXAMPLES = (
    Example(
        "V06-1",
        said("V06 example 1"),
        Plant(1.0, 3.0, (6.0, 4.0, 2.0)),
        said("[V06] example 1"),
        said("Three lags and a dead time: the half rule at its plainest."),
    ),
    Example(
        "V06-2",
        said("V06 example 2"),
        Plant(1.0, 0.0, (10.0, 6.0, 1.0), (-2.0,)),
        said("[V06] example 2"),
        said("An inverse response acts like dead time."),
    ),
    Example(
        "SK98-1",
        said("SK98 example 1"),
        Plant(1.0, 0.0, (20.0, 10.0, 4.0, 2.0, 0.5, 0.5, 0.5), (-3.0, 0.8)),
        said("[SK98] example 1"),
        said("Seven lags and two zeros. tau_D = 7.7 is printed; it is 12."),
    ),
    Example(
        "SK98-2",
        said("SK98 example 2 (unstable)"),
        Plant(1.0, 0.0, (20.0, -10.0, 2.0, 0.5, 0.5, 0.5), (8.0,)),
        said("[SK98] example 2"),
        said("One unstable pole; published with the rules of 1998 and order 2: tau2 13, theta 2.5."),
    ),
    Example(
        "E1",
        "SK03 E1",
        Plant(1.0, 0.0, (1.0, 0.2)),
        SK03,
        said("Two lags and no dead time: order 2 leaves theta = 0, so you choose tau_c."),
    ),
    Example(
        "E2",
        "SK03 E2",
        Plant(1.0, 0.0, (2.0, 1.0, 0.4, 0.2, 0.05, 0.05, 0.05), (-0.3, 0.08)),
        SK03,
        said("Rule T3, and a ratio of exactly 1.6 that floating-point arithmetic gets wrong."),
    ),
    Example(
        "E4",
        "SK03 E4",
        Plant(1.0, 0.0, (1.0, 1.0, 1.0, 1.0)),
        SK03,
        said("Four equal lags: tau1 and tau2 change places."),
    ),
    Example(
        "E6",
        "SK03 E6",
        Plant(1.0, 0.0, (1.0, 1.0, 0.028), (0.17, 0.17), 1),
        SK03,
        said(
            "An integrator and two zeros, several self-consistent delays. Printed for PI: theta 1.69, all lags in full."
        ),
    ),
    Example("E7", "SK03 E7", Plant(1.0, 0.0, (1.0, 1.0, 1.0), (-2.0,)), SK03, said("A large inverse response.")),
    Example("E9", "SK03 E9", Plant(1.0, 1.0, (1.0, 1.0)), SK03, said("Two equal lags and as much dead time.")),
    Example(
        "E12",
        "SK03 E12",
        Plant(1.0, 0.3, (10.0, 8.0, 1.0), (6.0, 3.0)),
        SK03,
        said("Rule T2 twice; theta = 0.3 and 0.8 are both self-consistent."),
    ),
    Example(
        "lag",
        said("FOPDT, lag dominant"),
        Plant(1.0, 1.0, (8.0,)),
        said("[SG12] Table 5.3"),
        said("tau_I = 8 theta = tau1: both bounds meet."),
    ),
    Example("delay", said("FOPDT, delay dominant"), Plant(1.0, 1.0, (0.1,)), "[SG12]", said("Almost pure dead time.")),
    Example(
        "integrating",
        said("Integrating"),
        Plant(1.0, 1.0, integrators=1),
        said("[SK03] Table 3, case 2"),
        said("Such as a tank level."),
    ),
    Example(
        "double",
        said("Double integrating"),
        Plant(1.0, 1.0, integrators=2),
        said("[SK03] Table 3, case 4"),
        said("Needs derivative action."),
    ),
    Example(
        "dead-time",
        said("Pure dead time"),
        Plant(1.0, 1.0),
        said("[SK03] Table 3, case 1"),
        said("Integral action alone."),
    ),
    Example(
        "oscillating",
        said("Oscillating"),
        Plant(1.0, 1.0, lag_pairs=((4.0, 0.3),)),
        said("[SK98], rule for zeta < 1"),
        said(
            "Set-point steps and input disturbances both ring: the controller cancels the poles, it does not damp them."
        ),
    ),
    Example(
        "unstable",
        said("Unstable"),
        Plant(-1.0, 1.0, (-10.0,)),
        said("[SK98] eq. 23-24"),
        said("Unstable pole at a = 0.1, a theta = 0.1: the published Ms is 1.80."),
    ),
)
