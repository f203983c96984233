"""Text to tokens: numbers, the variable, words taken whole, signs. A word that is not known is named whole."""

import re
from collections.abc import Collection, Iterator
from typing import NamedTuple

from simc_core.errors import ParseError
from simc_core.numbers.signs import LOWERED, SUPERSCRIPTS
from simc_core.wording import said


class Token(NamedTuple):
    """kind: number, s, name, exp, e, delay, frac, over, bar, sqrt, pi, call, list, power, sign or end; at: position."""

    kind: str
    text: str
    at: int


def fault(message: str, text: str, at: int) -> ParseError:
    """The refusal of what stands at this place of the text."""
    return ParseError(said("{message} (position {at})", message=message, at=at + 1), text, at)


RAISED = SUPERSCRIPTS[:10]
LETTER = rf"(?:(?![{RAISED}½¼¾ˢᵖ])[^\W\d_])"
WITH_POINT = r"[1-9]\d{0,2}(?:(?:,\d{3})+\.|(?:\.\d{3})+,)\d+"
GROUPED = r"[1-9]\d{0,2}(?:[ ']\d{3})+(?![\d])(?:[.,]\d+)?"
SIMPLE = r"\d+(?:\.\d*|,\d+)?|[.,]\d+"
LIST_ITEM = re.compile(rf"[+-]?(?:{SIMPLE})(?:[eE][+-]?\d+)?")
SPACE = re.compile(r"(?:\s|\\(?:left|right|[bB]igg?[lr]?|displaystyle|limits|quad|qquad)(?![a-z])|\\[,;:! ]|~)+")
TIMES = re.compile(rf"\\(?:cdot|times)(?![a-z])|(?<=[\d\s])x(?=\s*10(?:\^|\*\*|[⁻{RAISED}]))")
TOKEN = re.compile(
    rf"(?P<number>(?:{WITH_POINT}|{GROUPED}|{SIMPLE})(?:[eE][+-]?\d+)?)"
    r"|(?P<bar>-{3,}|═+)"
    r"|(?P<list>\[[\d.,eE+\s-]*\])"
    rf"|(?P<delay>e[⁻⁺]?[{RAISED}]*[ˢᵖ])"
    rf"|(?P<word>\\(?:mathrm|text|operatorname|mathit|rm)\s*\{{\s*\w+\s*\}}|[%\\]?{LETTER}(?:{LETTER}|[0-9]|_\w|_\{{\w+\}})*"
    rf"(?:\.{LETTER}\w*)*|[√])"
    rf"|(?P<power>\.?\^|\.?\*\*|[⁺⁻]?[{RAISED}]+)"
    r"|(?P<sign>\.?[*/]|[-+(){}\[\]])"
)
WORDS = {
    "exp": ("exp", "np.exp", "numpy.exp", "math.exp", "sp.exp", "sympy.exp", "cmath.exp"),
    "e": ("e", "%e"),
    "frac": ("frac", "dfrac", "tfrac", "cfrac"),
    "over": ("over",),
    "sqrt": ("sqrt", "np.sqrt", "numpy.sqrt", "math.sqrt", "√"),
    "pi": ("pi", "π", "%pi", "np.pi", "numpy.pi", "math.pi"),
}
KIND_OF = {word: kind for kind, words in WORDS.items() for word in words}
VARIABLES = ("s", "S", "p", "%s")
CALLS = ("tf", "transferfunction", "transferfunctioncontinuous", "zpk", "zerospolesgain", "syslin", "lti", "delay")
LONGEST_ROW = 40  # letters of names written without a sign between
HINTS = {
    "ss": said("state space is not read: write the transfer function, or its coefficients as tf([1 2], [1 3 2])"),
    "statespace": said(
        "state space is not read: write the transfer function, or its coefficients as tf([1 2], [1 3 2])"
    ),
    "pade": said("the dead time is exact here: write exp(-2s) in place of its Padé approximation"),
    "z": said("a sampled model in z is not read: write the transfer function in s"),
    "jw": said("write the transfer function in s, not its frequency response"),
    "jω": said("write the transfer function in s, not its frequency response"),
    "log": said("work it out and write a number"),
    "feedback": said("work out the closed loop first, or enter the plant alone"),
    "poly": said("write its factors, as in (s+1)(s+2)"),
    **dict.fromkeys(
        ("q", "filt", "dlti", "drss", "c2d"), said("a sampled model is not read: write the transfer function in s")
    ),
    "series": said("write the two with * between them"),
    "parallel": said("write the two with + between them"),
    "minreal": said("leave it out"),
    **dict.fromkeys(
        ("u", "y", "r"), said("only the transfer function between input and output is read: leave u and y out")
    ),
    "x10": said("write 1.5e-3 or 1.5*10^-3 for a power of ten"),
    **dict.fromkeys(("d", "D"), said("write 1.5e-3 for a power of ten")),
    **dict.fromkeys(
        ("step", "bode", "nyquist", "margin", "plot", "pidtune", "print"), said("leave it out, only the plant is read")
    ),
    **dict.fromkeys(
        ("min", "sec", "h", "hr", "ms", "rad"), said("leave units out, and write all times in the same one")
    ),
    **dict.fromkeys(
        ("fopdt", "sopdt", "gain", "lag", "delay", "theta", "tau", "dead", "time", "first", "second", "with"),
        said("write parameters with =, as in k=2, tau=10, theta=3"),
    ),
}
SIGN_HINTS = {
    "%": said("write 0.5, or 50, for 50 %"),
    "°": said("leave the unit out"),
    ",": said("a decimal comma stands between digits; a dead time behind a comma is written theta = 3"),
    "=": said("enter one transfer function, or give every name before = a value"),
    **dict.fromkeys("\"'", said("leave the quotes out")),
    "@": said("leave @(s) out"),
    "±": said("enter one value"),
    ":": said("write / for a division"),
    **dict.fromkeys("→≈", said("write =")),
    "½": said("write 0.5 or 1/2"),
    "¼": said("write 0.25 or 1/4"),
    "¾": said("write 0.75 or 3/4"),
}
IN_S = said("write the transfer function in s, with numbers for everything else")
A_NAME = said("{in_s}, or give it a value behind: K/(T s+1), K=2, T=5", in_s=IN_S)


