"""Cells to numbers: decimal sign, separators of thousands, units behind a number, and words that say "no value"."""

import re
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

NO_VALUE = (
    "bad nan na n/a #n/a null none nil - -- --- ? ??? inf -inf #num! #value! #div/0! #ref! #name? error fault "
    "questionable uncertain timeout missing offline"
)
PHRASES = {"no data", "i/o timeout", "bad input", "no good data", "pt created", "not connect", "comm fail", "scan off"}
SWITCHED_ON = "true on open yes running auto ein an wahr marche si sí вкл"
SWITCHED_OFF = "false off closed no stopped manual aus falsch arret arrêt выкл"
BAD_WORDS = frozenset(NO_VALUE.split()) | PHRASES
TRUE_WORDS, FALSE_WORDS = frozenset(SWITCHED_ON.split()), frozenset(SWITCHED_OFF.split())
GOOD_WORDS = frozenset(["good", "ok", "valid", "192", "gut"])
MINUS = str.maketrans({"−": "-", "–": "-", "\u00a0": " ", "\u202f": " ", "\ufeff": None})
EXPONENT = r"(?:[eE][+-]?\d+)?"
COMMA = re.compile(rf"[+-]?\d*,\d+{EXPONENT}")
POINT = re.compile(rf"[+-]?\d*\.\d+{EXPONENT}")
THOUSANDS = {sign: re.compile(rf"[+-]?[1-9]\d{{0,2}}(?:{re.escape(sign)}\d{{3}})+") for sign in ",."}
BOTH = re.compile(r"[+-]?\d{1,3}(?:(?P<group>[,.' ])\d{3})+(?P<point>[,.])\d+")
DIGITS = r"\d{1,3}(?:[ ']\d{3})+(?:[.,]\d*)?|\d[\d.,]*|[.,]\d+"
UNIT = r"(?:[^\W\d_]|[%°])[^;,|\t]{0,15}"
NUMBER = re.compile(rf"([+-]?(?:{DIGITS}){EXPONENT})\s*({UNIT})?")


def is_number(cell: str) -> bool:
    """Whether a cell reads as a number with either decimal sign, perhaps with a unit behind it."""
    return NUMBER.fullmatch(cell.translate(MINUS).strip()) is not None


def is_value(cell: str) -> bool:
    """A number, a word for none, or a state of a switch."""
    word = cell.strip().lower()
    return is_number(cell) or word in BAD_WORDS or word in TRUE_WORDS or word in FALSE_WORDS


def decimal_sign(cells: Iterable[str]) -> tuple[str, bool]:
    """The decimal sign, and whether that is certain.

    Not certain where every number with a comma has three digits after it: 1,234 may be meant either way.
    """
    comma = point = either = 0
    for cell in cells:
        text = cell.translate(MINUS).strip()
        both = BOTH.match(text)
        if both:
            comma += both["point"] == "," and both["group"] != ","
            point += both["point"] == "." and both["group"] != "."
        elif THOUSANDS[","].fullmatch(text):
            either += 1
        elif COMMA.match(text):
            comma += 1
        elif POINT.match(text):
            point += 1
    if comma or point:
        return ("," if comma > point else "."), not (comma and point and 0.2 < comma / (comma + point) < 0.8)
    return (",", False) if either else (".", True)


def to_floats(cells: Sequence[str], decimal: str) -> NDArray[np.float64]:
    """The cells as numbers, nan for what is none. Switch states are 1 and 0."""
    try:
        plain = [cell.replace(",", ".") for cell in cells] if decimal == "," else list(cells)
        found = np.array(plain, dtype=np.float64)  # fast, and right where every cell is a plain number
    except ValueError:
        known: dict[str, float] = {}
        found = np.empty(len(cells))
        for i, cell in enumerate(cells):
            if cell not in known:
                if len(known) > 100_000:
                    known.clear()
                known[cell] = to_float(cell, decimal)
            found[i] = known[cell]
    found[~np.isfinite(found)] = np.nan
    return found


def to_float(cell: str, decimal: str) -> float:
    """One cell as a number; nan where it is none."""
    text = cell.translate(MINUS).strip()
    found = NUMBER.fullmatch(text)
    if not found:
        word = text.lower()
        return 1.0 if word in TRUE_WORDS else 0.0 if word in FALSE_WORDS else np.nan
    digits = found[1].replace(" ", "").replace("'", "").replace("." if decimal == "," else ",", "")
    try:
        return float(digits.replace(",", "."))
    except ValueError:
        return np.nan
