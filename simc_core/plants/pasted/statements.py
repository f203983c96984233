"""Text taken apart at its equal signs: G(s) = ..., theta = 3; a list of parameters k=2, tau=10, theta=3."""

import re
from typing import NamedTuple

from simc_core.plants.pasted.tokens import bare

WORD = (
    r"(?:dead[ -]?time|time constant|(?:time|transport) delay|process gain|"
    r"\\(?:hat|tilde|bar|mathrm|mathbf|text)\s*\{[^{}=]{1,20}\}|\\?[^\W\d_]\w*)"
    r"(?:_\{[^{}=]{1,20}\}|\^\{?\w\}?|')*(?:\.[^\W\d_]\w*)*(?:\s*\(\s*(?:[spSzt]|jw|jω|iω)\s*\))?"
)
RATIO = rf"(?:\\[dt]?frac\s*\{{\s*{WORD}\s*\}}\s*\{{\s*{WORD}\s*\}}|{WORD}(?:\s*/\s*{WORD})?)"
ASSIGNMENT = re.compile(rf"(?<![\w.\\/*^+)}}\]-])(?P<name>{RATIO})\s*(?P<sign>:=|==?|≈|≅|≃|≡|~=|:(?=\s*[-+]?[\d.,]))")
TITLE = re.compile(r"\s*(?P<name>[^\W\d_][\w .]{0,40}?(?:\(\s*[sp]\s*\))?)\s*:(?![=])")
VARIABLE = re.compile(
    r"\s*(?:\w+\.)*(?:(?:tf|zpk)\s*\(\s*['\"][sp]['\"]\s*\)|TransferFunction\.s|%s|poly\s*\(\s*0\s*,\s*['\"]s['\"]\s*\)"
    r"|(?:Symbol|symbols|var)\s*\(\s*['\"][sp]['\"]\s*\))\s*;?\s*$"
)
# words before the first name, Transfer function G(s) = ...: letters alone, no name of one or two
IN_CAPTION = r"(?:(?!(?:exp|sqrt)\b)[^\W\d_]{3,}|of|to|is|in|as|an|a)"
CAPTION = re.compile(rf"\s*{IN_CAPTION}(?:[\s,.]+{IN_CAPTION})*[\s,.]*")
JOINS = re.compile(r"(?:[\s;,]|\b(?:and|with|where|for|then)\b)+$")
PLANT_LETTERS = ("G", "P", "H", "W", "Y", "y", "g", "h", "sys", "plant", "process", "tf", "F")


class Statement(NamedTuple):
    """name = text[start:stop]; name "" where there is none, at: where the name stands."""

    name: str
    start: int
    stop: int
    at: int

    @property
    def names_a_plant(self) -> bool:
        """Whether a mere number may be the gain of a plant of this name: G, P(s), sys."""
        if not self.name or re.search(r"\([sp]\)$", self.name, re.IGNORECASE):
            return True
        return bool(re.fullmatch(rf"(?:{'|'.join(PLANT_LETTERS)})(?:\d|[a-z]\d?|_\w+)?", self.key))

    @property
    def key(self) -> str:
        """The name without typesetting, and without the variable it belongs to: G.InputDelay is InputDelay."""
        return bare(re.sub(r"\s|\(\w\)", "", self.name)).rpartition(".")[2].replace("'", "").replace("-", "")


def statements(plain: str) -> list[Statement]:
    """The statements of a text without clutter; definitions of the variable s are left out."""
    found = [match for match in ASSIGNMENT.finditer(plain) if _at_top(plain, match.start())]
    first = found[0].start() if found else len(plain)
    heads = [("", 0, 0)]
    if lead := re.match(r"\s*=", plain):
        heads = [("", lead.end(), 0)]
    elif title := TITLE.match(plain, 0, first):
        heads = [(re.sub(r".* ", "", title["name"]), title.end(), 0)]
    heads += [(match["name"].strip(), match.end(), match.start()) for match in found]
    parts: list[Statement] = []
    for i, (name, start, at) in enumerate(heads):
        stop = heads[i + 1][2] if i + 1 < len(heads) else len(plain)
        stop = start + len(JOINS.sub("", plain[start:stop])) if start <= stop else start
        last = i + 1 == len(heads)
        if not plain[start:stop].strip() and (not last or parts):
            continue
        caption = not name and not last and CAPTION.fullmatch(plain, start, stop)
        if not caption and not VARIABLE.match(plain, start, stop):
            parts += _split(plain, Statement(name, start, stop, at))
    return parts


def _split(plain: str, statement: Statement) -> list[Statement]:
    """At semicolons between transfer functions without names."""
    marks = [i for i in range(statement.start, statement.stop) if plain[i] == ";" and _at_top(plain, i)]
    marks = [i for i in marks if plain[i - 1] != "\\"]
    edges = [statement.start, *[i + 1 for i in marks]]
    stops = [*marks, statement.stop]
    return [
        Statement(statement.name if start == statement.start else "", start, stop, statement.at)
        for start, stop in zip(edges, stops, strict=True)
        if plain[start:stop].strip() or len(edges) == 1
    ]


def _at_top(plain: str, at: int) -> bool:
    """Whether no bracket is open at this place."""
    return not any(plain.count(opening, 0, at) > plain.count(closing, 0, at) for opening, closing in ("()", "[]", "{}"))
