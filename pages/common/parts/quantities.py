"""The figures that judge a loop: what each is called, in what unit, what it means; the same wherever it is shown.

Pure: no streamlit. Strips, tables and the live instruments take their labels from here; digits: notation.number.
"""

from dataclasses import dataclass

from simc_core.notation import number
from simc_core.studies.bands import ROBUST
from simc_core.wording import Text, said


@dataclass(frozen=True, slots=True)
class Quantity:
    """label, meaning in a sentence.   factor: from the core's number to what is shown.   unit: see unit_of."""

    label: Text
    meaning: Text
    factor: float = 1.0
    unit: str = ""

    def text(self, value: float) -> str:
        """The number as shown."""
        return number(self.factor * value)


QUANTITIES = {
    "Ms": Quantity(
        said("Ms, peak of |S|"),
        said(
            "Ms = max |1/(1+L)|: 1/Ms is the smallest distance of L from −1; up to {robust:g} is robust [SK03]",
            robust=ROBUST,
        ),
    ),
    "Ms_outer": Quantity(
        said("Ms, outer loop"),
        said("Ms = max |1/(1+La)|, inner loop closed: 1/Ms is the smallest distance of La from −1"),
    ),
    "Ms_inner": Quantity(
        said("Ms, inner loop"), said("Ms = max |1/(1+Lb)|: 1/Ms is the smallest distance of Lb from −1")
    ),
    "Mt": Quantity(said("Mt, peak of |T|"), said("Mt = max |L/(1+L)|: how much a set point is amplified at worst")),
    "GM": Quantity(said("Gain margin"), said("factor on the plant gain at which the loop becomes unstable")),
    "GM_lower": Quantity(
        said("Gain margin, lower"), said("factor below 1 on the plant gain at which the loop becomes unstable")
    ),
    "PM_deg": Quantity(said("Phase margin [°]"), said("phase the loop may lose at |L| = 1 before it becomes unstable")),
    "delay_margin": Quantity(
        said("Delay margin"), said("dead time that may be added before the loop becomes unstable"), unit="time"
    ),
    "IAE_setpoint": Quantity(
        said("IAE set point"),
        said("integral of |r − y| after a unit step of the set point, over all time"),
        unit="PV time",
    ),
    "IAE_disturbance": Quantity(
        said("IAE load"), said("integral of |r − y| after a unit step of the load, over all time"), unit="PV time"
    ),
    "IAE_d1": Quantity(
        said("IAE d₁"),
        said("integral of |r − y| after a unit step of the load d₁ at the input of Ga, over all time"),
        unit="PV time",
    ),
    "IAE_d2": Quantity(
        said("IAE d₂"),
        said("integral of |r − y| after a unit step of the load d₂ at the input of Gb, over all time"),
        unit="PV time",
    ),
    "TV_setpoint": Quantity(
        said("TV set point"),
        said("total variation of u, the wear of the actuator, after a unit step of the set point"),
        unit="OP",
    ),
    "TV_disturbance": Quantity(
        said("TV load"),
        said("total variation of u, the wear of the actuator, after a unit step of the load"),
        unit="OP",
    ),
    "overshoot": Quantity(said("Overshoot [%]"), said("of y beyond a unit step of the set point"), 100.0),
    "peak_disturbance": Quantity(
        said("Peak of y, unit load"), said("how far y goes after a unit step of the load"), unit="PV"
    ),
    "settling_setpoint": Quantity(
        said("Settling set point"), said("time until y stays within 2 % of a unit step of the set point"), unit="time"
    ),
    "settling_disturbance": Quantity(
        said("Settling load"), said("time until y stays within 2 % of a unit step of the load"), unit="time"
    ),
    "noise_gain": Quantity(
        said("Noise gain"), said("largest |K S|: from measurement noise to the input u"), unit="OP/PV"
    ),
}
