"""What a lesson claims, computed. Pure: no streamlit, and no eval.

check       side relation side, "~" tolerance where one is given
side        products and quotients, added and subtracted
factor      a number, or a name of quantities.py with the case in brackets; without brackets, the design's own

IAE_load(PI)/IAE_load(PID) = 1.8        met to half of the last digit
Ms(fast) > Ms(slow)                     rises
Ms(a) = Ms(b) ~ 0.02                    of two that are computed, the tolerance is told
"""

import math
import re
from dataclasses import dataclass

from pages.common.lessons.lesson import BASE
from pages.common.lessons.opened import Cases
from pages.common.lessons.quantities import QUANTITIES
from simc_core.errors import InvalidParameter, SimcError
from simc_core.wording import said

TOKEN = re.compile(r"\s*(?:(\d+(?:\.\d+)?(?:e[-+]?\d{1,2})?|inf\b)|([A-Za-z]\w*)(?:\((\w+)\))?|([-+*/<>=~]))")
ROUNDING = 1e-9  # relative: a number that is printed as 1.375 may be met from either side


@dataclass(frozen=True, slots=True)
class Outcome:
    """A check that was computed. left, right: its sides.   fault: why it has none."""

    met: bool
    left: float = math.nan
    right: float = math.nan
    fault: str = ""


def checked(check: str, cases: Cases) -> Outcome:
    """Whether a check is met; what cannot be computed is a fault, not an exception."""
    try:
        left, relation, right, tolerance = _parsed(check, cases)
    except SimcError as error:
        return Outcome(False, fault=str(error))
    if relation == "<":
        met = left < right
    elif relation == ">":
        met = left > right
    else:
        met = left == right or abs(left - right) <= tolerance * (1 + ROUNDING)
    return Outcome(met, left, right)


def value_of(expression: str, cases: Cases) -> float:
    """One side alone. Raises SimcError."""
    tokens = _tokens(expression)
    value, rest = _sum(tokens, cases)
    if rest:
        raise InvalidParameter(
            said(
                "after {part} nothing more is expected, found {found}",
                part=expression[: len(expression) // 2],
                found=rest[0],
            )
        )
    return value


def half_digit(number: str) -> float:
    """Half of the last digit of a number as printed."""
    mantissa, _, exponent = number.strip().lower().partition("e")
    _, _, decimals = mantissa.partition(".")
    return 0.5 * 10.0 ** (int(exponent or 0) - len(decimals))


def _parsed(check: str, cases: Cases) -> tuple[float, str, float, float]:
    left, rest = _sum(_tokens(check), cases)
    if not rest or rest[0] not in ("<", ">", "="):
        raise InvalidParameter(said("a check has one of < > = between two sides, found {found}", found=check[:60]))
    relation, after = rest[0], rest[1:]
    right, rest = _sum(after, cases)
    if rest:
        if relation != "=" or rest[0] != "~" or len(rest) != 2 or not _is_number(rest[1]):
            raise InvalidParameter(
                said("a check ends, or goes on with ~ and a tolerance after =, found {found}", found=rest[0])
            )
        return left, relation, right, float(rest[1])
    alone = after[0] if len(after) == 1 else after[1] if len(after) == 2 and after[0] == "-" else ""
    if relation == "=" and not _is_number(alone):
        raise InvalidParameter(
            said("= between two that are computed needs ~ and a tolerance: {check}", check=check[:60])
        )
    return left, relation, right, half_digit(alone) if relation == "=" and alone != "inf" else 0.0


def _tokens(text: str) -> list[str]:
    found, at = [], 0
    text = text.strip()
    while at < len(text):
        match = TOKEN.match(text, at)
        if match is None:
            raise InvalidParameter(said("not understood from here on: {text}", text=text[at : at + 20]))
        number, name, case, sign = match.groups()
        found.append(number or sign or (f"{name}({case})" if case else name))
        at = match.end()
    return found


def _is_number(token: str) -> bool:
    return token[:1].isdigit() or token == "inf"


def _sum(tokens: list[str], cases: Cases) -> tuple[float, list[str]]:
    negative = tokens[:1] == ["-"]
    value, tokens = _product(tokens[negative:], cases)
    value = -value if negative else value
    while tokens and tokens[0] in "+-":
        more, rest = _product(tokens[1:], cases)
        value, tokens = value + more if tokens[0] == "+" else value - more, rest
    return value, tokens


def _product(tokens: list[str], cases: Cases) -> tuple[float, list[str]]:
    value, tokens = _factor(tokens, cases)
    while tokens and tokens[0] in "*/":
        more, rest = _factor(tokens[1:], cases)
        if tokens[0] == "/" and more == 0:
            raise InvalidParameter(said("division by zero"))
        value, tokens = value * more if tokens[0] == "*" else value / more, rest
    return value, tokens


def _factor(tokens: list[str], cases: Cases) -> tuple[float, list[str]]:
    if not tokens:
        raise InvalidParameter(said("a number or a name is missing at the end"))
    first, rest = tokens[0], tokens[1:]
    if _is_number(first):
        return float(first), rest
    name, _, case = first.rstrip(")").partition("(")
    if name not in QUANTITIES:
        raise InvalidParameter(said("there is no quantity {name}", name=name[:30]))
    try:
        return QUANTITIES[name].of(cases[case or BASE]), rest
    except ArithmeticError:
        raise InvalidParameter(said("{name} cannot be computed here", name=name)) from None
