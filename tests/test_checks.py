"""The checks at the door: what they let through, and what they say of what they do not."""

from types import MappingProxyType

import numpy as np
import pytest
from markdown_it import MarkdownIt

from pages.common.parts.foreign_text import told
from simc_core import checks
from simc_core.errors import BoxError, DataError, InvalidParameter
from simc_core.wording import Text, said

KINDS = ("PI", "PID")


@pytest.mark.parametrize("choices", [KINDS, list(KINDS), set(KINDS), dict.fromkeys(KINDS), MappingProxyType({"PI": 1})])
def test_one_of_the_choices_passes_whatever_holds_them(choices):
    assert checks.one_of("kind", "PI", choices) == "PI"


@pytest.mark.parametrize("choices", [KINDS, dict.fromkeys(KINDS)])
@pytest.mark.parametrize(
    ("value", "found"),
    [
        ("PD", "'PD'"),
        ("pi", "'pi'"),
        ("", "''"),
        (" PI", "' PI'"),
        ("P", "'P'"),
        (None, "None"),
        (1, "1"),
        (float("nan"), "nan"),
        (True, "True"),
        (b"PI", "b'PI'"),
        (["PI"], "['PI']"),
        ({"PI": 1}, "{'PI': 1}"),
        (np.array(["PI", "PID"]), "array(['PI', 'PID'], dtype='<U3')"),
        ("PI\nPID\x1b[31m", "'PI\\nPID\\x1b[31m'"),
        ("{name} {0}", "'{name} {0}'"),
    ],
)
def test_anything_else_is_refused_and_named(value, found, choices):
    with pytest.raises(InvalidParameter) as refused:
        checks.one_of("kind", value, choices)
    assert str(refused.value) == f"kind must be one of PI, PID, found {found}"


@pytest.mark.parametrize("value", ["x" * 1_000_000, ["x"] * 100_000, "`" * 50])
def test_long_foreign_values_are_cut(value):
    with pytest.raises(InvalidParameter) as refused:
        checks.one_of("kind", value, KINDS)
    found = str(refused.value).removeprefix("kind must be one of PI, PID, found ")
    assert len(found) == 40
    assert found == repr(value)[:37] + "..."


@pytest.mark.parametrize("value", ["<b>PI</b>", "[PI](http://a.b)", "**PI** `x`", "$x$ :red[y]", "# PI\n\n- ![a](b)"])
def test_markup_of_a_foreign_value_is_shown_and_not_obeyed(value):
    with pytest.raises(InvalidParameter) as refused:
        checks.one_of("kind", value, KINDS)
    [opened, content, closed] = MarkdownIt("commonmark").parse("Refused: " + told(str(refused.value)))
    assert (opened.type, closed.type) == ("paragraph_open", "paragraph_close")
    assert {piece.type for piece in content.children} == {"text", "code_inline"}


def test_an_empty_choice_passes_and_is_not_told():
    assert checks.one_of("box", "", ("", "a", "b")) == ""
    with pytest.raises(InvalidParameter, match=r"^box must be one of a, b, found 'c'$"):
        checks.one_of("box", "c", ("", "a", "b"))


def test_the_sentence_remembers_its_places_and_its_choices_theirs():
    with pytest.raises(InvalidParameter) as refused:
        checks.one_of("form", "x", (said("series"), said("ideal")))
    text = str(refused.value)
    assert isinstance(text, Text)
    assert text.template == "{name} must be one of {choices}, found {found}"
    assert [part.template for part in text.values["choices"].values["parts"]] == ["series", "ideal"]


def test_the_refusal_may_be_another_error():
    with pytest.raises(DataError, match=r"^sheet must be one of Trend, found 'x'$"):
        checks.one_of("sheet", "x", ["Trend"], DataError)
    with pytest.raises(BoxError) as refused:
        checks.one_of("structure", 0, ["A"], lambda message: BoxError(message, "structure"))
    assert (str(refused.value), refused.value.field) == ("structure must be one of A, found 0", "structure")


def test_text_of_at_most_so_many_characters():
    assert checks.text("tag", "12345", 5) == "12345"
    assert checks.text("tag", "", 5) == ""
    with pytest.raises(InvalidParameter, match=r"^tag may have at most 5 characters, found 6$"):
        checks.text("tag", "123456", 5)
    for value, kind in ((None, "NoneType"), (1, "int"), (b"1", "bytes"), (["1"], "list")):
        with pytest.raises(InvalidParameter, match=f"^tag must be text, found {kind}$"):
            checks.text("tag", value, 5)
