"""The figures that judge a loop: what each is called, in what unit, what it means; the same wherever it is shown.

Pure: no streamlit. Strips, tables and the live instruments take their labels from here; digits: notation.number.
"""

from dataclasses import dataclass

from simc_core.notation import number
from simc_core.studies.bands import ROBUST


@dataclass(frozen=True, slots=True)
class Quantity:
    """label, meaning in a sentence.   factor: from the core's number to what is shown.   unit: see unit_of."""

    label: str
    meaning: str
    factor: float = 1.0
    unit: str = ""

    def text(self, value: float) -> str:
        """The number as shown."""
        return number(self.factor * value)


_MS = "1/Ms is the smallest distance of"
_IAE = "integral of |r − y| after a unit step of"
_TV = "total variation of u, the wear of the actuator, after a unit step of"
_SETTLING = "time until y stays within 2 % of a unit step of"
QUANTITIES = {
    "Ms": Quantity("Ms, peak of |S|", f"Ms = max |1/(1+L)|: {_MS} L from −1; up to {ROBUST:g} is robust [SK03]"),
    "Ms_outer": Quantity("Ms, outer loop", f"Ms = max |1/(1+La)|, inner loop closed: {_MS} La from −1"),
    "Ms_inner": Quantity("Ms, inner loop", f"Ms = max |1/(1+Lb)|: {_MS} Lb from −1"),
    "Mt": Quantity("Mt, peak of |T|", "Mt = max |L/(1+L)|: how much a set point is amplified at worst"),
    "GM": Quantity("Gain margin", "factor on the plant gain at which the loop becomes unstable"),
    "GM_lower": Quantity("Gain margin, lower", "factor below 1 on the plant gain at which the loop becomes unstable"),
    "PM_deg": Quantity("Phase margin [°]", "phase the loop may lose at |L| = 1 before it becomes unstable"),
    "delay_margin": Quantity(
        "Delay margin", "dead time that may be added before the loop becomes unstable", unit="time"
    ),
    "IAE_setpoint": Quantity("IAE set point", f"{_IAE} the set point, over all time", unit="PV time"),
    "IAE_disturbance": Quantity("IAE load", f"{_IAE} the load, over all time", unit="PV time"),
    "IAE_d1": Quantity("IAE d₁", f"{_IAE} the load d₁ at the input of Ga, over all time", unit="PV time"),
    "IAE_d2": Quantity("IAE d₂", f"{_IAE} the load d₂ at the input of Gb, over all time", unit="PV time"),
    "TV_setpoint": Quantity("TV set point", f"{_TV} the set point", unit="OP"),
    "TV_disturbance": Quantity("TV load", f"{_TV} the load", unit="OP"),
    "overshoot": Quantity("Overshoot [%]", "of y beyond a unit step of the set point", 100.0),
    "peak_disturbance": Quantity("Peak of y, unit load", "how far y goes after a unit step of the load", unit="PV"),
    "settling_setpoint": Quantity("Settling set point", f"{_SETTLING} the set point", unit="time"),
    "settling_disturbance": Quantity("Settling load", f"{_SETTLING} the load", unit="time"),
    "noise_gain": Quantity("Noise gain", "largest |K S|: from measurement noise to the input u", unit="OP/PV"),
}
