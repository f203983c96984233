"""What there is to translate: the templates of said, counted and words in Python, of said in JavaScript.

And the texts of the lessons of the program, which are files of TOML.
"""

import ast
import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from babel.messages.catalog import Catalog

ROOT = Path(__file__).parents[3]
MAKERS = ("said", "counted", "words")
MODULES = ("simc_core.wording", "pages.common.words")
TEXT = r'"(?:[^"\\\n]|\\.)*"'
IN_SCRIPT = re.compile(rf"(?<![.\w])said\(\s*((?:{TEXT})(?:\s*\+\s*{TEXT})*\s*[,)])?")
IMPORTED = re.compile(r'^import \{[^}]*\bsaid\b[^}]*\} from "[./\w]*/words\.js";$', re.MULTILINE)
OF_A_LESSON = ("title", "where", "question", "choices", "answer", "misprint")  # what a reader sees of its fields
OF_ITS_PARTS = ("text", "says", "name", "where", "differs")  # of play, moves, claims, printed and cases
NUMBER = re.compile(r"[-\N{MINUS SIGN}]?\d+(\.\d+)?")


class NotPlain(ValueError):
    """A template that cannot be read without running the program."""


@dataclass(frozen=True, slots=True)
class Message:
    """A template, that for other numbers than one, what tells equal ones apart, and the file."""

    one: str
    several: str
    context: str
    place: str

    @property
    def id(self) -> str | tuple[str, str]:
        """As gettext has it."""
        return (self.one, self.several) if self.several else self.one


def everything(root: Path = ROOT) -> Iterator[Message]:
    """All messages of the program, file by file."""
    for folder, suffix, read in (
        ("simc_core", "py", in_python),
        ("pages", "py", in_python),
        ("pages/common/live", "js", in_script),
        ("pages/common/lessons/data", "toml", in_lesson),
    ):
        for path in sorted((root / folder).rglob(f"*.{suffix}")):
            if "vendor" not in path.parts:
                yield from read(path.read_text(encoding="utf-8"), str(path.relative_to(root)))


def in_python(text: str, place: str) -> Iterator[Message]:
    """Those of a Python module that imports the functions by name. Raises NotPlain."""
    tree = ast.parse(text)
    imports = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module in MODULES]
    known = {alias.asname or alias.name: alias.name for node in imports for alias in node.names}
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Name):
            continue
        maker = known.get(node.func.id)
        if maker not in MAKERS or place.startswith("pages/common/words/"):
            continue
        where = f"{place}, line {node.lineno}"
        context = next((_plain(word.value, where) for word in node.keywords if word.arg == "context"), "")
        several = _plain(node.args[1], where) if maker == "counted" else ""
        for one in _chosen(node.args[0]):
            yield Message(_plain(one, where), several, context, place)


def in_script(text: str, place: str) -> Iterator[Message]:
    """Those of a JavaScript module that imports said(): text in double quotes, a long one with + between its parts.

    Raises NotPlain.
    """
    if not IMPORTED.search(text):
        return
    for found in IN_SCRIPT.finditer(text):
        if found[1] is None:
            line = text.count("\n", 0, found.start()) + 1
            raise NotPlain(f"{place}, line {line}: said() takes a text in double quotes")
        yield Message("".join(map(ast.literal_eval, re.findall(TEXT, found[1]))), "", "", place)


def in_lesson(text: str, place: str) -> Iterator[Message]:
    """Those of a lesson: all that a reader sees of it, but for bare numbers."""
    content = tomllib.loads(text)
    parts = [content["play"], *content["moves"], *content.get("cases", {}).values()]
    parts += [*content.get("claims", ()), *content.get("printed", ())]
    found = [content.get(name, "") for name in OF_A_LESSON] + [
        part.get(name, "") for part in parts for name in OF_ITS_PARTS
    ]
    for each in found:
        for one in [each] if isinstance(each, str) else each:
            if one and not is_number(one):
                yield Message(one, "", "", place)


def is_number(text: str) -> bool:
    """Whether a text is a number and nothing else, which has no words."""
    return NUMBER.fullmatch(text) is not None


def template() -> Catalog:
    """All messages as a catalogue without translations."""
    made = Catalog(charset="utf-8")
    for message in sorted(everything(), key=lambda each: (each.place, each.one)):
        made.add(message.id, locations=[(message.place, 0)], context=message.context or None)
    return made


def _chosen(node: ast.expr) -> list[ast.expr]:
    """The node, or both ends of a choice between two."""
    return [*_chosen(node.body), *_chosen(node.orelse)] if isinstance(node, ast.IfExp) else [node]


def _plain(node: ast.expr, where: str) -> str:
    if not (isinstance(node, ast.Constant) and isinstance(node.value, str)):
        raise NotPlain(f"{where}: a template is a plain text, without f, + or a name")
    return node.value
