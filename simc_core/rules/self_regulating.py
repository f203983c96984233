"""A plant that comes to rest after a step, as some rules need it."""

from simc_core.errors import OutOfDomain
from simc_core.plants.plant import Plant
from simc_core.wording import said


def self_regulating(plant: Plant, rule: str) -> Plant:
    """The plant, which must be stable and without integrator."""
    if plant.integrators:
        raise OutOfDomain(
            said(
                "integrators must be 0 for the rule {rule}, found {integrators}: it needs a gain k",
                rule=rule,
                integrators=plant.integrators,
            )
        )
    undamped = sum(zeta == 0 for _, zeta in plant.lag_pairs)
    others = plant.unstable_poles + 2 * undamped
    if others:
        raise OutOfDomain(
            said(
                "all poles must lie in the left half plane for the rule {rule}, found {others} that do not",
                rule=rule,
                others=others,
            )
        )
    return plant
