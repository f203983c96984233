"""Sentences that can be told in another language: an English str that remembers its template and its values.

The core knows no language. It says `said("{field} must be at least {bound:g}", field="k", bound=2.0)`, which is the
str "k must be at least 2" to everyone, and to a translator its template with what stands in its places.
"""

from collections.abc import Iterable, Mapping
from typing import Any


class Numeral(str):
    """A number written for the eye, which another language may write with a decimal comma."""

    __slots__ = ()


class Text(str):
    """An English sentence that knows what it was made of.

    Attributes
    ----------
    template : str
        The sentence with {places}, as it stands in a catalogue; empty for one of `joined`.
    values : Mapping
        What stands in its places: numbers, symbols, further Texts.
    several : str
        Of `counted`: the template for other numbers than one, else empty.
    n : int
        Of `counted`: the number that decides.
    context : str
        Tells equal English words apart that other languages do not have in common.
    """

    __slots__ = ("context", "n", "several", "template", "values")

    template: str
    values: Mapping[str, Any]
    several: str
    n: int
    context: str

    def __new__(
        cls,
        english: str,
        template: str,
        values: Mapping[str, Any],
        several: str = "",
        n: int = 1,
        context: str = "",
    ) -> "Text":
        text = super().__new__(cls, english)
        text.template, text.values, text.several, text.n, text.context = template, values, several, n, context
        return text

    def __str__(self) -> str:
        """Itself, so that str(error) still knows."""
        return self

    def __reduce__(self) -> tuple:
        english = str.__str__(self)
        return Text, (english, self.template, self.values, self.several, self.n, self.context)

    def put(self, **values: Any) -> "Text":
        """The same sentence with other values in some of its places."""
        return _made(self.template, {**self.values, **values}, self.several, self.n, self.context)


def renamed(text: str, names: Mapping[str, str]) -> str:
    """A text in which some things are called otherwise, as a page calls what the core calls "tau1"."""
    if isinstance(text, Text):
        called = {place: names[value] for place, value in text.values.items() if type(value) is str and value in names}
        return text.put(**called)
    for name, instead in names.items():
        text = text.replace(name, instead)
    return text


def said(template: str, /, *, context: str = "", **values: Any) -> Text:
    """A sentence.

    Parameters
    ----------
    template : str
        With {places}, as for str.format; without values its braces are what they are.
    context : str
        Where the same English words need several translations: what they are about.
    **values
        Numbers, symbols, foreign text, further Texts.
    """
    return _made(template, values, "", 1, context)


def counted(one: str, several: str, /, n: int, *, context: str = "", **values: Any) -> Text:
    """A sentence about `n` things, which is {n} in both templates: that of one, and that of any other number."""
    return _made(one, {"n": n, **values}, several, n, context)


def joined(parts: Iterable[str], between: str = ", ") -> Text:
    """Sentences or words one after the other, none of which forgets what it was made of."""
    kept = tuple(parts)
    return Text(between.join(kept), "", {"parts": kept, "between": between})


def _made(template: str, values: Mapping[str, Any], several: str, n: int, context: str) -> Text:
    chosen = several if several and n != 1 else template
    english = chosen.format(**values) if values else chosen
    return Text(english, template, values, several, n, context)
