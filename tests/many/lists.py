"""Lists of loops for tests: plants of every kind, and rows that are wrong in ways people are wrong."""

from simc_core.notation import plain
from tests.oracles.random_plants import random_plants

BAD = (
    {"k": float("nan"), "theta": 1, "tau1": 8},
    {"k": "eins", "theta": 1, "tau1": 8},
    {"plant": "1/((s+1)"},
    {"plant": "exp(-2s)/((s-1)(s-2))"},
    {"plant": "exp(-2s)/(s-1)"},
    {"k": 1, "theta": 1, "tau1": 8, "Ms": 0.9},
    {"k": 0, "theta": 1, "tau1": 8},
    {"plant": "1/(s+1)", "rule": "no such rule"},
    {},
    {"plant": ["exp(-s)"], "k": object()},
)


def mixed_rows(number: int, bad: int, seed: int = 0) -> tuple[list[dict], set[int]]:
    """`number` rows, and which of them are bad: spread evenly."""
    rows = [
        {"tag": f"L{i}", "plant": plain(plant), "kind": ("PI", "PID")[i % 3 == 0]}
        for i, (_, plant) in enumerate(random_plants(number, seed))
    ]
    places = {i * number // bad + number // (2 * bad) for i in range(bad)}
    for j, i in enumerate(sorted(places)):
        rows[i] = {"tag": f"L{i}", **BAD[j % len(BAD)]}
    return rows, places
