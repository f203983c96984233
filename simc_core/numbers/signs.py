"""Signs that look alike, each made one: dashes, blanks, fraction bars, dots, wide signs, italic letters."""

import unicodedata

BLANKS = "\u00a0\u2007\u2008\u2009\u202f"  # typographers' blanks, some of them separators of thousands
INVISIBLE = "\u200b\u200c\u200d\u200e\u200f\u2060\ufeff"  # carried along by a copy from a page
ALIKE: dict[int, int | str] = {
    **{0xFF01 + i: 0x21 + i for i in range(94)},
    **dict.fromkeys(map(ord, "−‐‑‒–—﹣"), "-"),
    **dict.fromkeys(map(ord, "⁄∕÷"), "/"),
    **dict.fromkeys(map(ord, "·×⋅∙•∗"), "*"),
    **dict.fromkeys(map(ord, BLANKS), " "),
    **dict.fromkeys(map(ord, "’′‘"), "'"),
    **dict.fromkeys(map(ord, "。．"), "."),
    # letters of formulas, as in 𝐺(𝑠) = 2𝑒^{−3𝑠}
    **{code: unicodedata.normalize("NFKC", chr(code)) for code in (*range(0x1D400, 0x1D800), *map(ord, "ℯℊℎℓ"))},
}
SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻"
LOWERED = str.maketrans(SUPERSCRIPTS, "0123456789+-")


def tidied(text: str) -> str:
    """`text` with one sign for those that look alike; every position stays."""
    return text.translate(ALIKE)
