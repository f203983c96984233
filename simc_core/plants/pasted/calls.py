"""Constructor calls of MATLAB, Octave, python-control, scipy and Scilab: tf, zpk, TransferFunction, syslin, delay."""

import re
from fractions import Fraction

from simc_core.errors import InvalidParameter
from simc_core.numbers import read_exact_numbers
from simc_core.numbers.one import read_exact
from simc_core.numbers.several import program_list
from simc_core.plants.parse_values import ONE, S, Value, constant, inverse, polynomial, times
from simc_core.plants.pasted.grammar import DEEPEST, Reader
from simc_core.plants.pasted.tokens import Token, bare

DELAYS = ("inputdelay", "outputdelay", "iodelay")
OF_NO_MEANING = ("variable", "timeunit", "name", "inputs", "outputs", "inputname", "outputname")
CONTINUOUS = ("", "0", "0.0", "none", "'c'", '"c"')
COMPLEX = re.compile(
    r"(?P<real>[+-]?[\d.]+(?:e[+-]?\d+)?)?(?P<imag>[+-](?:[\d.]+(?:e[+-]?\d+)?)?)\*?[ij]", re.IGNORECASE
)


def read_call(reader: Reader, token: Token) -> Value:
    """The value of a call token, tf([1 2], [1 3 2], 'InputDelay', 0.5)."""
    opened = token.text.index("(")
    function = bare(token.text[:opened].strip()).lower().rpartition(".")[2]
    parts = _arguments(token.text, opened + 1)
    try:
        return _value(function, token.text[:opened].strip(), reader, token, parts)
    except InvalidParameter as error:
        raise reader.fault(str(error), token.at) from None


def _value(function: str, written: str, reader: Reader, token: Token, parts: list[tuple[str, int]]) -> Value:
    given, theta = _options(written, parts)
    if function == "delay" and len(given) == 1:
        return Value((ONE,), (), _number("the dead time", given[0]), token.at)
    if function == "syslin" and given and given[0].strip("'\"") == "c":
        return _syslin(reader, token, parts)
    if function in ("zpk", "zerospolesgain") and len(given) in (3, 4):
        _check_continuous(written, given[3:])
        zeros, poles = _roots("zeros", given[0]), _roots("poles", given[1])
        value = times(times(zeros, inverse(poles)), constant(_number("gain", given[2])))
    elif function in ("tf", "lti", "transferfunction", "transferfunctioncontinuous") and len(given) in (2, 3):
        if len(given) == 3 and written.lower() == "transferfunction":
            theta += _number("the dead time", given.pop())
        _check_continuous(written, given[2:])
        numerator, denominator = polynomial(_list("numerator", given[0])), polynomial(_list("denominator", given[1]))
        if not any(map(any, denominator.num)):
            raise InvalidParameter("denominator must not be zero, got 0")
        value = times(numerator, inverse(denominator))
    elif function == "tf" and len(given) == 1 and given[0].strip("'\"") in ("s", "p"):
        return Value((S,))
    else:
        raise InvalidParameter(
            f"{written}(...) is not understood with these arguments: write numerator and denominator, "
            "as in tf([1 2], [1 3 2])"
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
        if not named and not (quoted and words and key in (*DELAYS, *OF_NO_MEANING)):
            given.append(word)
            continue
        value = named[2] if named else words.pop(0)
        if key in DELAYS:
            theta += _number(key, value)
        elif key in ("dt", "ts"):
            _check_continuous(written, [value])
        elif key not in OF_NO_MEANING:
            raise InvalidParameter(f"'{key}' in {written}(...) is not known: leave it out")
    return given, theta


def _check_continuous(written: str, more: list[str]) -> None:
    if more and more[0].strip().lower() not in CONTINUOUS:
        raise InvalidParameter(
            f"the number {more[0].strip()[:20]} at the end of {written}(...) is a sampling time, and sampled models "
            "are not read: if it is the dead time, write 'InputDelay' before it"
        )


def _syslin(reader: Reader, token: Token, parts: list[tuple[str, int]]) -> Value:
    """syslin('c', num/den) and syslin('c', num, den)."""
    if reader.depth >= DEEPEST:
        raise reader.fault(f"brackets must not be nested more than {DEEPEST} deep", token.at)
    values = []
    for part, at in parts[1:3]:
        start = token.at + at
        inner = Reader(reader.text, reader.plain, start, start + len(part), reader.names, reader.call)
        inner.depth = reader.depth + 1
        values.append(inner.plant())
    if not values:
        raise InvalidParameter("syslin needs a transfer function, as in syslin('c', 2/(5*%s+1))")
    return values[0] if len(values) == 1 else reader.divided(values[0], values[1], token.at)


def _list(name: str, text: str) -> list[Fraction]:
    text = text.strip().rstrip("'.")
    if re.fullmatch(r"\[[^\[\](){};]*\]", text):
        return program_list(name, text)
    return read_exact_numbers(name, text)


def _number(name: str, text: str) -> Fraction:
    return read_exact(name, text.strip().removeprefix("[").removesuffix("]"))


def _roots(name: str, text: str) -> Value:
    """prod(s - root) of [-1, -2+3i, -2-3i], complex ones in pairs."""
    value, waiting = Value((ONE,)), []
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
        raise InvalidParameter(f"complex {name} must come in conjugate pairs, as in [-1+2i, -1-2i]")
    return value
