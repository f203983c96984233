"""The ten process pairs of [PSB], how each is designed, and what the paper prints where we have it.

Printed settings are (k, ki, kd) of the parallel form. IAE of unit steps of d1 and d2. Msa of each design
is the paper's constraint where a row is listed, and a usual one elsewhere.
"""

from dataclasses import dataclass
from functools import lru_cache

from simc_core.cascade.by_simc import simc_cascade
from simc_core.cascade.by_synthesis import synthesis_cascade
from simc_core.cascade.design import CascadeDesign
from simc_core.metrics.nested_performance import NestedPerformance
from simc_core.metrics.performance import performance
from simc_core.plants.plant import Plant
from simc_core.sensitivity.margins import margins
from simc_core.sensitivity.margins_of_response import Margins
from simc_core.wording import said

ROUNDED = said("The authors round lambda; the exact Ms moves the settings by up to 1.2 %.")
AT_ITS_LIMIT = said("The dead times outside exceed its lags: direct synthesis is at its limit.")
CANCELLED = said("The outer filter cancels the inner zero: N = 20 gives kd < 0.")
NOT_BELOW = said("No stable outer loop has Ms below 3.1: theta is 0.4 of the lag.")


@dataclass(frozen=True, slots=True)
class Published:
    """Printed numbers: Ca and Cb (k, ki, kd), b, peaks and IAE; None where nothing is printed."""

    outer: tuple[float, float, float]
    inner: tuple[float, float, float]
    b: float
    Msa: float | None
    Mpa: float | None
    Msb: float | None
    IAE_d1: float
    IAE_d2: float


@dataclass(frozen=True, slots=True)
class PairRow:
    """One design of a pair. name: as in the paper, or the pair alone; N_outer as in synthesis_cascade."""

    name: str
    pair: int
    method: str
    inner: str = "PID"
    outer: str = "PID"
    Ms_inner: float = 2.0
    Ms_outer: float = 2.0
    N_outer: float | None = 20.0
    published: Published | None = None
    note: str = ""

    @property
    def blocks(self) -> tuple[Plant, Plant]:
        """Ga, Gb."""
        return PAIRS[self.pair]


PAIRS: dict[int, tuple[Plant, Plant]] = {
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

ROWS = (
    PairRow(
        *("1a", 1, "synthesis"),
        published=Published((0.5524, 0.1061, 0.4884), (3.3928, 0.8250, 3.7773), 0.3, 2.0, 1.10, 2.0, 9.47, 2.31),
        note=ROUNDED,
    ),
    PairRow(
        *("1b", 1, "synthesis"),
        outer="PI",
        Ms_outer=1.8,
        published=Published((0.3788, 0.0763, 0), (3.3928, 0.8250, 3.7773), 0.8, 1.8, 1.00, 2.0, 13.1, 2.69),
        note=ROUNDED,
    ),
    PairRow(
        *("1 SIMC", 1, "simc"),
        outer="PI",
        published=Published((0.3929, 0.0714, 0), (2.5, 0.5, 3.0), 1.0, 1.777, None, 1.632, 14.00, 4.11),
        note=said("tau_c = theta in both loops."),
    ),
    PairRow("2", 2, "synthesis", note=AT_ITS_LIMIT),
    PairRow(
        *("3", 3, "synthesis"),
        N_outer=1.0,
        published=Published((0.5594, 0.0742, 0.6919), (4.1129, 1.8308, 2.4420), 0.41, 2.0, 1.43, 2.0, 13.49, 2.06),
        note=said("N = 1 outside: with N = 20 kd would be negative."),
    ),
    PairRow(
        *("3 SIMC", 3, "simc"),
        outer="PI",
        published=Published((0.5, 0.0625, 0), (3.0, 1.0, 2.0), 1.0, 2.102, None, None, 16.0, 3.24),
        note=said("tau_c = theta in both loops."),
    ),
    PairRow("4", 4, "synthesis", N_outer=None, note=CANCELLED),
    PairRow("5", 5, "synthesis", Ms_outer=3.5, note=NOT_BELOW),
    PairRow(
        *("6a", 6, "synthesis"),
        outer="PI",
        published=Published((1.3709, 0.1479, 0), (15.614, 3.2769, 5.8002), 0.0, 2.0, 1.19, 2.0, 6.93, 0.27),
        note=ROUNDED,
    ),
    PairRow("7", 7, "synthesis", N_outer=None, note=CANCELLED),
    PairRow(
        *("8a", 8, "synthesis"),
        Ms_inner=5.0,
        Ms_outer=3.0,
        N_outer=None,
        published=Published((2.6181, 0.0551, 7.9475), (0.3428, 0.0665, 0.2912), 0.22, 3.0, 2.64, 5.0, 18.15, 21.1),
        note=said("The outer filter cancels the inner zero. Mpb is printed as 4.10; the printed settings give 4.065."),
    ),
    PairRow(
        *("9", 9, "synthesis"),
        Ms_outer=3.0,
        note=said("The paper prints k_db = 64.020, with which the loop is unstable; 2.0640 fits its Msb."),
    ),
    PairRow(
        *("10a", 10, "synthesis"),
        Ms_outer=3.05,
        published=Published((0.2086, 0.0305, 0.6076), (2.9959, 4.0580, 0.3078), 0.28, 3.05, 2.78, 2.0, 32.8, 2.60),
        note=ROUNDED,
    ),
)


@dataclass(frozen=True, slots=True)
class Judged:
    """A row designed by this program, and what its exact cascade does."""

    row: PairRow
    design: CascadeDesign
    outer: Margins
    inner: Margins
    performance: NestedPerformance

    @property
    def largest_difference(self) -> float | None:
        """Of all settings from the printed ones, relative; None where none are printed."""
        if self.row.published is None:
            return None
        found = [self.design.outer.to_parallel(), self.design.inner.to_parallel()]
        printed = [self.row.published.outer, self.row.published.inner]
        pairs = [
            (value, wanted)
            for form, settings in zip(found, printed, strict=True)
            for value, wanted in zip((form.Kp, form.Ki, form.Kd), settings, strict=True)
        ]
        return max(abs(value / wanted - 1) if wanted else abs(value) for value, wanted in pairs)


@lru_cache(maxsize=len(ROWS))  # nothing in it can change, and it takes a tenth of a second
def judged(row: PairRow) -> Judged:
    """The design of a row, and what its exact cascade does."""
    design = designed(row)
    loop = design.loop
    return Judged(row, design, margins(loop.outer_loop), margins(loop.inner_loop), performance(loop))


def designed(row: PairRow) -> CascadeDesign:
    """The design of a row, b as printed, else 1."""
    b = row.published.b if row.published else 1.0
    if row.method == "simc":
        return simc_cascade(*row.blocks, inner=row.inner, outer=row.outer, b=b)
    return synthesis_cascade(*row.blocks, row.Ms_inner, row.Ms_outer, row.inner, row.outer, N_outer=row.N_outer, b=b)
