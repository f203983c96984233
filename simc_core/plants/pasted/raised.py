"""Exponents that programs print on a line of their own, above the s or e that they belong to.

 2                  -3s
s  + 3 s + 1     2 e
"""

import re

RUN = r"[+-]?(?:\d{1,2}[sp]?|[sp])"
RAISED_LINE = re.compile(rf"\s*{RUN}(?:\s+{RUN})*\s*")
HIGH = str.maketrans("0123456789+-sp", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ˢᵖ")
BASES = {False: "sSp)", True: "e"}  # of a number; of a multiple of s


def with_superscripts(text: str) -> str:
    """`text`, as long as before, with raised exponents as superscripts where each stands right behind its base."""
    lines = text.split("\n")
    i = 0
    while i + 1 < len(lines):
        merged = _merged(lines[i], lines[i + 1]) if RAISED_LINE.fullmatch(lines[i]) else None
        if merged is not None:
            lines[i : i + 2] = [merged.rjust(len(lines[i]) + 1 + len(lines[i + 1]))]
        i += 1
    return "\n".join(lines)


def _merged(raised: str, base: str) -> str | None:
    """The base line with superscripts, None where one of them finds no base or no room."""
    signs = list(base.ljust(len(raised.rstrip())))
    for run in re.finditer(r"\S+", raised):
        start, stop = run.span()
        allowed = BASES[run[0][-1] in "sp"]
        if not start or signs[start - 1] not in allowed or "".join(signs[start:stop]).strip():
            return None
        signs[start:stop] = run[0].translate(HIGH)
    return "".join(signs)
