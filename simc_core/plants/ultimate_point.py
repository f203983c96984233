"""The ultimate point: what a loop with proportional control alone does at its limit of stability."""

from dataclasses import dataclass

from simc_core import checks


@dataclass(frozen=True, slots=True)
class Ultimate:
    """Ultimate gain and period.

    Parameters
    ----------
    Ku : float
        Gain of a P controller at the limit, in input units per output unit; its sign is that of the plant's gain.
    Pu : float
        Period of the oscillation there, 2 pi/omega_180, in the user's time unit, > 0.

    Examples
    --------
    PI of Ziegler and Nichols: Kc = 0.45 Ku, tau_I = Pu/1.2 [ZN42]:

    >>> from simc_core import Ultimate, tune
    >>> pi = tune("zn_ultimate", Ultimate(Ku=2, Pu=12), "PI")
    >>> pi.Kc, pi.tau_I
    (0.9, 10.0)
    """

    Ku: float
    Pu: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "Ku", checks.gain("Ku", self.Ku))
        object.__setattr__(self, "Pu", checks.positive_time("Pu", self.Pu))
