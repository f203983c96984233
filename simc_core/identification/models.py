"""The plant, and the reduced model that tuning rules take, of fitted parameters."""

from collections.abc import Mapping

from simc_core.plants.models import (
    DoubleIntegratingDelay,
    FirstOrderDelay,
    IntegratingDelay,
    Model,
    OscillatingDelay,
    SecondOrderDelay,
    UnstableDelay,
)
from simc_core.plants.plant import Plant
from simc_core.reduction.half_rule import reduced_model


def as_model(structure: str, parameters: Mapping[str, float]) -> tuple[Plant, Model]:
    """Plant and model of a structure. Raises InvalidParameter where a parameter is outside what the core works with."""
    p = parameters
    match structure:
        case "FOPDT":
            model: Model = FirstOrderDelay(p["k"], p["theta"], p["tau1"])
        case "SOPDT":
            model = SecondOrderDelay(p["k"], p["theta"], p["tau1"], p["tau2"])
        case "IPDT":
            model = IntegratingDelay(p["k_prime"], p["theta"])
        case "IPDT_lag":
            model = IntegratingDelay(p["k_prime"], p["theta"], p["tau2"])
        case "DIPDT":
            model = DoubleIntegratingDelay(p["k_double_prime"], p["theta"])
        case "oscillating":
            model = OscillatingDelay(p["k"], p["theta"], p["tau0"], p["zeta"])
        case "unstable":
            model = UnstableDelay(p["k_prime"], p["theta"], p["a"])
        case _:
            plant = Plant(p["k"], p["theta"], (p["tau1"], p["tau2"]), leads=(p["T"],))
            return plant, reduced_model(plant)
    return model.plant, model
