"""A Modelica block of the controller and, with a plant, a model of the loop; the dead time is `delay`."""

import numpy as np

from simc_core.algebra.state_space import chain
from simc_core.implementation.exports.program import (
    CHANGEABLE,
    GAINS,
    MANUAL,
    MEANING,
    SETTINGS,
    STATE,
    Program,
    written,
)
from simc_core.plants.plant import Plant

FORM = "{name} := {value};"
HELD = tuple(name for name in STATE if name != "u")


def modelica(program: Program) -> str:
    """SimcPid, and SimcLoop where the plant is known."""
    lines = [f"// {line}" for line in program.header]
    lines += ["block SimcPid"]
    lines += [
        f"  {'input' if name in CHANGEABLE else 'parameter'} Real {name} = {program.values[name]!r}"
        + (f' "{MEANING[name]}";' if MEANING[name] else ";")
        for name in SETTINGS
    ]
    lines += ["  input Real r;", "  input Real y;", "  input Real u_manual = 0.0;", "  input Real u_ff = 0.0;"]
    lines += ["  input Boolean manual = false;", "  discrete output Real u(start = 0.0, fixed = true);", "protected"]
    lines += [f"  discrete Real {name}(start = 0.0, fixed = true);" for name in (*HELD, *program.local)]
    lines += ["algorithm", "  when sample(0.0, h) then", *written((*GAINS, *program.filters), FORM, {}, " " * 4)]
    lines += ["    if manual then", "      u := min(max(u_manual, u_min), u_max);", *written(MANUAL, FORM, {}, " " * 6)]
    lines += ["    else", *written(program.automatic, FORM, {}, " " * 6), "      u := min(max(v, u_min), u_max);"]
    lines += ["    end if;", "  end when;", "end SimcPid;", ""]
    return "\n".join([*lines, *(_loop(program.plant) if program.plant else [])])


def _loop(plant: Plant) -> list[str]:
    A, B, C, D = chain(plant.factored)
    n, theta = len(B), float(plant.theta)
    x = "x" if n else None
    lines = ["model SimcLoop", "  SimcPid pid;", "  parameter Real r = 1.0;", "  parameter Real d = 0.0;", "  Real w;"]
    lines += ["  Real y;"]
    if x:
        lines += [
            f"  parameter Real A[{n}, {n}] = {_matrix(A)};",
            f"  parameter Real B[{n}] = {_vector(B)};",
            f"  parameter Real C[{n}] = {_vector(C)};",
            f"  Real x[{n}](each start = 0.0, each fixed = true);",
        ]
    lines += ["equation", f"  w = {f'delay(pid.u + d, {theta!r})' if theta else 'pid.u + d'};"]
    lines += ["  der(x) = A*x + B*w;"] if x else []
    lines += [f"  y = {'C*x + ' if x else ''}{float(D)!r}*w;", "  pid.r = r;", "  pid.y = y;", "end SimcLoop;", ""]
    return lines


def _vector(values: np.ndarray) -> str:
    return "{" + ", ".join(repr(float(value)) for value in values) + "}"


def _matrix(rows: np.ndarray) -> str:
    return "{" + ", ".join(map(_vector, rows)) + "}"
