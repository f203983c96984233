"""A script for python-control: plant, controller, and margins with the dead time exact on the frequency axis."""

import math

from simc_core.algebra.factors import Factored
from simc_core.errors import InvalidParameter
from simc_core.implementation.exports.program import Program
from simc_core.loops.loop import factored_plant
from simc_core.plants.plant import Plant
from simc_core.wording import said


def python_control(program: Program) -> str:
    """A script. Raises InvalidParameter without a plant."""
    plant = required_plant(program, "python-control")
    pid, factored = program.pid, factored_plant(plant)
    slowest = max(plant.theta, *(abs(tau) for tau in plant.lags), *(tau for tau, _ in plant.lag_pairs), 0.0) or 1.0
    fastest = min([tau for tau in (plant.theta, *map(abs, plant.lags), pid.tau_F) if tau] or [1.0])
    Kd, Kp, Ki = float(pid.Kd), float(pid.Kp), float(pid.Ki)
    den = [float(pid.tau_F), 1.0, 0.0] if Ki else [float(pid.tau_F), 1.0]
    num = [Kd, Kp, Ki] if Ki else [Kd, Kp]
    return "\n".join(
        [
            '"""',
            *program.header,
            '"""',
            "",
            "import numpy as np",
            "from control import tf",
            "",
            f"G = {_product(factored)}  # without its dead time",
            f"theta = {float(plant.theta)!r}",
            f"C = tf({num}, {den})",
            "",
            f"omega = np.geomspace({1e-5 / slowest:.3g}, {100 / fastest:.3g}, 20000)",
            "L = (G * C)(1j * omega) * np.exp(-1j * omega * theta)  # the dead time is exact here",
            "Ms = np.max(np.abs(1 / (1 + L)))",
            "Mt = np.max(np.abs(L / (1 + L)))",
            'print(f"Ms = {Ms:.4f}, Mt = {Mt:.4f} of the continuous loop; they mean nothing if it is not stable")',
            "",
        ]
    )


def _product(factored: Factored) -> str:
    """The rational part as a product of python-control transfer functions."""
    parts = [repr(float(factored.gain))]
    parts += [f"tf({_row(row)}, [1.0])" for row in factored.num.tolist()]
    parts += [f"tf([1.0], {_row(row)})" for row in factored.den.tolist()]
    return " * ".join(parts) if len(parts) > 1 else f"tf([{parts[0]}], [1.0])"


def _row(row: list[float]) -> list[float]:
    first = next(i for i, value in enumerate(row) if value)
    return row[first:]


def required_plant(program: Program, language: str) -> Plant:
    """The plant. Raises InvalidParameter where there is none."""
    if program.plant is None or not math.isfinite(program.plant.k):
        raise InvalidParameter(
            said("plant must be given for {language}, which simulates the loop, found None", language=language)
        )
    return program.plant
