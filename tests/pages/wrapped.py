"""A language made by the program, ⟦in brackets⟧, and all that a page shows: what is outside is in no catalogue."""

import json
import re
import struct
from collections.abc import Iterator
from html import unescape

import pandas as pd
from streamlit.testing.v1 import AppTest

from pages.common.session import state
from pages.common.take_home.written import LANGUAGES
from pages.common.words import catalogues
from simc_core import BOXES
from simc_core.many.columns import COLUMNS
from simc_core.published.sources import SOURCES
from simc_core.wording import Text

BRACKETS = "xx"
NOT_SEEN = {  # fields of Streamlit's messages that hold names, addresses and code
    *("id", "form_id", "element_id", "key", "user_key", "url", "page_script_hash", "query_params"),
    *("url_pathname", "icon", "color", "component_name", "html_content", "css_content", "js_content"),
    *("column_order", "columns", "avatar", "group_id", "fragment_id", "delta_path", "type", "value"),
    *("default", "config", "text_alignment", "page", "bytes", "mixed", "deferred_file_id"),
    *("string_value", "default_state_key", "language", "theme", "styler", "arrow_data", "set_value"),
    *("query_string", "string_values", "raw_values", "content_hash", "source_code", "isolate_styles"),
    *("mime_type"),
}
FOREIGN = {"text", "mine", "known", "file"}
HEADINGS = {column.name for column in COLUMNS}  # of lists of loops, as they stand in files
FORMULAS = {  # as code, and typed numbers, which every language writes with points
    "2.2 exp(-20s)/(180s+1)",
    "Time\tPV\tOP\n0\t20.5\t40\n1\t20.5\t45",
}
TOLD = {"label", "meaning", "action", "actions", "labels", "presets", "bands", "pins"}  # of a message to an instrument
IN_FIGURES = {"text", "title", "name", "hovertemplate", "customdata"}
MARKUP = re.compile(
    r"(?P<code>(?P<fence>`+).*?(?<!`)(?P=fence)(?!`))|\$\$.*?\$\$|\$[^$]*\$|%\{[^{}]*\}|<style>.*?</style>|</?[a-zA-Z][^<>]*>|:material/\w+:|:\w+\["
    r"|\]\(\S+ \"[^\"]*\"\)|\]\([^()]*\)",
    re.DOTALL,
)
INNER = re.compile("⟦[^⟦⟧]*⟧")
WORD = re.compile(r"[^\W\d_]{3,}")
# No words of English: symbols, abbreviations of the field, names of formats.
SYMBOLS = {
    "PID",
    "Mst",
    "SIMC",
    "iSIMC",
    "IAE",
    "exp",
    "cos",
    "sin",
    "min",
    "max",
    "arg",
    "lim",
    "rad",
    "PSB",
    "Msa",
    "Msb",
    "Mpa",
    "tau",
    "alpha",
    "CSV",
    "JSON",
    "SVG",
}
# Of papers: authors, title, place. Those that have words of ours are sentences of the catalogue.
REFERENCES = [
    part for full in SOURCES.values() if not isinstance(full, Text) for part in (full, full.split(" https:")[0])
]
# What makers call their boxes, fields and languages; where they use a word of English, it is not exempt.
NAMES = {
    *(language.title for language in LANGUAGES.values()),
    *(each.name for box in BOXES.values() for each in box.fields),
    *(
        name
        for box in BOXES.values()
        for text in (*box.structures, *box.actions)
        for name in (text, *text.split(" = "))
    ),
}
PRODUCTS = [re.escape(name) for name in NAMES if not isinstance(name, Text) and (name != name.lower() or "-" in name)]
PRODUCT = re.compile(rf"(?<!\w)(?:{'|'.join(sorted(PRODUCTS, key=len, reverse=True))})(?!\w)")
ADDRESS = re.compile(r"https\\?://[^\s\"\])]+")
NAME_OF_LOOP = re.compile(r"Lesson \w+")  # of a lesson, which links hold
SOURCE = re.compile(r"\[[A-Z]{2,4}\d{2}[^\]]*\]|\b[A-Z]{3,4}\d{2}\b")


class Brackets(catalogues.Catalogue):
    """A catalogue that has every sentence."""

    def __init__(self) -> None:
        super().__init__({}, lambda n: 0)

    def template(self, text: Text) -> str:
        """The template in brackets."""
        english = text.several if text.several and text.n != 1 else text.template
        return "⟧  ⟦[".join(f"⟦{english}⟧".split("  ["))  # axes: a name and, in square brackets, a unit


def offer_brackets(monkeypatch) -> None:
    """Have the language for one test; links with lang=xx open it."""
    monkeypatch.setitem(catalogues.OFFERED, BRACKETS, "in brackets")
    monkeypatch.setattr(catalogues, "_read", lambda language: Brackets())


