"""The facts of a step test that a plant was made from: with it as long as it is that plant. Pure: no streamlit."""

from fractions import Fraction

from simc_core import Plant
from simc_core.plants.step_facts import StepFacts


def of_plant(facts: StepFacts | None, plant: Plant) -> StepFacts | None:
    """The facts if this is their plant; those of another plant tell nothing here."""
    return facts if facts is not None and facts.plant == plant else None


def rescaled(plant: Plant, facts: StepFacts | None, time: Fraction) -> tuple[Plant, StepFacts | None]:
    """A plant with its facts; where there are some, the plant is made from them again."""
    if facts is None:
        return plant.rescaled(time), None
    facts = facts.rescaled(time)
    return facts.plant, facts
