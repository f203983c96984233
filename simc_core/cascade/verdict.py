"""Whether a cascade pays: all its numbers beside those of a single loop, the worse ones too."""

from dataclasses import dataclass

from simc_core.metrics.nested_performance import NestedPerformance
from simc_core.notation import number
from simc_core.reduction.records import LARGEST_MS
from simc_core.wording import Text, joined, said

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
        peaks = ((said("outer Ms"), self.Ms_outer), (said("inner Ms"), self.Ms_inner))
        found += [name for name, Ms in peaks if Ms > max(LARGEST_MS * (1 + 1e-6), self.Ms_single)]
        return tuple(found)

    @property
    def pays(self) -> bool:
        """See the class."""
        return self.IAE[2] < self.IAE_single[2] and not self.worse

    @property
    def text(self) -> Text:
        """The verdict with every number it rests on, as "x (y)": x with the cascade, y with a single loop."""
        values = {step: number(value, DIGITS) for step, value in zip(STEPS, self.IAE, strict=True)}
        values |= {f"{step}_single": number(value, DIGITS) for step, value in zip(STEPS, self.IAE_single, strict=True)}
        rest = said(
            "IAE with it (with a single loop): r {r} ({r_single}), d1 {d1} ({d1_single}), d2 {d2} ({d2_single}). Ms: "
            "outer {outer}, inner {inner} ({single}).",
            **values,
            outer=number(self.Ms_outer, DIGITS),
            inner=number(self.Ms_inner, DIGITS),
            single=number(self.Ms_single, DIGITS),
        )
        return joined([self._outcome(), rest], " ")

    def _outcome(self) -> Text:
        ours, single = self.IAE[2], self.IAE_single[2]
        worse = joined(self.worse, ", ")
        if not ours < single:
            if worse:
                return said("The cascade does not pay: load d2 is answered no better, but worse: {worse}.", worse=worse)
            return said("The cascade does not pay: load d2 is answered no better.")
        ratio = number(single / ours, 2)
        if worse:
            return said(
                "The cascade does not pay: load d2 {ratio} times better, but worse: {worse}.", ratio=ratio, worse=worse
            )
        return said("The cascade pays: load d2 {ratio} times better.", ratio=ratio)


def cascade_verdict(
    cascade: NestedPerformance, Ms_outer: float, Ms_inner: float, single: NestedPerformance, Ms_single: float
) -> CascadeVerdict:
    """Compare a sound cascade with the single loop round the same blocks; both must be stable."""
    ours, alone = [(each.setpoint.IAE, each.disturbance.IAE, each.disturbance2.IAE) for each in (cascade, single)]
    return CascadeVerdict(ours, alone, Ms_outer, Ms_inner, Ms_single)
