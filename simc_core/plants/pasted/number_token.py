"""The value of a number, or of a list of coefficients, as it was written; what can be read in two ways is refused."""

import re
from fractions import Fraction

from simc_core.errors import InvalidParameter
from simc_core.numbers import read_exact_numbers
from simc_core.numbers.one import decimal
from simc_core.numbers.refusal import quoted
from simc_core.plants.pasted.tokens import Token, fault

LARGEST_EXPONENT = 300  # of a number with a decimal exponent


def number_written(text: str, token: Token, following: Token) -> Fraction:
    """The number of this token of `text`. Raises ParseError."""
    digits, _, exponent = token.text.lower().partition("e")
    if exponent and abs(int(exponent[:6])) > LARGEST_EXPONENT:
        raise fault(f"a number must be below 1e{LARGEST_EXPONENT}, found {token.text[:20]}", text, token.at)
    if following.kind == "number" and following.at == token.at + len(token.text):
        raise fault(
            f"'{quoted(token.text + following.text)}' is not a number: write one decimal point and no other",
            text,
            token.at,
        )
    if " " in digits and "+" not in text and " " in text[token.at : token.at + len(token.text)]:
        # a link whose + was not written %2B has lost all of them: 1 200s may have been 1+200s
        raise fault(
            f"'{quoted(token.text)}' can be read in two ways: write {quoted(digits.replace(' ', ''))} without a "
            "blank, or put + between",
            text,
            token.at,
        )
    try:
        return decimal("the number", digits) * Fraction(10) ** int(exponent or 0)
    except InvalidParameter as error:
        raise fault(str(error), text, token.at) from None


def coefficients(text: str, token: Token) -> tuple[Fraction, ...]:
    """Those of a list, [10 1], in descending powers. Raises ParseError."""
    if re.fullmatch(r"\[\s*[+-]?\d+,\d+\s*\]", token.text):
        raise fault(
            f"'{token.text}' can be read in two ways: write {token.text.replace(',', '.')} for one number, "
            f"{token.text.replace(',', ' ')} for two coefficients",
            text,
            token.at,
        )
    try:
        return tuple(read_exact_numbers("the list", token.text))
    except InvalidParameter as error:
        raise fault(str(error), text, token.at) from None
