"""Text that came from a link, a file or a keyboard, shown as it is: never as Markdown, LaTeX or HTML.

Streamlit reads every text of a warning as Markdown and more (links without brackets, :emoji:, arrows, $formulas$).
Inside a code span none of that is read, and what is copied is what came. So foreign text goes into code spans; of a
message that may quote it, only plain words and numbers stay outside. Whatever else is in it, it cannot become markup.
"""

import re

from pages.common.words import translated

WORD = re.compile(
    r"\(?[^\W\d_]+(?:-[^\W\d_]+)*\)?[,;:?]?\.?"
    r"|\(?-?[0-9]+(?:[.,][0-9]+)?(?:e[-+]?[0-9]+)?(?:\)\.?)?[,;:]?"
)
COMPARED = ("<", "<=", ">", ">=", "=")
UNSEEN = "\N{REPLACEMENT CHARACTER}"


def exact(text: str) -> str:
    """Markdown that shows a text exactly, in one code span.

    Parameters
    ----------
    text : str
        Any text. What cannot be printed (controls, lone surrogates, turns of the writing direction) is shown as U+FFFD.

    Returns
    -------
    str
        Markdown for st.markdown, st.warning, st.error.

    References
    ----------
    .. [1] CommonMark 0.31.2, section 6.1, code spans.
    """
    text = printable(text)
    fence = "`" * (1 + _longest_fence(text))
    if not text.strip(" "):
        return f"{fence}{text or ' '}{fence}"
    pad = " " if text[0] in "` " or text[-1] in "` " else ""
    return f"{fence}{pad}{text}{pad}{fence}"


def told(message: str) -> str:
    """Markdown that tells a message of ours which may quote foreign text.

    Parameters
    ----------
    message : str
        One sentence or more, such as str(error), which is told in the language in use.

    Returns
    -------
    str
        Plain words and numbers as they are, everything between them in code spans.
    """
    parts: list[str] = []
    strange: list[str] = []
    for word in printable(translated(message)).split():
        compared = word in COMPARED and (parts or strange)  # at the beginning, > quotes what follows
        if not (compared or WORD.fullmatch(word)):
            strange.append(word)
            continue
        if strange:
            parts.append(exact(" ".join(strange)))
            strange = []
        parts.append(word)
    if strange:
        parts.append(exact(" ".join(strange)))
    return " ".join(parts)


def block(text: str, mark: str = "") -> str:
    """Markdown of a block of code: the text, and below it a line of ours.

    Parameters
    ----------
    text : str
        Any text.
    mark : str
        A line of ours, such as a caret below the fault.

    Returns
    -------
    str
        A fenced block that nothing in the text can close.

    References
    ----------
    .. [1] CommonMark 0.31.2, section 4.5, fenced code blocks.
    """
    text = printable(text)
    fence = "`" * max(3, 1 + _longest_fence(text))
    return f"\n{fence}text\n{text}\n{mark}\n{fence}"


def printable(text: str) -> str:
    """The text with blanks in place of line ends and tabs, and U+FFFD in place of what cannot be printed."""
    return "".join(" " if c in "\t\n\r" else c if c.isprintable() else UNSEEN for c in text)


def _longest_fence(text: str) -> int:
    return max((len(run) for run in re.findall("`+", text)), default=0)
