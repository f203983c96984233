"""Tokens to a value, by recursive descent, in exact fractions.

fraction = sum [ "\\over" sum ]
sum      = ["+" | "-"] product { ("+" | "-") product }
product  = power { ["*" | "/"] power }
power    = atom [ ("^" | "**") whole number ]
atom     = number | "s" | "(" fraction ")" | "exp" "(" sum ")" | "e^" exponent | "\\frac" "{" sum "}" "{" sum "}"
             | name | call | "sqrt" "(" number ")" | "pi" | list of coefficients
"""

import math
from collections.abc import Callable, Mapping
from fractions import Fraction

from simc_core import checks
from simc_core.errors import ParseError
from simc_core.numbers.refusal import quoted
from simc_core.numbers.signs import LOWERED
from simc_core.plants.parse_values import (
    MINUS_ONE,
    MOST_PARTS,
    ONE,
    S,
    Value,
    constant,
    degree,
    expanded,
    inverse,
    is_zero,
    number_of,
    plus,
    polynomial,
    times,
    too_large,
)
from simc_core.plants.pasted.number_token import coefficients, number_written
from simc_core.plants.pasted.shapes import (
    check_lost_powers,
    check_lost_tens,
    check_numbered,
    check_one_variable,
    check_raised,
    with_bar,
)
from simc_core.plants.pasted.sums_of_delays import advice
from simc_core.plants.pasted.tokens import Token, bare, fault, superscript_delay, tokens
from simc_core.wording import said

DEEPEST = 50  # nested brackets
HIGHEST_POWER = 40
CLOSING = {"(": ")", "[": "]", "{": "}"}
EXPONENTIALS = ("exp", "e", "delay")
ATOMS = ("number", "s", "name", "frac", "sqrt", "pi", "call", "list", *EXPONENTIALS)
NO_EXPONENT = said("the exponent must be a multiple of s, as in e^{-3s} or exp(-3 s)")