def tokens(text: str, plain: str, start: int, stop: int, names: Collection[str]) -> Iterator[Token]:
    """The tokens of plain[start:stop], and an end.

    text: what was typed, for errors. names: what has a value besides s and functions.
    """
    plain = TIMES.sub(lambda found: "*".ljust(len(found[0])), plain)
    at = start
    while at < stop:
        if space := SPACE.match(plain, at, stop):
            at = space.end()
            continue
        found = TOKEN.match(plain, at, stop)
        if not found:
            hint = f": {SIGN_HINTS[text[at]]}" if text[at] in SIGN_HINTS else ""
            raise fault(said("'{text}' is not part of a transfer function{hint}", text=text[at], hint=hint), text, at)
        kind, written = found.lastgroup, found[0]
        assert kind is not None  # every alternative of TOKEN has a name
        if kind == "list" and not _is_list(written):
            kind, written = "sign", "["
        if kind == "word":
            for token in _word(text, plain, written, at, names):
                yield token
                at = token.at + len(token.text)
            continue
        yield Token(kind, written.lstrip(".") if kind in ("power", "sign") else written, at)
        at += len(written)
    yield Token("end", said("the end"), stop)


def _is_list(written: str) -> bool:
    """Whether [..] holds at least two numbers side by side, and not a sum or one number in brackets."""
    words = re.split(r"\s*,\s*|\s+", written[1:-1].strip().rstrip(","))
    return len(words) > 1 and all(LIST_ITEM.fullmatch(word) for word in words)


