"""Links and project files of all kinds: read or refused in words, and never shown as markup.

What Markdown makes of a text is asked of markdown-it, a CommonMark parser that our code does not use. What Streamlit
reads beyond CommonMark is tried in the browser, tests/browser/test_foreign_text.py.
"""

import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from markdown_it import MarkdownIt

from pages.common.parts.foreign_text import block, exact, printable, told
from pages.common.session import links, project
from pages.common.session.fields import PLACES
from pages.common.session.loops import Loops
from tests.pages.tools import run_page

MARKDOWN = MarkdownIt("commonmark").enable(["table", "strikethrough"])
ATTACKS = (
    "![x](//host/a.png)",
    "[Log in](//host)",
    "<img src=//host/a.png>",
    "<script>alert(1)</script>",
    "https://host/a",
    "www.host.org",
    "someone@host.org",
    "$\\href{//host}{x}$",
    "$$x$$",
    ":red[x] :smile: :material/login:",
    "`` ` ``` `",
    "``` \n# x\n- y",
    "\\",
    "a -> b <- c",
    "1. x",
    "| a |\n|---|\n| b |",
    "\u202eabc\u200b\x00\x1b[31m",
    "&lt;b&gt; &amp;",
    "",
    " ",
)
FOREIGN = st.one_of(st.text(max_size=60), st.sampled_from(ATTACKS), st.text("`\\$*_[]()<>!:/ab \n#|~-", max_size=40))


def inline(markdown: str) -> list:
    """The pieces of a text that must be one paragraph."""
    opened, content, closed = MARKDOWN.parse(markdown)
    assert (opened.type, content.type, closed.type) == ("paragraph_open", "inline", "paragraph_close")
    return content.children


@given(FOREIGN.filter(str.strip))
def test_exact_is_one_code_span_with_the_very_text(text):
    pieces = inline("shown " + exact(text))
    assert [piece.type for piece in pieces] == ["text", "code_inline"]
    assert pieces[1].content == printable(text)


@given(FOREIGN.filter(str.strip), st.sampled_from(["form must be one of series, ideal, found ", ""]))
def test_a_message_has_words_and_code_spans_and_nothing_else(text, said):
    pieces = inline("Refused: " + told(said + text))
    assert {piece.type for piece in pieces} <= {"text", "code_inline"}
    assert "".join(piece.content for piece in pieces).split() == ("Refused: " + printable(said + text)).split()


@pytest.mark.parametrize("message", ["tight, (position 4). found 0.5", "row 2: choose what kind of factor this is"])
def test_plain_words_stay_plain(message):
    assert told(message) == message


@given(FOREIGN)
def test_nothing_closes_a_block(text):
    [fence] = MARKDOWN.parse(block(text, "^"))
    assert (fence.type, fence.content) == ("fence", f"{printable(text)}\n^\n")


NAMES = st.one_of(st.sampled_from([*PLACES]), FOREIGN)
VALUES = st.one_of(FOREIGN, st.floats().map(str), st.sampled_from(["1e400", "-0", "٣", "1_000", "0x10", "1~0~~1~0~x"]))


@settings(max_examples=300, derandomize=True)
@given(st.dictionaries(NAMES, VALUES, max_size=6))
def test_any_link_is_read_or_refused_in_words(parameters):
    design, ignored = links.decode(parameters)
    assert links.decode(links.encode(design)) == (design, [])
    for notice in ignored:
        pieces = inline(f"{exact(notice.given)} was ignored: {told(notice.why)}")
        assert {piece.type for piece in pieces} <= {"text", "code_inline"}


JSON = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), FOREIGN),
    lambda inner: st.one_of(st.lists(inner, max_size=3), st.dictionaries(FOREIGN, inner, max_size=3)),
    max_leaves=6,
)


@settings(max_examples=200, derandomize=True)
@given(st.fixed_dictionaries({}, optional=dict.fromkeys(("format", "version", "design", "loops", "current"), JSON)))
def test_any_json_is_read_or_refused_in_words(wrong):
    for content in (wrong, json.loads(project.dump(Loops())) | wrong):
        design, why = project.load(json.dumps(content).encode())
        assert (design is None) == bool(why)
        assert design is not None or {p.type for p in inline("Not opened: " + told(why))} <= {"text", "code_inline"}


@settings(max_examples=200, derandomize=True)
@given(st.data())
def test_any_bytes_are_read_or_refused_in_words(data):
    content = bytearray(project.dump(Loops()).encode())
    for _ in range(data.draw(st.integers(1, 4))):
        at = data.draw(st.integers(0, len(content) - 1))
        content[at : at + data.draw(st.integers(0, 3))] = data.draw(st.binary(max_size=3))
    design, why = project.load(bytes(content))
    assert (design is None) == bool(why)


def test_the_mark_that_windows_puts_before_a_text_does_no_harm():
    loops = Loops()
    assert project.load(b"\xef\xbb\xbf" + project.dump(loops).encode()) == (loops, "")


@pytest.mark.parametrize("where", ["plant", "form", "\\udfff", "version"])
def test_half_a_character_is_refused_in_words(where):
    content = json.loads(project.dump(Loops()))
    if where == "version":
        content["version"] = "\ud800"
    else:
        content["loops"][0]["design"][where.replace("\\udfff", "\udfff")] = "\ud800"
    design, why = project.load(json.dumps(content).encode())
    assert design is None
    assert "half a character" in why


def test_half_a_character_in_the_storage_of_the_browser_is_no_project():
    loops, why = project.load('{"format": "\ud800"}'.encode(errors="surrogatepass"))
    assert (loops, why) == (None, "it is not JSON text")


@pytest.mark.parametrize("attack", ATTACKS)
def test_a_page_stays_a_page(attack):
    app = run_page("plant", plant=attack, form=attack, rules=attack, **{attack or "x": attack})
    for alert in app.warning:
        for paragraph in alert.value.split("\n\n- ")[1:]:
            pieces = inline(paragraph.split("\n- ")[0])
            assert {piece.type for piece in pieces} <= {"text", "code_inline"}
    field = app.text_input("plant_text_text").set_value(attack).run()
    assert not field.exception
    content = {"format": "simc-project", "version": 1, "design": {"plant": attack, attack: attack}}  # one of old
    upload = app.file_uploader("project_file")
    upload.set_value((f"{attack}.json".replace("\x00", ""), json.dumps(content).encode(), "application/json")).run()
    assert not app.exception


@pytest.mark.parametrize("attack", ATTACKS)
def test_my_plant_on_the_first_page_is_read_or_refused_in_words(attack):
    app = run_page("home")
    app.text_input("home_plant").set_value(attack)
    next(button for button in app.button if button.label == "Tune").click().run()
    assert not app.exception
    [refused] = app.error
    opened, words, closed, *quoted = MARKDOWN.parse(refused.value.removeprefix("**This cannot be read.** "))
    assert (opened.type, closed.type) == ("paragraph_open", "paragraph_close")
    assert {piece.type for piece in words.children} <= {"text", "code_inline"}
    assert [piece.type for piece in quoted] == ["fence"] * bool(attack.strip())