class Reader:
    """The descent: one method for one line of the grammar.

    plain[start:stop] is read, text without clutter; errors quote `text`, where positions are the same. `names`: values
    of names; `call`: reads a constructor call, see calls.py.
    """

    def __init__(
        self,
        text: str,
        plain: str,
        start: int,
        stop: int,
        names: Mapping[str, Value],
        call: Callable[["Reader", Token], Value],
    ):
        self.text = text
        self.plain = plain
        self.names = names
        self.call = call
        row = list(tokens(text, plain, start, stop, names))
        check_raised(text, plain, row)
        self.tokens = with_bar(row)
        check_lost_powers(text, self.tokens)
        check_lost_tens(text, self.tokens)
        check_numbered(text, plain, self.tokens)
        check_one_variable(text, self.tokens)
        self.next = 0
        self.depth = 0
        self.used: set[str] = set()

    def plant(self) -> Value:
        value = self.fraction()
        if self.token.kind != "end":
            raise self.fault(said("a transfer function must end here, found {token}", token=_named(self.token)))
        return value

    @property
    def token(self) -> Token:
        return self.tokens[self.next]

    @property
    def last(self) -> Token:
        return self.tokens[self.next - 1]

    def take(self, *texts: str) -> Token | None:
        """The present token, consumed, if it is one of `texts`."""
        token = self.token
        if token.kind in ("sign", "power") and token.text in texts:
            self.next += 1
            return token
        return None

    def fault(self, message: str, at: int | None = None) -> ParseError:
        return fault(message, self.text, self.token.at if at is None else at)

    def fraction(self) -> Value:
        value = self.sum()
        if self.token.kind == "over":
            at = self.token.at
            self.next += 1
            value = self.divided(value, self.sum(), at)
        return value

    def sum(self) -> Value:
        negative = self.take("-", "+")
        value = self.product()
        if negative and negative.text == "-":
            value = times(value, MINUS_ONE)
        while sign := self.take("+", "-"):
            term = self.product()
            value = self.checked(self.added(value, term, sign), sign.at)
        return value

    def added(self, a: Value, b: Value, sign: Token) -> Value:
        minus = -1 if sign.text == "-" else 1
        if a.theta != b.theta:
            raise self.fault(
                said("terms with different dead times cannot be added to one plant with one dead time: ")
                + advice(a, b, minus),
                sign.at,
            )
        if degree(a) + degree(b) > 4 * checks.MOST_FACTORS:
            raise self.fault(
                said("the degree of a polynomial must be <= {most_factors}", most_factors=checks.MOST_FACTORS), sign.at
            )
        return plus(a, b, minus)

    def divided(self, value: Value, divisor: Value, at: int) -> Value:
        if is_zero(divisor):
            raise self.fault(said("division by zero"), at)
        return self.checked(times(value, inverse(divisor)), at)

    def product(self) -> Value:
        value = self.power()
        slashed = False
        while True:
            at = self.token.at
            if self.take("*"):
                value, slashed = times(value, self.power()), False
            elif self.take("/"):
                value, slashed = self.divided(value, self.power(), at), True
            elif self.starts_atom():
                self.check_side_by_side(slashed)
                value = times(value, self.power())
            else:
                return value
            self.checked(value, at)

    def check_side_by_side(self, slashed: bool) -> None:
        """Refuse what would be a product only because nothing stands between: a number after anything, 1/2 s."""
        token, before = self.token, self.last
        if token.kind == "number" and not self.is_power_of_ten():
            if before.kind == "number":
                both = quoted(f"{before.text} {token.text}")
                raise self.fault(
                    said(
                        "two numbers stand side by side, '{both}': write them as one without a blank, or put +, - or * "
                        "between them",
                        both=both,
                    ),
                    token.at,
                )
            # 10s 1 is 10s+1 that lost its plus, as in a link where + was not written %2B
            raise self.fault(
                said(
                    "a sign is missing before this number: write +, - or * before {text}, or ^ if it is a power",
                    text=quoted(token.text),
                )
            )
        if before.kind == "list" and token.kind not in EXPONENTIALS:
            raise self.fault(said("after a list of coefficients write / or *"))
        if token.kind == "list":
            raise self.fault(said("a list of coefficients stands alone: write tf([2], [10 1]), or / or * before it"))
        if slashed and token.kind not in EXPONENTIALS:
            raise self.fault(said("the denominator is unclear: write 1/((s+1)(2s+1)) or (1/(s+1))*(2s+1)"))

    def is_power_of_ten(self) -> bool:
        """Whether the present number is 10^3 or 1e3 after another number."""
        text, following = self.token.text, self.tokens[self.next + 1]
        return self.last.kind == "number" and (text[:2].lower() == "1e" or (text == "10" and following.kind == "power"))

    def starts_atom(self) -> bool:
        token = self.token
        return token.kind in ATOMS or (token.kind == "sign" and token.text in CLOSING)

    def power(self) -> Value:
        at = self.token.at
        value = self.atom()
        while self.token.kind == "power":
            exponent = self.whole_exponent()
            if abs(exponent) > HIGHEST_POWER:
                raise self.fault(
                    said(
                        "a power must be between -{highest_power} and {highest_power}, found {exponent}",
                        highest_power=HIGHEST_POWER,
                        exponent=exponent,
                    ),
                    at,
                )
            if exponent < 0 and is_zero(value):
                raise self.fault(said("division by zero"), at)
            base = inverse(value) if exponent < 0 else value
            n = abs(exponent)
            if n * max(len(base.num), len(base.den)) > MOST_PARTS:
                raise self.fault(said("a product must have at most {most_parts} factors", most_parts=MOST_PARTS), at)
            value = self.checked(Value(base.num * n or (ONE,), base.den * n, base.theta * n, base.at), at)
        return value

    def whole_exponent(self) -> int:
        token = self.token
        self.next += 1
        if token.text not in ("^", "**"):
            return int(token.text.translate(LOWERED))
        opened = self.take("(", "{", "[")
        sign = -1 if self.take("-") else 1
        token = self.token
        if token.kind != "number" or not token.text.isascii() or not token.text.isdigit():
            raise self.fault(said("a power must be a whole number, found {token}", token=_named(token)))
        self.next += 1
        if opened:
            self.close(opened)
        return sign * int(token.text[:5])

    def atom(self) -> Value:
        token = self.token
        self.next += 1
        match token.kind:
            case "number":
                return constant(number_written(self.text, token, self.token))
            case "s":
                return Value((S,))
            case "name":
                return self.names_value(token)
            case "pi":
                return constant(Fraction(math.pi))
            case "sqrt":
                return self.square_root(token)
            case "exp" | "e":
                return self.exponential(token)
            case "delay":
                return Value((ONE,), (), Fraction(-superscript_delay(token.text)), token.at)
            case "frac":
                return self.divided(self.group(), self.group(), token.at)
            case "list":
                return self.checked(polynomial(coefficients(self.text, token)), token.at)
            case "call":
                return self.call(self, token)
            case "sign" if token.text in CLOSING:
                self.next -= 1
                return self.group()
            case "sign" if token.text == "-" and self.token.text != "-":  # 2*-s, e^{-s}*-1
                return times(MINUS_ONE, self.power())
            case "sign" if token.text in CLOSING.values():
                raise self.fault(said("'{text}' closes a bracket that was not opened", text=token.text), token.at)
        raise self.fault(
            said("a number, s, exp or a bracket was expected here; found {token}", token=_named(token)), token.at
        )

    def names_value(self, token: Token) -> Value:
        name = bare(token.text)
        self.used.add(name)
        return self.names[name]

    def square_root(self, token: Token) -> Value:
        argument = self.atom() if self.token.kind == "number" else self.group()
        value = number_of(argument)
        if value is None or value < 0:
            raise self.fault(said("a square root must be of a number >= 0"), token.at)
        return constant(Fraction(math.sqrt(value)))

    def group(self) -> Value:
        opened = self.take(*CLOSING)
        if not opened:
            braces = said(" as in \\frac{2}{10s+1}") if self.last.kind == "frac" else ""
            raise self.fault(
                said(
                    "an opening bracket is expected here{braces}, found {token}",
                    braces=braces,
                    token=_named(self.token),
                )
            )
        self.depth += 1
        if self.depth > DEEPEST:
            raise self.fault(said("brackets must not be nested more than {deepest} deep", deepest=DEEPEST), opened.at)
        value = self.fraction()
        self.close(opened)
        self.depth -= 1
        return value

    def close(self, opened: Token) -> None:
        if not self.take(CLOSING[opened.text]):
            raise self.fault(
                said(
                    "'{text}' of position {at} must be closed by '{closing}', found {token}",
                    text=opened.text,
                    at=opened.at + 1,
                    closing=CLOSING[opened.text],
                    token=_named(self.token),
                )
            )

    def exponential(self, token: Token) -> Value:
        if token.kind == "e":
            self.next += 1  # the power sign, seen when the word was read
        value = self.group() if self.token.text in CLOSING else self.bare_exponent()
        exponent = expanded(value.num)
        divisor = expanded(value.den)
        if value.theta or len(divisor) > 1 or len(exponent) > 2 or exponent[0]:
            raise self.fault(NO_EXPONENT, token.at)
        slope = exponent[1] / divisor[0] if len(exponent) > 1 else Fraction(0)
        return Value((ONE,), (), -slope, token.at)

    def bare_exponent(self) -> Value:
        """-3s, -s, -3*s, -(3s) of e^-3s: a sign, at most one number or name, and one s; or a sign and a bracket."""
        value = MINUS_ONE if self.take("-") else Value((ONE,))
        if self.token.text in CLOSING:
            return times(value, self.group())
        if self.token.kind in ("number", "name"):
            value = times(value, self.atom())
            self.take("*")
        if self.token.kind != "s":
            raise self.fault(NO_EXPONENT)
        return times(value, self.atom())

    def checked(self, value: Value, at: int) -> Value:
        """`value`, if it is still of a size worth working on."""
        if excess := too_large(value):
            raise self.fault(excess, at)
        return value


def _named(token: Token) -> str:
    return said("the end of the text") if token.kind == "end" else f"'{quoted(token.text)}'"
