"""The ten process pairs of [PSB], Ga and Gb, typed from shared/cascade.md and not from the program's own list."""

from simc_core import Plant

PAIRS = {
    1: (Plant(2, 2, (5,)), Plant(1, 1, (2, 3))),
    2: (Plant(1, 1, (1, 1)), Plant(1, 0.1, (0.1,))),
    3: (Plant(1, 0.25, integrators=1), Plant(1, 0.5, (1, 2))),
    4: (Plant(2, 1, (10,)), Plant(1, 0.5, integrators=1)),
    5: (Plant(-1, 3, (-10,)), Plant(2, 1, (1,))),
    6: (Plant(2, 2, (20,)), Plant(-1, 1, (-20,))),
    7: (Plant(0.5, 0.7, integrators=1), Plant(-2, 1, (-20,))),
    8: (Plant(-1, 4, (-20,)), Plant(2, 2, integrators=1)),
    9: (Plant(-1, 4, (-20,)), Plant(-2, 0.1, (-10,))),
    10: (Plant(1, 0.7, integrators=2), Plant(1, 0.3, (1,))),
}