def bare(word: str) -> str:
    r"""A name without its typesetting: \tau_{1} and τ_1 are tau1."""
    inner = re.sub(r"^\\(?:mathrm|text|operatorname|mathit|rm)\s*\{\s*(.*?)\s*\}$", r"\1", word)
    letters = {"τ": "tau", "θ": "theta", "ζ": "zeta", "ϑ": "theta"}
    for sign, name in letters.items():
        inner = inner.replace(sign, name)
    return re.sub(r"[\\_{}]", "", inner)


def _word(text: str, plain: str, written: str, at: int, names: Collection[str]) -> list[Token]:
    """A word as one token, or, as in Ks, sexp or s2, as the known ones it is made of."""
    name = bare(written)
    if name in names:
        return [Token("name", written, at)]
    known = name if name in KIND_OF else name.lower()
    kind = KIND_OF.get(known)
    end = at + len(written)
    opened = plain[end:].lstrip()[:1] == "("
    if kind == "e" and not re.match(r"\s*(?:\.?\^|\*\*)", plain[end:]):
        raise _lost_exponent(text, plain, at, end)
    if kind:
        return [Token(kind, written, at)]
    if written in VARIABLES:
        return [Token("s", written, at)]
    if opened and known.rpartition(".")[2] in CALLS:
        return [Token("call", plain[at : _closing(text, plain, end + plain[end:].index("("))], at)]
    parts = [] if opened and len(written) > 1 else _pieces(written, at, names, plain)
    if not parts:
        raise _unknown(text, known, written, at)
    return parts


def _pieces(written: str, at: int, names: Collection[str], plain: str) -> list[Token]:
    """The word as a row of names, variables and exponentials; empty if it is none."""
    if not 0 < len(written) <= LONGEST_ROW:
        return []
    for length in range(len(written), 0, -1):
        piece, rest = written[:length], written[length:]
        after = at + length
        if bare(piece) in names:
            kind = "name"
        elif piece in VARIABLES:
            kind = "s"
        elif piece == "exp" or (piece == "e" and re.match(r"\s*(?:\^|\*\*)", plain[after:])):
            kind = piece
        elif piece == "pi":
            kind = "pi"
        elif piece.isdigit() and piece.isascii() and not rest:
            kind = "number"
        else:
            continue
        following = _pieces(rest, after, names, plain)
        return [Token(kind, piece, at), *following] if following or not rest else []
    return []


def _closing(text: str, plain: str, at: int) -> int:
    """The position after the bracket that closes the one at `at`."""
    depth = 0
    for i in range(at, len(plain)):
        depth += (plain[i] in "([{") - (plain[i] in ")]}")
        if depth == 0:
            return i + 1
    raise ParseError(said("'(' of position {at} must be closed by ')', found the end of the text", at=at + 1), text, at)


def _lost_exponent(text: str, plain: str, at: int, end: int) -> ParseError:
    lost = re.match(r"\s*-\s*([\d.,]*)\s*\*?\s*[sp]", plain[end:])
    hint = said(": did you mean e^(-{lost}s)?", lost=lost[1]) if lost else said(": write e^{-3s} or exp(-3s)")
    return fault(said("e must have an exponent{hint}", hint=hint), text, at)


def _unknown(text: str, known: str, written: str, at: int) -> ParseError:
    shown = written if len(written) <= 30 else written[:27] + "..."
    key = known.rpartition(".")[2]
    hint = HINTS.get(key, HINTS.get(key.lower(), A_NAME if len(bare(written)) <= 2 else IN_S))
    return fault(said("'{shown}' is not known: {hint}", shown=shown, hint=hint), text, at)


def superscript_delay(written: str) -> int:
    """The exponent of s in e⁻³ˢ."""
    digits = written[1:-1].translate(LOWERED)
    return int(digits if digits.strip("+-") else digits + "1")
