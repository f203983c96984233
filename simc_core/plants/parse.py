"""Transfer functions as people write and paste them.

    (1-2s)/((10s+1)(6s+1)(s+1))   2 e^{-0.5s}/(s(3s+1)^2)   G(s) = 0,5 e⁻³ˢ/(2p+1)²   k=2, tau=10, theta=3
    tf([1 2],[1 3 2],'InputDelay',0.5)   \\frac{2 e^{-2s}}{5s+1}   K e^{-L s}/(T s+1), K=2, T=5, L=1

Brackets may be (), [] or {}; a decimal comma counts as a point. Numbers are kept as exact fractions, and factors that
were written apart stay apart, so that nothing is lost on the way. What could be read in two ways, like 1/2s, 1,000 or
5e-3s, is refused with the way out; nothing is ever evaluated as code, and the work is bounded.
"""

import re
from fractions import Fraction

from simc_core.errors import InvalidParameter, ParseError
from simc_core.numbers.refusal import quoted
from simc_core.plants.parse_values import Value, degree, inverse, number_of, plant_of, polynomial, times
from simc_core.plants.pasted.calls import coefficients, read_call, with_numbers
from simc_core.plants.pasted.clutter import without_clutter
from simc_core.plants.pasted.factored import read_factored
from simc_core.plants.pasted.grammar import Reader
from simc_core.plants.pasted.parameters import DAMPING, DELAYS, GAINS, LAGS, from_parameters
from simc_core.plants.pasted.statements import Statement, statements
from simc_core.plants.pasted.tokens import fault
from simc_core.plants.plant import Plant
from simc_core.wording import said

LONGEST_TEXT = 2000
WITH_UNIT = re.compile(
    r"(?P<number>[-+]?[\d.,]*\d(?:[eE][-+]?\d+)?) *(?:[%°]?[^\W\d_]+|%)(?: */ *(?:[%°]?[^\W\d_]+|%))?"
)
LIST = re.compile(r"\[[^\[\]]*\]['.]*|(?:\w+\.)?(?:array|conv|convolve|polymul)\s*\(.*\)", re.DOTALL)
EXAMPLE = said("for instance exp(-3s)/((6s+1)(4s+1))")


def parse_plant(text: str) -> Plant:
    """The plant that a text describes.

    Parameters
    ----------
    text : str
        A transfer function in s or p, with or without a name before it; a constructor call or the print-out of
        MATLAB, Octave, python-control, scipy or Scilab; LaTeX; or a list of parameters like k=2, tau=10, theta=3.

    Returns
    -------
    Plant
        Factors of first order and complex pairs as written, to the last bit; the dead time exact.

    Raises
    ------
    ParseError
        With the position of the fault, and the way out.
    InvalidParameter
        Where the plant itself is out of bounds.

    Examples
    --------
    >>> from simc_core import parse_plant
    >>> plant = parse_plant("exp(-3s)/((6s+1)(4s+1)(2s+1))")
    >>> plant.theta, plant.lags
    (3.0, (6.0, 4.0, 2.0))
    """
    if not isinstance(text, str):
        raise ParseError(said("a transfer function must be text, found {name__}", name__=type(text).__name__))
    if len(text) > LONGEST_TEXT:
        raise ParseError(
            said(
                "text must have at most {longest_text} characters, found {text}",
                longest_text=LONGEST_TEXT,
                text=len(text),
            ),
            text,
            LONGEST_TEXT,
        )
    if not text.strip():
        raise ParseError(said("text must not be empty: write a transfer function, {example}", example=EXAMPLE), text)
    try:
        return read_factored(text) or _plant(text)
    except OverflowError:
        raise ParseError(said("numbers here grow beyond all bounds"), text) from None


def _plant(text: str) -> Plant:
    value = _Statements(text).value()
    if value.theta < 0:
        raise ParseError(
            said(
                "dead time must be >= 0, found {theta:g}: e^{{+{theta_2:g}s}} would look into the future; a dead"
                " time of {theta_2:g} is e^{{-{theta_2:g}s}}",
                theta=float(value.theta),
                theta_2=-float(value.theta),
            ),
            text,
            value.at,
        )
    if not value.den and degree(value):
        raise ParseError(
            said("a denominator is missing: write / between numerator and denominator, as in 2/(10s+1)"),
            text,
            len(text),
        )
    return plant_of(value)


