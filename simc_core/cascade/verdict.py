"""Whether a cascade pays: all its numbers beside those of a single loop, the worse ones too."""

from dataclasses import dataclass

from simc_core.metrics.nested_performance import NestedPerformance
from simc_core.notation import number
from simc_core.reduction.records import LARGEST_MS

WORSE = 1.1  # an IAE that is larger by no more than 10 % counts as equal
STEPS = ("r", "d1", "d2")
DIGITS = 3


@dataclass(frozen=True, slots=True)
class CascadeVerdict:
    """IAE after unit steps of r, d1, d2 and peaks Ms, of the cascade and of the single loop.

    pays: d2 is answered better, no other IAE is more than 10 % larger, and no Ms is above 2 unless that of the single
    loop is larger still.
    """

    IAE: tuple[float, float, float]
    IAE_single: tuple[float, float, float]
    Ms_outer: float
    Ms_inner: float
    Ms_single: float

    @property
    def worse(self) -> tuple[str, ...]:
        """What is worse than with a single loop."""
        rows = zip(STEPS, self.IAE, self.IAE_single, strict=True)
        found = [f"IAE {step}" for step, ours, single in rows if ours > WORSE * single]
        peaks = (("outer Ms", self.Ms_outer), ("inner Ms", self.Ms_inner))
        found += [name for name, Ms in peaks if Ms > max(LARGEST_MS * (1 + 1e-6), self.Ms_single)]
        return tuple(found)

    @property
    def pays(self) -> bool:
        """See the class."""
        return self.IAE[2] < self.IAE_single[2] and not self.worse

    @property
    def text(self) -> str:
        """The verdict with every number it rests on, as "x (y)": x with the cascade, y with a single loop."""
        ours, single = self.IAE[2], self.IAE_single[2]
        gain = f"load d2 {number(single / ours, 2)} times better" if ours < single else "load d2 is answered no better"
        price = f", but worse: {', '.join(self.worse)}" if self.worse else ""
        rows = zip(STEPS, self.IAE, self.IAE_single, strict=True)
        each = ", ".join(f"{step} {number(a, DIGITS)} ({number(b, DIGITS)})" for step, a, b in rows)
        peaks = f"outer {number(self.Ms_outer, DIGITS)}, inner {number(self.Ms_inner, DIGITS)}"
        return (
            f"The cascade {'pays' if self.pays else 'does not pay'}: {gain}{price}. "
            f"IAE with it (with a single loop): {each}. Ms: {peaks} ({number(self.Ms_single, DIGITS)})."
        )


def cascade_verdict(
    cascade: NestedPerformance, Ms_outer: float, Ms_inner: float, single: NestedPerformance, Ms_single: float
) -> CascadeVerdict:
    """Compare a sound cascade with the single loop round the same blocks; both must be stable."""
    ours, alone = [(each.setpoint.IAE, each.disturbance.IAE, each.disturbance2.IAE) for each in (cascade, single)]
    return CascadeVerdict(ours, alone, Ms_outer, Ms_inner, Ms_single)
