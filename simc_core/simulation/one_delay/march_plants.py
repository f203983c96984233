"""Unit step responses of many loops with plants of their own, to their rest: those of one structure march together.

In units of its dead time every plant has the same elements, theta 2^level; without dead time the unit is its fastest
time constant. Plants whose chains have the same coefficients other than 0, and the same mesh on the first interval,
differ in numbers alone (process_maps.py). Each loop keeps its own pace, as tunings of one plant do.
"""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from simc_core.controllers.forms import ParallelPid
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import factored_plant
from simc_core.plants.plant import Plant
from simc_core.simulation.one_delay.element_sizes import ElementSizes, shape
from simc_core.simulation.one_delay.limits import MOST_TO_REST, together
from simc_core.simulation.one_delay.march import MOST_INTERVALS, March, check, march
from simc_core.simulation.one_delay.process_maps import ProcessMaps, chain_of, modes
from simc_core.simulation.one_delay.unit_responses import UnitResponses, course

Key = tuple[object, ...]


def march_plants(
    plants: Sequence[Plant], forms: Sequence[ParallelPid]
) -> Iterator[tuple[list[int], UnitResponses | InvalidParameter]]:
    """Loops that have marched together, and their responses, or why a loop has none.

    plants, forms: of n stable loops.   Raises nothing.
    """
    alike: dict[Key, list[int]] = defaultdict(list)
    units: list[float] = []
    for i, (plant, form) in enumerate(zip(plants, forms, strict=True)):
        unit, key = _structure(plant, form)
        units.append(unit)
        alike[key].append(i)
    for (parts, *_), members in alike.items():
        most = together(MOST_INTERVALS * len(parts)) if isinstance(parts, tuple) else 1
        while members:
            some, done = members[:most], None
            if isinstance(parts, tuple):
                of_units = np.array([units[i] for i in some])
                done = _together([plants[i] for i in some], [forms[i] for i in some], of_units, parts)
            if done is None:
                for i in some:
                    yield [i], _alone(plants[i], forms[i])
            else:
                some = some[: len(done.at_rest)]
                yield some, done
            members = members[len(some) :]


def _structure(plant: Plant, form: ParallelPid) -> tuple[float, Key]:
    """Unit of time, and what loops that march together have in common; the mesh comes first."""
    factored = factored_plant(plant)
    poles = modes(factored, form.tau_F)
    size = np.abs(poles)
    unit = plant.theta or float(1 / np.max(size) if size.any() else 1.0)
    try:
        parts: tuple[float, ...] | None = shape(poles, plant.theta)
    except InvalidParameter:  # which a march of its own will tell
        parts = None
    chain = tuple([tuple(map(bool, row)) for section in chain_of(plant, unit) for row in section])
    return unit, (parts, chain, plant.theta > 0, form.tau_F > 0, form.Kd != 0, form.Kp != 0)


def _together(
    plants: list[Plant], forms: list[ParallelPid], units: np.ndarray, parts: tuple[float, ...]
) -> UnitResponses | None:
    """The first loops, as many as march together; None where one of them needs a march of its own."""
    try:
        for plant, form in zip(plants, forms, strict=True):
            check(plant, [form])
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            chains = ProcessMaps(plants, [form.tau_F for form in forms], forms[0].Kd != 0, units.tolist())
            marching = March(plants, forms, units, ElementSizes(chains, parts), None, MOST_TO_REST, False)
            if not marching.arrives():
                return None
    except InvalidParameter:
        return None
    found = course(marching.batches, [control.at_rest for control in marching.controls[: marching.n_left]])
    return replace(found, begin=found.begin * units[found.owner], length=found.length * units[found.owner])


def _alone(plant: Plant, form: ParallelPid) -> UnitResponses | InvalidParameter:
    try:
        return march(plant, [form], None)
    except InvalidParameter as error:
        return error
