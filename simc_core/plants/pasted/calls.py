"""Constructor calls of MATLAB, Octave, python-control, scipy and Scilab: tf, zpk, TransferFunction, syslin, delay."""

import re
from collections.abc import Mapping
from fractions import Fraction

from simc_core.errors import InvalidParameter
from simc_core.numbers import read_exact_numbers
from simc_core.numbers.one import read_exact
from simc_core.numbers.several import program_list
from simc_core.plants.parse_values import ONE, S, Value, constant, inverse, is_zero, number_of, polynomial, times
from simc_core.plants.pasted.grammar import DEEPEST, Reader
from simc_core.plants.pasted.tokens import HINTS, Token, bare
from simc_core.wording import said

DELAYS = ("inputdelay", "outputdelay", "iodelay")
SAMPLING = ("dt", "ts")
OF_NO_MEANING = ("variable", "timeunit", "name", "inputs", "outputs", "inputname", "outputname")
NUMERATORS, DENOMINATORS = ("num", "numerator"), ("den", "denominator")
CONTINUOUS = ("", "0", "0.0", "none", "'c'", '"c"')
LONE_VARIABLE = re.compile(r"(?<![^\W\d_])[sp](?!\w)")
NAME = re.compile(r"(?<![\w.])[^\W\d]\w*")
COMPLEX = re.compile(
    r"(?P<real>[+-]?[\d.]+(?:e[+-]?\d+)?)?(?P<imag>[+-](?:[\d.]+(?:e[+-]?\d+)?)?)\*?[ij]", re.IGNORECASE
)


def read_call(reader: Reader, token: Token) -> Value:
    """The value of a call token, tf([1 2], [1 3 2], 'InputDelay', 0.5)."""
    written = token.text.partition("(")[0].strip()
    function = bare(written).lower().rpartition(".")[2]
    parts = _arguments(token.text, token.text.index("(") + 1)
    try:
        return _value(function, written, reader, token, parts)
    except InvalidParameter as error:
        raise reader.fault(str(error), token.at) from None


def _value(function: str, written: str, reader: Reader, token: Token, parts: list[tuple[str, int]]) -> Value:
    given, theta = _options(written, parts)
    if function == "delay" and len(given) == 1:
        return Value((ONE,), (), _number(said("the dead time"), given[0]), token.at)
    if function == "syslin" and given and given[0].strip("'\"") == "c":
        return _syslin(reader, token, parts)
    if function == "lti" and len(given) == 4:
        raise InvalidParameter(
            said("state space is not read: write numerator and denominator, as in tf([1 2], [1 3 2])")
        )
    if (function in ("zpk", "zerospolesgain") and len(given) in (3, 4)) or (function == "lti" and len(given) == 3):
        _check_continuous(written, given[3:])
        zeros, poles = _roots("zeros", given[0]), _roots("poles", given[1])
        value = times(times(zeros, inverse(poles)), constant(_number("gain", given[2])))
    elif function in ("tf", "lti", "transferfunction", "transferfunctioncontinuous") and len(given) in (2, 3):
        if len(given) == 3 and given[2] in ("s", "p"):  # sympy
            given.pop()
        elif len(given) == 3 and written.lower() == "transferfunction":
            theta += _number(said("the dead time"), given.pop())
        _check_continuous(written, given[2:])
        numerator, denominator = (
            _polynomial(reader, token, name, part)
            for name, part in zip((said("numerator"), said("denominator")), given, strict=False)
        )
        if is_zero(denominator):
            raise InvalidParameter(said("denominator must not be zero, found 0"))
        value = times(numerator, inverse(denominator))
        theta += value.theta
    elif function in ("tf", "zpk") and len(given) == 1 and given[0].strip("'\"") in ("s", "p"):
        return Value((S,))
    elif function in ("tf", "zpk") and given and given[0].strip("'\"") in ("z", "q"):
        raise InvalidParameter(HINTS["z"])
    else:
        raise InvalidParameter(
            said(
                "{written}(...) is not understood with these arguments: write numerator and denominator, as in "
                "tf([1 2], [1 3 2])",
                written=written,
            )
        )
    return Value(value.num, value.den, theta, token.at)


def _arguments(text: str, at: int) -> list[tuple[str, int]]:
    """The arguments of a call, each with its place, split at the commas outside of brackets and quotes."""
    parts, depth, start, quote = [], 0, at, ""
    for i in range(at, len(text)):
        sign = text[i]
        if quote:
            quote = "" if sign == quote else quote
        elif sign == '"' or (sign == "'" and text[:i].rstrip()[-1] in "(,"):
            quote = sign
        elif (sign == "," and depth == 0) or (sign == ")" and depth == 0):
            parts.append((text[start:i], start))
            start = i + 1
        else:
            depth += (sign in "([{") - (sign in ")]}")
    return parts