class _Statements:
    """The statements of a text, read with the values that they give one another."""

    def __init__(self, text: str):
        self.text = text
        self.plain = without_clutter(text)
        self.numbers: dict[str, tuple[Fraction, Statement]] = {}
        self.lists: dict[str, Statement] = {}
        self.functions: list[tuple[Value, Statement]] = []
        self.names: dict[str, Value] = {}
        self.used: set[str] = set()

    def value(self) -> Value:
        parts = statements(self.plain)
        if not parts:
            raise ParseError(
                said("a transfer function is missing here: write one, {example}", example=EXAMPLE), self.text
            )
        for part in parts:
            self.refuse_unit(part)
        others = [part for part in parts if not self.read_list(part) and not self.read_number(part)]
        for part in others:
            self.read_function(part)
        if not self.functions and {"num", "den"} <= self.lists.keys() | self.numbers.keys():
            self.functions = [(times(self.names["num"], inverse(self.names["den"])), parts[-1])]
            self.used |= {"num", "den"}
        for name, part in self.lists.items():
            if name not in self.used:
                way_out = (
                    said("leave it out")
                    if self.functions
                    else said("name two lists num and den, or write tf([2], [10 1])")
                )
                raise self.fault(
                    said(
                        "'{name}' is a list of numbers and is not used: {way_out}",
                        name=quoted(part.name),
                        way_out=way_out,
                    ),
                    part,
                )
        unused = {name: given for name, given in self.numbers.items() if name not in self.used}
        if not self.functions:
            return from_parameters(self.text, unused)
        value = self.functions[-1][0]
        for other, part in self.functions[:-1]:
            if part.key not in self.used:
                if number_of(other) is not None and not part.name:
                    raise self.fault(said("a number stands here without a name: write theta = 3 for a dead time"), part)
                raise self.fault(said("there are two transfer functions in this text: enter one of them"), part)
        return self.delayed(value, unused)

    def read_list(self, part: Statement) -> bool:
        """Whether the statement gives coefficients a name, den = [10 1]; if so they are kept."""
        given = self.plain[part.start : part.stop].strip()
        lone = part.key not in ("num", "den") and not re.search(r"[\s,]", given[1:-1].strip())
        if part.names_a_plant or part.key.lower() in (*GAINS, *LAGS, *DELAYS) or lone or not LIST.fullmatch(given):
            return False
        try:
            found = coefficients(quoted(part.name), with_numbers(given, self.names, self.used))
        except InvalidParameter as error:
            raise self.fault(str(error), part) from None
        self.lists[part.key] = part
        self.names[part.key] = polynomial(found)
        return True

    def read_number(self, part: Statement) -> bool:
        """Whether the statement gives a number its name; if so it is kept."""
        if part.names_a_plant or not _only_digits(self.plain[part.start : part.stop]):
            return False
        number = number_of(self.reader(part).plant())
        if number is None:
            raise self.fault(said("'{name}' must be one number", name=quoted(part.name)), part)
        if part.key in ("s", "e"):
            raise self.fault(said("'{name}' cannot be given a value here", name=quoted(part.name)), part)
        if part.key in self.numbers:
            raise self.fault(said("'{name}' is given twice", name=quoted(part.name)), part)
        self.numbers[part.key] = number, part
        self.names[part.key] = Value(((number,),))
        return True

    def refuse_unit(self, part: Statement) -> None:
        found = WITH_UNIT.fullmatch(self.plain[part.start : part.stop].strip())
        if found and part.key.lower() in (*GAINS, *LAGS, *DELAYS, *DAMPING):
            raise self.fault(
                said(
                    "'{name}' must be a number without a unit, all times in the same one: write {name} = {found}",
                    name=quoted(part.name),
                    found=found["number"],
                ),
                part,
            )

    def read_function(self, part: Statement) -> None:
        if part.key.lower() in DELAYS:
            raise self.fault(
                said("'{name}' must be a number without a unit, as in {name} = 3", name=quoted(part.name)), part
            )
        reader = self.reader(part)
        value = reader.plant()
        self.used |= reader.used
        self.functions.append((value, part))
        if part.key:
            self.names[part.key] = value

    def reader(self, part: Statement) -> Reader:
        return Reader(self.text, self.plain, part.start, part.stop, self.names, read_call)

    def delayed(self, value: Value, unused: dict[str, tuple[Fraction, Statement]]) -> Value:
        """The transfer function with a dead time that was given beside it, G = ..., L = 0.5."""
        for name, (number, part) in unused.items():
            if name.lower() not in DELAYS:
                raise self.fault(
                    said(
                        "'{name}' is given a value and is not used: write theta = {number:g} if it is the dead time, "
                        "or leave it out",
                        name=quoted(part.name),
                        number=float(number),
                    ),
                    part,
                )
            if value.theta:
                raise self.fault(said("the dead time is given twice: leave one out"), part)
            value = Value(value.num, value.den, number, part.at)
        return value

    def fault(self, message: str, part: Statement) -> ParseError:
        return fault(message, self.text, part.at)


def _only_digits(text: str) -> bool:
    """Whether the text can be a number: no letters but those of 1e-3, pi and sqrt."""
    words = text.lower().replace("sqrt", "").replace("pi", "").replace("π", "")
    return not any(sign.isalpha() and not sign.isdigit() and sign != "e" for sign in words) and text.strip() != ""
