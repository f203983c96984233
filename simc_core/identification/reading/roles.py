"""Which column is PV, OP and SP: by name, and by what its numbers do."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from simc_core.errors import DataError
from simc_core.identification.reading.columns import QUALITY, Column
from simc_core.identification.reading.questions import Question
from simc_core.wording import said

ROLES = ("PV", "OP", "SP")
ASKED = {
    "PV": said("Which column is the measurement (PV)?"),
    "OP": said("Which column is the controller output (OP)?"),
}
NO_COLUMN = said("none", context="column of a file")
WORDS = {  # the surest first
    "SP": (r"(^|[\W_])(sp|setpt|spt|soll\w*|consigna|consigne|target|reference|ref|w|r)($|[\W_\d])|set[ _]?point",),
    "OP": (
        r"(^|[\W_])(op|out|mv|co|cv_?out|controller ?out\w*|control ?output|output|stell\w*|salida|u)($|[\W_\d])",
        r"valve|pwm|duty|heater|drive|volt|pump|fan|steam|throttle|actuator|manipulated|power|ventil|input",
    ),
    "PV": (
        r"(^|[\W_])(pv|process ?value|process ?variable|measured|measurement|actual|istwert|ist|y)($|[\W_\d])",
        r"temp|level|flow|press|speed|velocidad|rpm|position|humidity|conc|ph($|[\W_])|distance|weight|output",
    ),
}
PATTERNS = {role: tuple(re.compile(word, re.IGNORECASE) for word in words) for role, words in WORDS.items()}
HELD = 0.1  # of the steps of an OP or SP that is held most of the time
RAMPED = 0.3  # of the steps of a set point with ramps
MOVING = 0.3  # of the steps of a signal that is measured
ERRORS = re.compile(r"(^|[\W_])(err|error|dev|deviation|p|i|d|kp|ki|kd)($|[\W_])", re.IGNORECASE)


@dataclass(slots=True)
class Roles:
    """at: index of the column of each role, None for none.   said, questions: of what was understood.

    mislabelled: the names, and with them the units, stand above the wrong columns.
    """

    at: dict[str, int | None]
    said: list[str] = field(default_factory=list)
    questions: list[Question] = field(default_factory=list)
    mislabelled: bool = False


def roles_of(columns: Sequence[Column], candidates: Sequence[int], told: Mapping[str, int | None]) -> Roles:
    """The roles of the columns. candidates: those that are signals; told: what is known, None for "there is none".

    Raises DataError where no candidate is left for PV.
    """
    free = [i for i in candidates if i not in told.values() and columns[i].kind != QUALITY]
    at: dict[str, int | None] = dict(told)
    moves = {i: _moving(columns[i].values) for i in free}
    found = Roles(at)
    for role in ("SP", "OP", "PV"):
        if role not in at:
            taken = [i for i in at.values() if i is not None]
            at[role] = _by_name(role, columns, [i for i in free if i not in taken], moves)
    if at["PV"] is None and "PV" not in told:
        _find_pv(found, columns, free)
    if at["SP"] is None and "SP" not in told and at["PV"] is not None:
        rest = [i for i in free if i not in at.values()]
        if len(rest) > (at["OP"] is None):
            at["SP"] = next((i for i in rest if _looks_like_sp(columns[i], columns[at["PV"]])), None)
    if at["OP"] is None and "OP" not in told:
        _find_op(found, columns, free)
    if not told:
        _mislabelled(found, columns, moves)
    _rivals(found, columns, free, told)
    if at["PV"] is None:
        raise DataError(said("no column can be the measurement (PV): a trend needs time, PV and OP"))
    named = {role: NO_COLUMN if at[role] is None else columns[at[role] or 0].name for role in ROLES}
    found.said.append(said("PV: {PV}; OP: {OP}; SP: {SP}.", **named))
    return found


def _find_pv(found: Roles, columns: Sequence[Column], free: Sequence[int]) -> None:
    """What has many values and goes from one to the next without jumps, and counts nothing."""
    rest = [i for i in free if i not in found.at.values()]
    likely = sorted(rest, key=lambda i: _smoothness(columns[i]), reverse=True)
    found.at["PV"] = likely[0] if likely else None
    choices = [*likely, *(i for i in (found.at["OP"],) if i is not None)]
    if len(likely) > 2 or (
        len(choices) == 2 and _smoothness(columns[choices[1]]) > 0.5 * _smoothness(columns[choices[0]])
    ):
        found.questions.append(_question("PV", columns, choices, likely[0]))


def _find_op(found: Roles, columns: Sequence[Column], free: Sequence[int]) -> None:
    """What is held longest and moves all the same."""
    rest = [i for i in free if i not in found.at.values()]
    likely = sorted((i for i in rest if _could_be_op(columns[i])), key=lambda i: _moving(columns[i].values))
    found.at["OP"] = likely[0] if likely else None
    if len(likely) > 1:
        found.questions.append(_question("OP", columns, likely, likely[0]))


def _smoothness(column: Column) -> float:
    good = column.values[column.finite]
    if good.size < 3 or not _could_be_op(column):
        return 0.0
    span = float(np.ptp(good))
    return np.unique(good).size * (1.01 - float(np.abs(np.diff(good)).max()) / span)


def _question(role: str, columns: Sequence[Column], choices: Sequence[int], assumed: int) -> Question:
    names = tuple(columns[i].name for i in dict.fromkeys(choices))
    return Question(role, ASKED[role], names, columns[assumed].name)


def _moving(values: NDArray[np.float64]) -> float:
    """Share of the steps from one value to the next in which it changes."""
    good = values[np.isfinite(values)]
    return float(np.mean(np.diff(good) != 0)) if good.size > 1 else 0.0


def _by_name(role: str, columns: Sequence[Column], free: Sequence[int], moves: Mapping[int, float]) -> int | None:
    for pattern in PATTERNS[role]:
        found = [i for i in free if pattern.search(columns[i].name) and not ERRORS.search(columns[i].name)]
        if role == "OP":  # of two that move together, the one in a physical unit
            found.sort(key=lambda i: (moves[i] == 0, columns[i].unit in ("", "pwm", "PWM")))
        if found:
            return found[0]
    return None


def _could_be_op(column: Column) -> bool:
    """It moves, and counts neither phases nor the time that is left."""
    good = column.values[column.finite]
    steps = np.diff(good)
    moves = steps[steps != 0]
    if moves.size == 0:
        return False
    counter = bool(np.mean(moves == 1) > 0.8 or np.mean(moves < 0) > 0.95) and np.unique(good).size > 3
    return not counter


def _looks_like_sp(column: Column, pv: Column) -> bool:
    """Held for long, at more than two values that PV comes near to."""
    good, other = column.values[column.finite], pv.values[pv.finite]
    if good.size < 3 or _moving(good) > RAMPED or np.unique(good).size < 3:
        return False
    low, high = (float(each) for each in np.percentile(other, (1, 99)))  # whatever single values do
    inside = (good >= low - 0.1 * (high - low)) & (good <= high + 0.1 * (high - low))
    return bool(inside.mean() > 0.5) and float(np.ptp(good)) > 0.2 * (high - low)


def _mislabelled(found: Roles, columns: Sequence[Column], moves: Mapping[int, float]) -> None:
    """A set point that moves at every sample beside an "input" that is held: the names are on the wrong columns."""
    at = found.at
    SP, OP, PV = at["SP"], at["OP"], at["PV"]
    if SP is None or OP is None or PV is None or moves[SP] < HELD:
        return
    held = min((OP, PV), key=lambda i: moves[i])
    if moves[held] > 0.2 * moves[SP]:
        return
    others = [i for i in (OP, PV, SP) if i != held]
    level = columns[held].values

    def distance(i: int) -> float:
        return float(np.nanmedian(np.abs(columns[i].values - level)))

    pv = min(others, key=distance)
    op = next(i for i in others if i != pv)
    if not _looks_like_sp(columns[held], columns[pv]):
        return
    at |= {"SP": held, "PV": pv, "OP": op}
    text = said(
        "The names do not fit the numbers: {moving} moves, {held} is held. Which column is the measurement (PV)?",
        moving=columns[SP].name,
        held=columns[held].name,
    )
    found.questions[:] = [each for each in found.questions if each.name not in ROLES]
    found.questions.append(Question("PV", text, tuple(columns[i].name for i in (pv, op, held)), columns[pv].name))
    found.mislabelled = True
    if any(columns[i].unit for i in (SP, OP, PV)):
        found.said.append(
            said("Names of SP, OP and PV do not fit the numbers: taken by the numbers. Units are left open.")
        )
    else:
        found.said.append(said("Names of SP, OP and PV do not fit the numbers: taken by the numbers."))


def _rivals(found: Roles, columns: Sequence[Column], free: Sequence[int], told: Mapping[str, int | None]) -> None:
    """Other columns that could be OP or PV by their names."""
    asked = {question.name for question in found.questions}
    for role in ASKED:
        chosen = found.at[role]
        if chosen is None or role in told or role in asked:
            continue
        others = [i for i in free if i not in found.at.values() and not ERRORS.search(columns[i].name)]
        rivals = [i for i in others if any(each.search(columns[i].name) for each in PATTERNS[role])]
        rivals = [
            i for i in rivals if not any(PATTERNS[other][0].search(columns[i].name) for other in ROLES if other != role)
        ]
        if role == "OP":
            rivals = [i for i in rivals if _could_be_op(columns[i]) and _moving(columns[i].values) < MOVING]
        if rivals:
            found.questions.append(_question(role, columns, [chosen, *rivals], chosen))
