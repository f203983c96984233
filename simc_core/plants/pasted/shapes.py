"""What only shows in a row of tokens: a fraction printed over three lines, a superscript lost on the way."""

import re
from itertools import pairwise

from simc_core.errors import ParseError
from simc_core.plants.pasted.tokens import Token, fault
from simc_core.wording import said

SIGNS = ("+", "-", "*", "/", "^", "**")


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
            raise fault(
                said(
                    "'{text}' before s can be read in two ways: did you mean {found} e^(-{time}s)? If it is a "
                    "coefficient, write it without e",
                    text=token.text,
                    found=found[1],
                    time=time,
                ),
                text,
                token.at,
            )


def check_lost_tens(text: str, row: list[Token]) -> None:
    """Refuse 2·103 and 2·10-3, where a power of ten has lost its superscript; a program's 2*103 is what it says."""
    for times, ten, after, last in zip(row, row[1:], row[2:], row[3:], strict=False):
        if times.text != "*" or ten.kind != "number" or ten.text[:2] != "10":
            continue
        tight = ten.text == "10" and after.text == "-" and after.at == ten.at + 2 and last.at == ten.at + 3
        if tight and last.kind == "number":
            raise fault(
                said(
                    "'10-{text}' after a multiplication can be read in two ways: write 10^-{text} if it is a power "
                    "of ten, or 10 - {text} with blanks if it is a difference",
                    text=last.text,
                ),
                text,
                ten.at,
            )
        if text[times.at] not in "*." and ten.text[2:].isdigit():
            raise fault(
                said(
                    "'{text}' after a multiplication can be read in two ways: write 10^{text_2} if it is a power of "
                    "ten, or * before it if it is not",
                    text=ten.text,
                    text_2=ten.text[2:],
                ),
                text,
                ten.at,
            )


def check_raised(text: str, plain: str, row: list[Token]) -> None:
    """Refuse a drawn fraction with gaps as exponents leave them that were printed on a line of their own."""
    if not any(token.kind == "bar" for token in row):
        return
    for token, after in pairwise(row):
        gap = plain[token.at + len(token.text) : after.at]
        wide = len(gap) > 1 and not gap.strip()
        if wide and (
            (after.kind == "s" and token.kind == "number") or (token.kind == "s" and after.text in ("+", "-"))
        ):
            at = after.at if after.kind == "s" else token.at
            raise fault(
                said(
                    "the wide gap at this s can be a power on a line of its own: write s^2 for s squared, and 2 s "
                    "with one blank"
                ),
                text,
                at,
            )


def check_numbered(text: str, plain: str, row: list[Token]) -> None:
    """Refuse the number of an equation, (3), or of a list, 3., which would be a factor."""
    first, last = row[0], row[-4:]
    point = first.kind == "number" and first.text[-1] == "." and row[1].kind not in ("s", "end")
    if point and _blank(plain, row[1]) and row[1].text not in SIGNS:
        raise ParseError(
            said(
                "'{text}' can be the number of a list: leave it out, or write {text}0 if it is a factor "
                "(position {at})",
                text=first.text,
                at=first.at + 1,
            ),
            text,
            first.at,
        )
    before = len(row) > 4 and _lone_number(row[:3]) and _blank(plain, row[3])
    before = before and row[3].text not in SIGNS and row[3].kind != "list"
    behind = len(row) > 4 and _lone_number(last) and _blank(plain, last[0]) and row[-5].text not in SIGNS
    if before or (behind and row[-5].kind not in ("exp", "e", "frac", "sqrt")):
        number = row[1] if before else last[1]
        raise ParseError(
            said(
                "'({text})' can be the number of an equation: leave it out, or write * beside it if it is a "
                "factor (position {at})",
                text=number.text,
                at=number.at,
            ),
            text,
            number.at - 1,
        )


def _lone_number(row: list[Token]) -> bool:
    """Whether the tokens begin with (3) or [3]."""
    return row[0].text in ("(", "[") and row[1].kind == "number" and row[2].text in (")", "]")


def _blank(plain: str, token: Token) -> bool:
    """Whether a blank stands before the token."""
    return plain[token.at - 1 : token.at].isspace()


def check_one_variable(text: str, row: list[Token]) -> None:
    """Refuse a text in s and p, or in s and S."""
    variables = {token.text.strip("%"): token for token in row if token.kind == "s"}
    if len(variables) > 1:
        first, second, *_ = variables
        at = variables[second].at
        raise fault(
            said(
                "there are two variables, {first} and {second}: write one, or give {second} a value",
                first=first,
                second=second,
            ),
            text,
            at,
        )


def _in_exponent(row: list[Token], at: int) -> bool:
    """Whether the number at this place begins an exponent, as in exp(-1e-6 s)."""
    while at > 0 and row[at - 1].text in ("+", "-", "(", "[", "{", "^", "**"):
        at -= 1
    return at > 0 and row[at - 1].kind in ("exp", "e")
