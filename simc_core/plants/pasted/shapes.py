"""What only shows in a row of tokens: a fraction printed over three lines, a superscript lost on the way."""

import re

from simc_core.errors import ParseError
from simc_core.plants.pasted.tokens import Token


def with_bar(row: list[Token]) -> list[Token]:
    """A printed fraction, numerator, row of dashes, denominator, as (numerator)/(denominator).

    MATLAB prints exp(-2*s) * in front of the dashes, so that it comes after the numerator.
    """
    bars = [i for i, token in enumerate(row) if token.kind == "bar"]
    if len(bars) != 1 or bars[0] == 0:
        return row
    bar = bars[0]
    above, below, front = row[:bar], row[bar + 1 : -1], []
    if above[-1].text == "*":
        start = max((i for i, token in enumerate(above) if token.kind in ("exp", "e")), default=0)
        front, above = above[start:], above[:start]
        if not above:
            above, front = front[:-1], []

    def sign(text: str) -> Token:
        return Token("sign", text, row[bar].at)

    return [
        *front,
        *(sign("("), *above, sign(")"), sign("/")),
        *(sign("("), *below, sign(")")),
        row[-1],
    ]


def check_lost_powers(text: str, row: list[Token]) -> None:
    """Refuse 5e-3s where it may have been 5 e^(-3s), copied without its superscript.

    In a sum, as in 5e-3s + 1, and in an exponent it can only be a coefficient.
    """
    for i, token in enumerate(row[:-2]):
        found = re.fullmatch(r"(.*?)[eE]-(\d+)", token.text)
        if token.kind != "number" or not found or _in_exponent(row, i):
            continue
        time, after = found[2], i + 1
        torn = row[after].kind == "number" and row[after].at == token.at + len(token.text)  # 5e-0.5s
        if torn:
            time, after = time + row[after].text.replace(",", "."), after + 1
        after += row[after].text == "*"
        if row[after].kind != "s" or row[after + 1].kind == "power":
            continue
        signs = ("+", "-")
        in_sum = row[after + 1].text in signs or (i > 1 and row[i - 1].text in signs and row[i - 2].text != "(")
        if torn or not in_sum:
            raise ParseError(
                f"'{token.text}' before s can be read in two ways: did you mean {found[1]} e^(-{time}s)? "
                f"If it is a coefficient, write it without e (position {token.at + 1})",
                text,
                token.at,
            )


def check_lost_tens(text: str, row: list[Token]) -> None:
    """Refuse 2·103 and 2·10-3, where a power of ten has lost its superscript; a program's * is taken at its word."""
    for times, ten, after in zip(row, row[1:], row[2:], strict=False):
        if times.text != "*" or text[times.at] in "*." or ten.kind != "number" or ten.text[:2] != "10":
            continue
        if ten.text[2:].isdigit() or (ten.text == "10" and after.text == "-" and after.at == ten.at + 2):
            raise ParseError(
                f"'{ten.text}' after a multiplication can be read in two ways: write 10^3 if it is a power of ten, "
                f"or * before it if it is not (position {ten.at + 1})",
                text,
                ten.at,
            )


def check_one_variable(text: str, row: list[Token]) -> None:
    """Refuse a text in s and p."""
    variables = {token.text.strip("%").lower(): token for token in row if token.kind == "s"}
    if len(variables) > 1:
        at = variables["p"].at
        raise ParseError(
            f"there are two variables, s and p: write one, or give p a value (position {at + 1})", text, at
        )


def _in_exponent(row: list[Token], at: int) -> bool:
    """Whether the number at this place begins an exponent, as in exp(-1e-6 s)."""
    while at > 0 and row[at - 1].text in ("+", "-", "(", "[", "{", "^", "**"):
        at -= 1
    return at > 0 and row[at - 1].kind in ("exp", "e")