def _options(written: str, parts: list[tuple[str, int]]) -> tuple[list[str], Fraction]:
    """Arguments by position, and the dead time given by name, 'InputDelay', 0.5 or InputDelay=0.5."""
    theta, given = Fraction(0), []
    words = [part.strip() for part, _ in parts]
    while words:
        word = words.pop(0)
        named = re.fullmatch(r"(\w+)\s*[=:]\s*(.*)", word, re.DOTALL)
        key = (named[1] if named else word.strip("'\"")).lower()
        quoted = word[:1] in "'\"" and word[:1] != ""
        if not named and not (quoted and words and key in (*DELAYS, *SAMPLING, *OF_NO_MEANING)):
            given.append(word)
            continue
        value = named[2] if named else words.pop(0)
        if key in DELAYS:
            theta += _number(key, value)
        elif key in NUMERATORS:
            given.insert(0, value)
        elif key in DENOMINATORS:
            given.append(value)
        elif key in SAMPLING:
            _check_continuous(written, [value])
        elif key == "variable" and value.strip("'\"") not in ("s", "p"):
            raise InvalidParameter(
                said(
                    "{written}(...) in {value} is a sampled model: {hints}",
                    written=written,
                    value=value,
                    hints=HINTS["z"],
                )
            )
        elif key not in OF_NO_MEANING:
            raise InvalidParameter(
                said("'{key}' in {written}(...) is not known: leave it out", key=key, written=written)
            )
    return given, theta


def _check_continuous(written: str, more: list[str]) -> None:
    if more and more[0].strip()[:1] in ("[", "{"):
        raise InvalidParameter(
            said(
                "{written}(...) has too many arguments: write decimal points, and commas between arguments "
                "alone, as in tf(0.5, [10 1])",
                written=written,
            )
        )
    if more and more[0].strip().lower() not in CONTINUOUS:
        raise InvalidParameter(
            said(
                "the number {more} at the end of {written}(...) is a sampling time, and sampled models are not "
                "read: if it is the dead time, write 'InputDelay' before it",
                more=more[0].strip()[:20],
                written=written,
            )
        )


def _syslin(reader: Reader, token: Token, parts: list[tuple[str, int]]) -> Value:
    """syslin('c', num/den) and syslin('c', num, den)."""
    values = [_inside(reader, token.at + at, token.at + at + len(part)) for part, at in parts[1:3]]
    if not values:
        raise InvalidParameter(said("syslin needs a transfer function, as in syslin('c', 2/(5*%s+1))"))
    return values[0] if len(values) == 1 else reader.divided(values[0], values[1], token.at)


def _inside(reader: Reader, start: int, stop: int) -> Value:
    """The value of an argument that is itself a transfer function."""
    if reader.depth >= DEEPEST:
        raise reader.fault(said("brackets must not be nested more than {deepest} deep", deepest=DEEPEST), start)
    inner = Reader(reader.text, reader.plain, start, stop, reader.names, reader.call)
    inner.depth = reader.depth + 1
    value = inner.plant()
    reader.used |= inner.used
    return value


def _polynomial(reader: Reader, token: Token, name: str, part: str) -> Value:
    """Coefficients, their name, or a polynomial in s: [T 1], den, 10*s + 1."""
    if bare(part) in reader.names:
        reader.used.add(bare(part))
        return reader.names[bare(part)]
    if "[" not in part and LONE_VARIABLE.search(part):
        start = reader.plain.index(part, token.at)
        return _inside(reader, start, start + len(part))
    return polynomial(coefficients(name, with_numbers(part, reader.names, reader.used)))


def with_numbers(text: str, names: Mapping[str, Value], used: set[str]) -> str:
    """[T 1] as [10 1] where the name T has this value."""

    def number(found: re.Match) -> str:
        name = bare(found[0])
        value = number_of(names[name]) if name in names else None
        if value is None:
            return found[0]
        used.add(name)
        return str(value)

    return NAME.sub(number, text)


def coefficients(name: str, text: str) -> list[Fraction]:
    """The numbers of a list as programs write it, or of conv([1 2], [3 4])."""
    text = text.strip().rstrip("'.")
    if re.fullmatch(r"\[[^\[\](){};]*\]", text):
        return program_list(name, text)
    return read_exact_numbers(name, text)


def _number(name: str, text: str) -> Fraction:
    return read_exact(name, text.strip().removeprefix("[").removesuffix("]"))


def _roots(name: str, text: str) -> Value:
    """prod(s - root) of [-1, -2+3i, -2-3i], complex ones in pairs."""
    value = Value((ONE,))
    waiting: list[tuple[Fraction, Fraction]] = []
    words = re.split(r"\s*[,;]\s*|\s+", text.strip().strip("'.[]{} "))
    for word in filter(None, words):
        found = COMPLEX.fullmatch(word)
        if not found:
            value = times(value, Value(((-read_exact(name, word), Fraction(1)),)))
            continue
        size = found["imag"] + ("1" if found["imag"] in "+-" else "")
        root = read_exact(name, found["real"] or "0"), read_exact(name, size)
        if (root[0], -root[1]) in waiting:
            waiting.remove((root[0], -root[1]))
            value = times(value, Value(((root[0] ** 2 + root[1] ** 2, -2 * root[0], Fraction(1)),)))
        else:
            waiting.append(root)
    if waiting:
        raise InvalidParameter(said("complex {name} must come in conjugate pairs, as in [-1+2i, -1-2i]", name=name))
    return value
