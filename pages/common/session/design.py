"""What the user has decided: the record that holds the others, with defaults and bounds.

Pure: no streamlit. fields.py knows its fields by name, links.py writes it as an address, project.py as a file, state.py
keeps one a session.
"""

from dataclasses import dataclass, field, replace

from pages.common.session.actuator import Actuator
from pages.common.session.cascade import Cascade
from pages.common.session.compared import Compared
from pages.common.session.excitation import Excitation
from pages.common.session.facts import of_plant
from pages.common.session.home import Home
from pages.common.session.record import MOST_STRUCTURES, Chosen, Origin
from pages.common.session.sheet import Sheet
from pages.common.session.tuning import Tuning
from simc_core import BOXES, Plant, Uncertainty, checks
from simc_core.controllers.forms import FORMS, Controller
from simc_core.errors import InvalidParameter
from simc_core.plants.step_facts import StepFacts
from simc_core.wording import said

SOURCES = ("simc", "own")
MOST_PINS = 4


@dataclass(frozen=True, slots=True)
class Design:
    """Everything a link or a project file holds.

    facts: of the step test that the plant was made from; None for a plant that came otherwise, or has changed since.
    source: where the controller comes from, "simc" by tuning, or "own", the settings in `own`.
    own: my settings, None until there are any.   now: what is in the plant now, the baseline; None where not told.
    pins: tunings and settings set aside to compare with the present one.
    box: what the settings are typed into, a key of BOXES, "" where not told.   home: how they are taken there.
    record: what is chosen of the record on the page From data.
    origin: of a plant that was identified; None for one that came otherwise, or has changed since.
    uncertainty: what its record leaves open, the model's own structure first; empty without an origin.
    compared: what the page of rules compares.
    """

    plant: Plant = field(default_factory=lambda: Plant(1.0, 3.0, (6.0, 4.0, 2.0)))  # [V06] example 1
    tuning: Tuning = field(default_factory=Tuning)
    form: str = "series"
    source: str = "simc"
    own: Controller | None = None
    now: Controller | None = None
    pins: tuple[Tuning | Controller, ...] = ()
    sheet: Sheet = field(default_factory=Sheet)
    cascade: Cascade = field(default_factory=Cascade)
    actuator: Actuator = field(default_factory=Actuator)
    facts: StepFacts | None = None
    excitation: Excitation = field(default_factory=Excitation)
    box: str = ""
    record: Chosen = field(default_factory=Chosen)
    origin: Origin | None = None
    uncertainty: tuple[Uncertainty, ...] = ()
    compared: Compared = field(default_factory=Compared)
    home: Home = field(default_factory=Home)

    def __post_init__(self):
        checks.one_of("form", self.form, FORMS)
        checks.one_of("source", self.source, SOURCES)
        checks.one_of("box", self.box, ("", *BOXES))
        if self.source == "own" and self.own is None:
            raise InvalidParameter(said("own must be given where the controller is my settings, found nothing"))
        object.__setattr__(self, "pins", checks.items("pins", self.pins, MOST_PINS))
        object.__setattr__(self, "facts", of_plant(self.facts, self.plant))
        if self.origin is not None and self.origin.plant != self.plant:
            object.__setattr__(self, "origin", None)
        known = checks.items("uncertainty", self.uncertainty, MOST_STRUCTURES)
        object.__setattr__(self, "uncertainty", known if self.origin is not None else ())
        if self.tuning.h not in (0.0, self.actuator.h):  # there is one sampling period
            if self.actuator.h:
                object.__setattr__(self, "tuning", replace(self.tuning, h=self.actuator.h))
            else:
                object.__setattr__(self, "actuator", replace(self.actuator, h=self.tuning.h))
