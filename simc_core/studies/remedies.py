"""Remedies that were tried: a change of the design is proposed only after the changed loop has been judged."""

import math
from collections.abc import Iterator
from typing import Any

from simc_core.errors import SimcError
from simc_core.notation import number, rounded_up
from simc_core.plants.models import UnstableDelay
from simc_core.reduction.records import LARGEST_MS
from simc_core.studies.tuned import Tuned
from simc_core.wording import said

GOOD_MS = 1.7  # what a remedy aims at; up to LARGEST_MS it is still one
SLOWER = (1.1, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 7.0, 10.0, 20.0, 50.0, 100.0)  # factors on tau_c
FILTERS = (0.1, 0.05, 0.02, 0.01, 0.005, 0.002)  # tau_F/tau_D
HARDLY = 1.1  # a filter that raises Ms by no more than this costs little

Change = dict[str, Any]
TIGHT: Change = {"tau_c": None, "speed": ""}  # tau_c = theta, whatever was chosen


def calmer(of: Tuned) -> tuple[Change, str]:
    """A change that gives a stable loop with Ms <= 2, and what it gives, in words; {} and "" where none is found."""
    best: tuple[Change, float] | None = None
    for change, Ms in _trials(of):
        if Ms <= GOOD_MS:
            return change, said("Ms becomes {Ms}", Ms=number(Ms, 3))
        if Ms <= LARGEST_MS and (best is None or Ms < best[1]):
            best = change, Ms
    return ({}, "") if best is None else (best[0], said("Ms becomes {Ms}", Ms=number(best[1], 3)))


def filter_that_costs_little(of: Tuned) -> tuple[Change, float]:
    """The largest tau_F/tau_D of FILTERS that raises Ms by 10 % at most and not across 2, else the smallest; its Ms.

    {} where the smallest one makes the loop fragile that was not.
    """
    now = of.margins.Ms
    allowed = HARDLY * now if now > LARGEST_MS else min(HARDLY * now, LARGEST_MS)
    change, Ms = {"filter": FILTERS[-1]}, math.nan
    for ratio in FILTERS:
        change, Ms = {"filter": ratio}, of.changed(filter=ratio).margins.Ms
        if Ms <= allowed:
            return change, Ms
    return ({}, Ms) if math.isfinite(now) and not Ms <= max(LARGEST_MS, HARDLY * now) else (change, Ms)


def _trials(of: Tuned) -> Iterator[tuple[Change, float]]:
    """Changes in the order in which they are proposed, with Ms of a stable loop."""
    if not isinstance(of.model, UnstableDelay):
        shortest = of.usual_tau_c if of.model.theta else 0.0
        if of.tau_c < shortest:
            yield from _judged(of, tight(of))
        for factor in SLOWER:
            yield from _judged(of, {"tau_c": rounded_up(factor * max(of.tau_c, shortest))})
    yield from _of_other_order(of)
    for ratio in FILTERS:
        if ratio < of.choices["filter"]:
            yield from _judged(of, {"filter": ratio})


def tight(of: Tuned) -> Change:
    """tau_c as the rule has it where none is given."""
    return TIGHT if of.rule != "isimc" else {"tau_c": of.usual_tau_c}


def _of_other_order(of: Tuned) -> Iterator[tuple[Change, float]]:
    if of.rule != "simc":  # which has one kind of controller
        return
    other = 3 - of.order
    orders = of.reduction.orders
    if orders is None or orders.second_pays == (other == 2):  # never against what is said about the orders
        yield from _judged(of, {"order": other})
        if not isinstance(of.model, UnstableDelay):
            yield from _judged(of, {"order": other, **TIGHT})


def _judged(of: Tuned, change: Change) -> Iterator[tuple[Change, float]]:
    """The change with its Ms, nothing where there is no such design or no stable loop."""
    try:
        Ms = (of.at(**change) if set(change) == {"tau_c"} else of.changed(**change)).margins.Ms
    except SimcError:
        return
    if math.isfinite(Ms):
        yield change, Ms
