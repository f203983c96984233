"""What stands round a transfer function and means nothing: comments, quotes, $...$, headings that programs print.

Everything is replaced by blanks, so that positions stay those of the text as typed.
"""

import re

from simc_core.numbers.signs import INVISIBLE, tidied
from simc_core.plants.pasted.raised import with_superscripts

COMMENT = re.compile(r"(?<![^\s;)\]}])(?<!\d )[%#]+(?![sp]\b|pi\b|e\b)(?P<words>\s*[^\W\d_][^\n]*)?")
PRINTED = re.compile(
    r"<TransferFunction>:?\s*\S*"
    r"|(?:Inputs|Outputs) \(\d+\): \[.*?'\](?=\s|$)"
    r"|Transfer function\b.*?output\s*'?\w*'?\s*(?:\.\.\.|:)?"
    r"|From input\b.*?to output\b.*?(?:\.\.\.|:)"
    r"|Transfer function:"
    r"|TransferFunction\{[^{}]*\}"
    r"|Continuous-time[\w/ -]*?(?:function model|function|model)\.?"
    r"|Model Properties"
    r"|\by\d+:(?=\s)"
    r"|\bsyms\s+[sp]\b"
    r"|\bfrom\s+[\w.]+\s+import\s+(?:\w+(?:\s*,\s*\w+)*|\*)|\bimport\s+[\w.]+(?:\s+as\s+\w+)?"
    r"|\bpkg\s+load\s+\w+"
    r"|(?<=[,(])\s*\.{3}(?=\s)",
    re.IGNORECASE,
)
LATEX = re.compile(
    r"\\(?:begin|end)\{[a-z]+\*?\}|\\label\{[^{}]*\}|\\nonumber|\\tag\{[^{}]*\}|\\q?quad(?![a-z])|\\\\|\\(?=\s)|&"
)
UNIT = re.compile(r"(?<=[\s)])\[\s*(?!(?:[sp]|exp)\s*\])[^\W\d_°]*[%°]?[^\W\d_]*(?:\s*/\s*(?:°?[^\W\d_]+|%))?\s*\]\s*$")
ROMAN = re.compile(r"\{\s*\\rm\s+(\w+)\s*\}")
QUOTES = ("$$", "$", "'", '"', "```", "`")
WRAPPERS = (*((quote, quote) for quote in QUOTES), (r"\(", r"\)"), (r"\[", r"\]"))
LATEX_COMMA = re.compile(r"(?<=\d)\{,\}(\d+)")
SHORT_BAR = re.compile(r"(?<=\n)[ \t]*[-─━⎯]{1,2}[ \t]*(?=\n)")
LONG_BAR = re.compile(r"[─━⎯―_]{3,}")
BAR = re.compile(r"-{3,}")
BESIDE_BAR = re.compile(r"(?<!\S)[^\W\d_][^\s=]*(?:\s*\(\s*[sp]\s*\))?[ \t]*=(?=[ \t]*(?:-{3,}|═))", re.IGNORECASE)
TRAILING = ";., \t\n\r"


def without_clutter(text: str) -> str:
    """`text` with blanks where it meant nothing; as long as before."""
    plain = tidied(text)
    for sign in INVISIBLE:
        plain = plain.replace(sign, " ") if plain.startswith(sign) or plain.endswith(sign) else plain
    plain = LATEX_COMMA.sub(r",\1  ", with_superscripts(_blanked(PRINTED, plain)))
    plain = SHORT_BAR.sub(lambda found: re.sub(r"\S", "═", found[0]), plain)
    plain = LONG_BAR.sub(lambda found: "═" * len(found[0]), plain)
    plain = _blanked(BESIDE_BAR, plain)
    drawn = bool(BAR.search(plain) or "═" in plain)
    plain = COMMENT.sub(lambda found: _comment(found, drawn), plain)
    plain = _blanked(UNIT, _blanked(LATEX, plain))
    plain = ROMAN.sub(lambda found: found[1].rjust(len(found[0])), plain)
    return _unwrapped(plain)


def _comment(found: re.Match, drawn: bool) -> str:
    """Blanks for a comment; of a fraction drawn in comment lines only the marks go."""
    if found["words"] and not drawn:
        return " " * len(found[0])
    return found[0].replace("%", " ").replace("#", " ") if drawn else found[0]


def _blanked(pattern: re.Pattern, text: str) -> str:
    return pattern.sub(lambda found: " " * len(found[0]), text)


def _unwrapped(text: str) -> str:
    """Without what encloses the whole text, and without punctuation after it."""
    while True:
        start, stop = len(text) - len(text.lstrip()), len(text.rstrip(TRAILING))
        if text[start:stop].endswith("\\") and text[stop : stop + 1] == ";":
            stop += 1
        inner = text[start:stop]
        found = next(
            (
                (opening, closing)
                for opening, closing in WRAPPERS
                if inner.startswith(opening)
                and inner.endswith(closing)
                and len(inner) > len(opening) + len(closing)
                and opening not in inner[len(opening) : -len(closing)]
            ),
            None,
        )
        if not found:
            # the full stop of 5. belongs to the number, and one at the end of a lone sign is all there is
            return (text[:stop] + " " * (len(text) - stop)) if inner else text
        opening, closing = found
        text = (
            text[:start]
            + " " * len(opening)
            + text[start + len(opening) : stop - len(closing)]
            + " " * (len(text) - stop + len(closing))
        )
