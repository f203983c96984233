"""Transfer functions as people write them, read by recursive descent.

    (1-2s)/((10s+1)(6s+1)(s+1))      exp(-3s)/((6s+1)(4s+1)(2s+1))      2 e^{-0.5s}/(s(3s+1)^2)      (s+2)/(s^2+3*s+1)

    sum      = ["+" | "-"] product { ("+" | "-") product }
    product  = power { ["*" | "/"] power }
    power    = atom [ ("^" | "**") whole number ]
    atom     = number | "s" | "(" sum ")" | "exp" "(" sum ")" | "e^" exponent | "\\frac" "{" sum "}" "{" sum "}"

Brackets may be (), [] or {}; a decimal comma counts as a point. Numbers are kept as exact fractions, and factors that
were written apart stay apart, so that nothing is lost on the way. What could be read in two ways, like 1/2s or
1/(s+1)(2s+1), is refused with a hint; nothing is ever evaluated as code, and the work is bounded.
"""

import re
from fractions import Fraction
from typing import NamedTuple

from simc_core import checks
from simc_core.errors import ParseError
from simc_core.plants.parse_values import (
    MINUS_ONE,
    MOST_PARTS,
    ONE,
    S,
    Value,
    degree,
    expanded,
    inverse,
    is_zero,
    plant_of,
    plus,
    times,
    too_large,
)
from simc_core.plants.plant import Plant

LONGEST_TEXT = 2000
DEEPEST = 50  # nested brackets
HIGHEST_POWER = 40
LARGEST_EXPONENT = 300  # of a number with a decimal exponent

TOKEN = re.compile(
    r"(?P<number>(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?)"
    r"|(?P<exp>\\?exp(?![a-zA-Z])|e(?=\s*(?:\^|\*\*)))"
    r"|(?P<frac>\\frac)"
    r"|(?P<s>s)"
    r"|(?P<power>\^|\*\*|[⁰¹²³⁴⁵⁶⁷⁸⁹]+)"
    r"|(?P<sign>[-+*/(){}\[\]])"
)
ALIKE = str.maketrans("−–·×⋅∙\u00a0\u2009\u202f\t\n\r", "--****      ")  # one sign for one: positions stay
SPACES = re.compile(r"(?:\s|\\left(?![a-z])|\\right(?![a-z])|\\[,;:! ])+")
CDOT = re.compile(r"\\(?:cdot|times)(?![a-z])")
NAME = re.compile(r"\s*[A-Za-z]\w{0,10}\s*(?:\(\s*s\s*\)\s*)?=")
SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")
CLOSING = {"(": ")", "[": "]", "{": "}"}


class Token(NamedTuple):
    """kind: number, exp, frac, s, power, sign or end."""

    kind: str
    text: str
    at: int


def parse_plant(text: str) -> Plant:
    """The plant that `text` describes; the module docstring says what may be written.

    Parameters
    ----------
    text : str
        A transfer function in s, such as exp(-3s)/((6s+1)(4s+1)(2s+1)).

    Returns
    -------
    Plant
        With the dead time exact.

    Raises
    ------
    ParseError
        The text is not a transfer function; the error holds the position of the fault.
    InvalidParameter
        The plant itself is out of bounds.

    Examples
    --------
    >>> from simc_core import parse_plant
    >>> plant = parse_plant("exp(-3s)/((6s+1)(4s+1)(2s+1))")
    >>> plant.theta, plant.lags
    (3.0, (6.0, 4.0, 2.0))
    """
    if not isinstance(text, str):
        raise ParseError(f"a transfer function must be text, got {type(text).__name__}")
    if len(text) > LONGEST_TEXT:
        raise ParseError(f"text must have at most {LONGEST_TEXT} characters, got {len(text)}", text, LONGEST_TEXT)
    if not text.strip():
        raise ParseError(
            "text must not be empty: write a transfer function, for instance exp(-3s)/((6s+1)(4s+1))", text
        )
    value = _Reader(text).plant()
    if value.theta < 0:
        raise ParseError(
            f"dead time must be >= 0, got {float(value.theta):g}: e^{{+{-float(value.theta):g} s}} is a prediction. "
            "Write e^{-3s} for a dead time of 3",
            text,
            value.at,
        )
    return plant_of(value)


