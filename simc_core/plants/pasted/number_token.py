"""The value of a number, or of a list of coefficients, as it was written; what can be read in two ways is refused."""

import re
from fractions import Fraction

from simc_core.errors import InvalidParameter
from simc_core.numbers import read_exact_numbers
from simc_core.numbers.one import decimal
from simc_core.numbers.refusal import quoted
from simc_core.plants.pasted.tokens import Token, fault
from simc_core.wording import said

LARGEST_EXPONENT = 300  # of a number with a decimal exponent


def number_written(text: str, token: Token, following: Token) -> Fraction:
    """The number of this token of `text`. Raises ParseError."""
    digits, _, exponent = token.text.lower().partition("e")
    if exponent and abs(int(exponent[:6])) > LARGEST_EXPONENT:
        raise fault(
            said(
                "a number must be below 1e{largest_exponent}, found {text}",
                largest_exponent=LARGEST_EXPONENT,
                text=token.text[:20],
            ),
            text,
            token.at,
        )
    if following.kind == "number" and following.at == token.at + len(token.text):
        raise fault(
            said(
                "'{text}' is not a number: write one decimal point and no other",
                text=quoted(token.text + following.text),
            ),
            text,
            token.at,
        )
    if " " in digits and "+" not in text and " " in text[token.at : token.at + len(token.text)]:
        # a link whose + was not written %2B has lost all of them: 1 200s may have been 1+200s
        raise fault(
            said(
                "'{text}' can be read in two ways: write {value} without a blank, or put + between",
                text=quoted(token.text),
                value=quoted(digits.replace(" ", "")),
            ),
            text,
            token.at,
        )
    try:
        return decimal(said("the number"), digits) * Fraction(10) ** int(exponent or 0)
    except InvalidParameter as error:
        raise fault(str(error), text, token.at) from None


def coefficients(text: str, token: Token) -> tuple[Fraction, ...]:
    """Those of a list, [10 1], in descending powers. Raises ParseError."""
    if re.fullmatch(r"\[\s*[+-]?\d+,\d+\s*\]", token.text):
        raise fault(
            said(
                "'{text}' can be read in two ways: write {value} for one number, {value_2} for two coefficients",
                text=token.text,
                value=token.text.replace(",", "."),
                value_2=token.text.replace(",", " "),
            ),
            text,
            token.at,
        )
    try:
        return tuple(read_exact_numbers(said("the list"), token.text))
    except InvalidParameter as error:
        raise fault(str(error), text, token.at) from None
