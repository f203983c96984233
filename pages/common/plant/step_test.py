"""A plant from the facts of a step test; the facts stay with the plant, in links and files too."""

from pages.common.plant.number_form import Field, NumberForm
from pages.common.session import state
from simc_core import checks
from simc_core.plants.step_facts import SettlingFacts, SlopeFacts, StepFacts
from simc_core.wording import said

FACTS = {"plant": "facts", "Ga": "Ga_facts", "Gb": "Gb_facts"}
FROM_STEP, FROM_MOVEMENT, SLOPE = said("63 % from step"), said("63 % from movement"), said("Integrating")
FIELDS = {
    "dOP": Field(said("Change of OP"), checks.gain, unit=said("OP"), help=said("With its sign: from 40 to 45 is 5.")),
    "dPV": Field(said("Change of PV, to its new rest"), checks.gain, unit=said("PV"), help=said("With its sign.")),
    "rise": Field(
        said("Change of PV in the time below"),
        checks.gain,
        unit=said("PV"),
        help=said(
            "Once PV moves, with its sign. If PV drifted before the step, less what the drift alone would have been."
        ),
    ),
    "duration": Field(
        said("Time it took"), checks.positive_time, 1.0, help=said("Empty: the change above is that of the slope.")
    ),
    "theta": Field(
        said("Dead time θ"), checks.optional_time, help=said("From the step of OP until PV begins to move.")
    ),
    "t63": Field(
        said("Time to 63 % from the step"),
        checks.optional_time,
        help=said("From the step of OP: the dead time counts."),
    ),
    "tau1": Field(
        said("Time to 63 % from first movement"), checks.optional_time, help=said("From the end of the dead time.")
    ),
}
KINDS = {
    FROM_STEP: ("dOP", "dPV", "theta", "t63"),
    FROM_MOVEMENT: ("dOP", "dPV", "theta", "tau1"),
    SLOPE: ("dOP", "rise", "duration", "theta"),
}


def facts_of(kind: str, values: dict[str, float]) -> StepFacts:
    """The facts that the numbers of one kind are. Raises InvalidParameter."""
    if kind == SLOPE:
        return SlopeFacts(values["dOP"], values["rise"], values["theta"], values["duration"])
    time = values["t63"] if kind == FROM_STEP else values["tau1"]
    return SettlingFacts(values["dOP"], values["dPV"], values["theta"], time, kind == FROM_MOVEMENT)


def _begun(name: str) -> tuple[str | None, dict[str, float]]:
    match state.value(FACTS[name]):
        case SlopeFacts(dOP, dPV, theta, duration):
            return SLOPE, {"dOP": dOP, "rise": dPV, "theta": theta, "duration": duration}
        case SettlingFacts(dOP, dPV, theta, t63, False):
            return FROM_STEP, {"dOP": dOP, "dPV": dPV, "theta": theta, "t63": t63}
        case SettlingFacts(dOP, dPV, theta, tau1):
            return FROM_MOVEMENT, {"dOP": dOP, "dPV": dPV, "theta": theta, "tau1": tau1}
    return None, {}


def _change(name: str, kind: str, values: dict[str, float]) -> dict:
    facts = facts_of(kind, values)
    return {name: facts.plant, FACTS[name]: facts}


STEP_TEST = NumberForm("step", said("Response"), FIELDS, KINDS, _begun, _change)