class _Reader:
    """The descent: one method for one line of the grammar."""

    def __init__(self, text: str):
        self.text = text
        self.tokens = list(self._tokens())
        self.next = 0
        self.depth = 0

    def plant(self) -> Value:
        value = self.sum()
        if self.token.kind != "end":
            raise self.fault(f"a transfer function must end here, got '{self.token.text}'")
        return value

    @property
    def token(self) -> Token:
        return self.tokens[self.next]

    def take(self, *texts: str) -> Token | None:
        """The present token, consumed, if it is one of `texts`."""
        token = self.token
        if token.kind in ("sign", "power") and token.text in texts:
            self.next += 1
            return token
        return None

    def fault(self, message: str, at: int | None = None) -> ParseError:
        at = self.token.at if at is None else at
        return ParseError(f"{message} (position {at + 1})", self.text, at)

    def _tokens(self):
        text = CDOT.sub(lambda found: "*".ljust(len(found[0])), self.text.translate(ALIKE))
        name = NAME.match(text)
        at = name.end() if name else 0
        while at < len(text):
            if space := SPACES.match(text, at):
                at = space.end()
                continue
            found = TOKEN.match(text, at)
            if not found:
                raise self.fault(_unknown(text[at]), at)
            yield Token(found.lastgroup, found[0], at)
            at = found.end()
        yield Token("end", "the end", len(text))

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
        if a.theta != b.theta:
            raise self.fault(
                "terms with different dead times cannot be added to one transfer function of this kind: "
                "multiply by exp(-theta s) instead",
                sign.at,
            )
        if degree(a) + degree(b) > 4 * checks.MOST_FACTORS:
            raise self.fault(f"the degree of a polynomial must be <= {checks.MOST_FACTORS}", sign.at)
        return plus(a, b, -1 if sign.text == "-" else 1)

    def product(self) -> Value:
        value = self.power()
        divided = None
        while True:
            at = self.token.at
            if self.take("*"):
                value, divided = times(value, self.power()), None
            elif slash := self.take("/"):
                divisor = self.power()
                if is_zero(divisor):
                    raise self.fault("division by zero", slash.at)
                value, divided = times(value, inverse(divisor)), slash
            elif self.starts_atom():
                if self.token.kind == "number" and self.tokens[self.next - 1].kind != "number":
                    # 10s 1 is 10s+1 that lost its plus, as in a link where + was not written %2B
                    raise self.fault("a sign is missing before this number: write +, - or *", at)
                if divided and self.token.kind != "exp":
                    raise self.fault(
                        "after '/' it is not clear how far the denominator goes: write 1/((s+1)(2s+1)) if this belongs "
                        "to it, or put * before what does not",
                        at,
                    )
                value = times(value, self.power())
            else:
                return value
            self.checked(value, at)

    def starts_atom(self) -> bool:
        token = self.token
        return token.kind in ("number", "s", "exp", "frac") or (token.kind == "sign" and token.text in CLOSING)

    def power(self) -> Value:
        at = self.token.at
        value = self.atom()
        while self.token.kind == "power":
            exponent = self.whole_exponent()
            if abs(exponent) > HIGHEST_POWER:
                raise self.fault(f"a power must be between -{HIGHEST_POWER} and {HIGHEST_POWER}, got {exponent}", at)
            if exponent < 0 and is_zero(value):
                raise self.fault("division by zero", at)
            base = inverse(value) if exponent < 0 else value
            n = abs(exponent)
            if n * max(len(base.num), len(base.den)) > MOST_PARTS:
                raise self.fault(f"a product must have at most {MOST_PARTS} factors", at)
            value = self.checked(Value(base.num * n or (ONE,), base.den * n, base.theta * n, base.at), at)
        return value

    def whole_exponent(self) -> int:
        token = self.token
        self.next += 1
        if token.text not in ("^", "**"):
            return int(token.text.translate(SUPERSCRIPTS))
        opened = self.take("(", "{", "[")
        sign = -1 if self.take("-") else 1
        token = self.token
        if token.kind != "number" or not token.text.isascii() or not token.text.isdigit():
            raise self.fault(f"a power must be a whole number, got '{token.text}'")
        self.next += 1
        if opened:
            self.close(opened)
        return sign * int(token.text[:5])

    def atom(self) -> Value:
        token = self.token
        self.next += 1
        match token.kind:
            case "number":
                return Value(((self.number(token),),))
            case "s":
                return Value((S,))
            case "exp":
                return self.exponential(token)
            case "frac":
                top, bottom = self.group(), self.group()
                if is_zero(bottom):
                    raise self.fault("division by zero", token.at)
                return times(top, inverse(bottom))
            case "sign" if token.text in CLOSING:
                self.next -= 1
                return self.group()
            case "sign" if token.text == "-" and self.token.text != "-":  # 2*-s, e^{-s}*-1
                return times(MINUS_ONE, self.power())
            case "sign" if token.text in CLOSING.values():
                raise self.fault(f"'{token.text}' closes a bracket that was not opened", token.at)
        raise self.fault(f"a number, s, exp or a bracket is expected here, got {_named(token)}", token.at)

    def number(self, token: Token) -> Fraction:
        text = token.text.replace(",", ".").lower()
        exponent = text.partition("e")[2]
        if exponent and abs(int(exponent[:6])) > LARGEST_EXPONENT:
            raise self.fault(f"a number must be below 1e{LARGEST_EXPONENT}, got {token.text[:20]}", token.at)
        following = self.token
        if following.kind == "number" and following.at == token.at + len(token.text):
            raise self.fault(f"'{token.text}{following.text}' is not a number", token.at)
        return Fraction(text)

    def group(self) -> Value:
        opened = self.take(*CLOSING)
        if not opened:
            raise self.fault(f"an opening bracket is expected here, got {_named(self.token)}")
        self.depth += 1
        if self.depth > DEEPEST:
            raise self.fault(f"brackets must not be nested more than {DEEPEST} deep", opened.at)
        value = self.sum()
        self.close(opened)
        self.depth -= 1
        return value

    def close(self, opened: Token) -> None:
        if not self.take(CLOSING[opened.text]):
            raise self.fault(
                f"'{opened.text}' of position {opened.at + 1} must be closed by '{CLOSING[opened.text]}', "
                f"got {_named(self.token)}"
            )

    def exponential(self, token: Token) -> Value:
        if token.text == "e":
            self.next += 1  # the power sign, seen by the token's pattern
        value = self.group() if self.token.text in CLOSING else self.bare_exponent()
        exponent = expanded(value.num)
        divisor = expanded(value.den)
        if value.theta or len(divisor) > 1 or len(exponent) > 2 or exponent[0]:
            raise self.fault("the exponent must be a multiple of s, as in e^{-3s} or exp(-3 s)", token.at)
        slope = exponent[1] / divisor[0] if len(exponent) > 1 else Fraction(0)
        return Value((ONE,), (), -slope, token.at)

    def bare_exponent(self) -> Value:
        """-3s, -s, -3*s of e^-3s: a sign, numbers and one s."""
        value = MINUS_ONE if self.take("-") else Value((ONE,))
        while self.token.kind == "number":
            value = times(value, self.atom())
            self.take("*")
        if self.token.kind != "s":
            raise self.fault("the exponent must be a multiple of s, as in e^{-3s} or exp(-3 s)")
        return times(value, self.atom())

    def checked(self, value: Value, at: int) -> Value:
        """`value`, if it is still of a size worth working on."""
        if excess := too_large(value):
            raise self.fault(excess, at)
        return value


def _named(token: Token) -> str:
    return "the end of the text" if token.kind == "end" else f"'{token.text}'"


def _unknown(sign: str) -> str:
    if sign == "e":
        return "e must have an exponent: write e^{-3s} or exp(-3s)"
    if sign.isalpha():
        return f"'{sign}' is not known: write the transfer function in s, with numbers for everything else"
    return f"'{sign}' is not part of a transfer function"
