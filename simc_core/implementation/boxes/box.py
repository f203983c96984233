"""What is known of a box: its law, its fields with units and ranges, its set-point structures, and where it was read.

A box has one of these laws, in the time unit and gain of the plant:

    "ideal"         Kp (1 + 1/(Ti s) + Td s/(Tf s + 1))
    "parallel"      Kp + Ki/s + Kd s/(Tf s + 1)
    "series"        Kc (1 + 1/(Ti s)) (Td s + 1)/(Tf s + 1)
    "interacting"   the same, Tf made by the box from Ti and Td: 1/Tf = KD (1/Ti + 1/Td)

and one of these filters:

    "time"      Tf is typed                 "ratio"     Td/Tf = N is typed, or its inverse alpha
    "fixed"     N cannot be changed         "none"      the law has none, or none that was read

What a box cannot filter, a filter of the measurement before it does: the field PV_FILTER.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from simc_core.wording import Text, said

Structures = dict[str, tuple[float, float]]  # name -> b, c; the first is the box's own choice

STRUCTURE = said("structure")
PV_FILTER = said("PV filter")
REVERSE, DIRECT = said("reverse", context="action"), said("direct", context="action")


@dataclass(frozen=True, slots=True)
class Field:
    """A number that is typed into a box.

    Parameters
    ----------
    name : str
        As the box writes it.
    quantity : str
        What it is: "gain", "PB", "Ti", "1/Ti", "Ki", "1/Ki", "Td", "Kd", "Tf", "N", "1/N", "b", "c", "1-b", "factor".
    unit : str
        "%/%", "%/PV" (output in % for one unit of PV), "" (units of output and PV), "%" or "units" of PV for a band;
        "s", "min", "1/s", "1/min", and for Ki and Kd of an independent form both: "%/% 1/min".
    low, high : float
        What the box takes.
    step : float or None
        Of what can be typed, None where it is not known.
    off : float or None
        What is typed for no such action, None where the box has no word for it.
    word : float
        What one unit of an integer word stands for.
    """

    name: str
    quantity: str
    unit: str = ""
    low: float = 0.0
    high: float = math.inf
    step: float | None = None
    off: float | None = None
    word: float = 1.0


@dataclass(frozen=True, slots=True)
class Box:
    """A controller that one can buy or download.

    Attributes
    ----------
    key, maker, title : str
        Name in BOXES, who makes it, its name on a page.
    source : str
        The text its law was read in.
    verified : {"maker", "third party"}
        Whose text that is. What was read in no text is in `unread`.
    form : {"ideal", "parallel", "series", "interacting"}
        Its law, see the module docstring.
    fields : tuple of Field
        What is typed.
    filter : {"none", "time", "ratio", "fixed"}
        See the module docstring.
    N : float or None
        Td/Tf that cannot be changed, or the box's own choice.
    structures : mapping of str to (b, c)
        Set-point structures to choose from; empty where b and c are typed, or one of them.
    sign : {0, 1, -1}
        0: the gain is typed positive and the action chosen. 1: a direct acting controller has a negative gain.
        -1: a reverse acting one has.
    actions : (str, str)
        What the box calls reverse acting (the output falls when PV rises) and direct acting.
    unread : tuple of Text
        What was assumed without having been read: check your manual.
    notes : tuple of Text
        What one should know.
    """

    key: str
    maker: str
    title: str
    source: str
    verified: str
    form: str
    fields: tuple[Field, ...]
    filter: str = "none"
    N: float | None = None
    structures: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    sign: int = 0
    actions: tuple[str, str] = (REVERSE, DIRECT)
    unread: tuple[Text, ...] = ()
    notes: tuple[Text, ...] = ()

    @property
    def own_N(self) -> float:
        """N of a box whose filter is a ratio."""
        assert self.N is not None, self.key  # each of them has one
        return self.N

    def field_of(self, *quantities: str) -> Field | None:
        """The field of one of these quantities, None if the box has none."""
        return next((found for found in self.fields if found.quantity in quantities), None)


ON_E: Structures = {said("P and D on e"): (1.0, 1.0)}
D_ON_PV: Structures = {said("P on e, D on PV"): (1.0, 0.0)}
I_ON_E: Structures = {said("I on e, P and D on PV"): (0.0, 0.0)}