def speak_brackets(monkeypatch) -> None:
    """The same, in use everywhere: AppTest asks widgets for their words outside of a session too."""
    offer_brackets(monkeypatch)
    monkeypatch.setattr(state, "language", lambda: BRACKETS)
    monkeypatch.setattr("pages.common.words._told_by", [lambda: BRACKETS])


def left_in_english(app: AppTest) -> list[str]:
    """What the page shows outside brackets, but for symbols, numbers, foreign text, formulas, names of languages."""
    found = []
    for place, text in visible(app):
        known = text in FORMULAS | HEADINGS or text in catalogues.OFFERED.values() or NAME_OF_LOOP.fullmatch(text)
        bare = "" if known else outside(text)
        if any(word not in SYMBOLS for word in WORD.findall(bare)) or re.search(r"\d\.\d", bare):
            found.append(f"{place}: {text}")
    return found


def outside(text: str) -> str:
    """A text without markup, without references, and without what is in brackets."""
    for reference in REFERENCES:
        text = text.replace(reference, " ")
    bare = ADDRESS.sub(" ", MARKUP.sub(" ", _without_brackets(text)))
    return PRODUCT.sub(" ", SOURCE.sub(" ", unescape(_without_brackets(bare))))


def _without_brackets(text: str) -> str:
    before = ""
    while text != before:
        text, before = INNER.sub(" ", text), text
    return text


def visible(app: AppTest) -> Iterator[tuple[str, str]]:
    """Every text on the page with the kind of element it stands in."""

    def walk(node) -> Iterator[tuple[str, str]]:
        proto = getattr(node, "proto", None)
        if proto is not None:
            kind = type(proto).__name__
            if kind == "PlotlyChart":
                yield from ((f"figure, {where}", text) for where, text in _of_figure(json.loads(proto.spec)))
                yield "figure, alt", proto.alt
            elif kind in ("Arrow", "Dataframe"):
                yield from _of_table(node.value, getattr(proto, "columns", ""))
            elif kind == "BidiComponent":
                yield from _of_component(proto)
            elif kind not in ("Text", "Code"):  # addresses and programs, which have no language
                yield from ((f"{kind}, {where}", text) for where, text in _of_proto(proto))
        for child in getattr(node, "children", {}).values():
            yield from walk(child)

    yield from walk(app._tree)


def _of_component(proto) -> Iterator[tuple[str, str]]:
    """What a component of ours is told beside foreign text and numbers."""
    for name, text in json.loads(proto.json or "{}").items() if proto.HasField("json") else ():
        if isinstance(text, str) and name not in FOREIGN:
            yield f"{proto.component_name}, {name}", text
    if proto.HasField("bytes"):
        (length,) = struct.unpack_from("<I", proto.bytes)
        header = json.loads(proto.bytes[4 : 4 + length])
        yield from ((f"{proto.component_name}, {where}", text) for where, text in _of_instrument(header))


def _of_instrument(node, name: str = "", told: bool = False) -> Iterator[tuple[str, str]]:
    """What an instrument is told to show: names of things are beside numbers and code."""
    if isinstance(node, str):
        if told:
            yield name, node
    elif isinstance(node, dict):
        for inner, value in node.items():
            yield from _of_instrument(value, inner, told or inner in TOLD)
    elif isinstance(node, list):
        for value in node[-1:] if name == "of a band" else node:
            yield from _of_instrument(value, "of a band" if name == "bands" else name, told)


def _of_proto(proto) -> Iterator[tuple[str, str]]:
    for field, value in proto.ListFields():
        if field.name in NOT_SEEN:
            continue
        for each in value if field.is_repeated else (value,):
            if isinstance(each, str):
                yield field.name, each
            elif hasattr(each, "ListFields"):
                yield from _of_proto(each)


def _of_figure(node, name: str = "") -> Iterator[tuple[str, str]]:
    if isinstance(node, str):
        if name in IN_FIGURES:
            yield name, node
    elif isinstance(node, dict):
        hidden = {"template"} if "%{customdata" in node.get("hovertemplate", "") else {"template", "customdata"}
        for inner, value in node.items():
            if inner not in hidden:
                yield from _of_figure(value, inner)
    elif isinstance(node, list):
        for value in node:
            yield from _of_figure(value, name)


def _of_table(table: pd.DataFrame, columns: str) -> Iterator[tuple[str, str]]:
    settings = json.loads(columns or "{}")
    for name in table.columns:
        setting = settings.get(name, {})
        yield "column", setting.get("label") or str(name)
        shown = {one["value"]: one["label"] for one in setting.get("type_config", {}).get("options", ())}
        for cell in [*shown, *table[name]]:
            if isinstance(cell, str):
                yield f"cell of {name}", shown.get(cell, cell)
