"""ES modules of several files as one text: Streamlit's components take no other.

Every module becomes a function of its own that returns what it exports, and an import takes names out of what that
function returned. Names of one file are therefore never those of another, as in the browser's own modules.
"""

import re
from pathlib import Path

IMPORT = re.compile(r'^import \{([^}]*)\} from "([^"]+)";\n', re.MULTILINE)
EXPORT = re.compile(r"^export (?=(?:function|class|const) (\w+))", re.MULTILINE)


def bundled(entry: Path) -> str:
    """The module `entry` with all that it imports, each once and before those that import it."""
    order: dict[Path, str] = {}
    body = _body(entry.resolve(), order)
    return "\n".join([*order.values(), body])


def _body(module: Path, order: dict[Path, str]) -> str:
    """The text of the module, its imports taken from functions in `order`, which are put there."""

    def take(found: re.Match) -> str:
        other = (module.parent / found[2]).resolve()
        if other not in order:
            order[other] = _as_function(other, order)
        return f"const {{{found[1].replace(' as ', ': ')}}} = {_name(other)};\n"

    return IMPORT.sub(take, module.read_text(encoding="utf-8"))


def _as_function(module: Path, order: dict[Path, str]) -> str:
    text = _body(module, order)
    exported = ", ".join(EXPORT.findall(text))
    return f"const {_name(module)} = (() => {{\n{EXPORT.sub('', text)}return {{ {exported} }};\n}})();\n"


def _name(module: Path) -> str:
    return f"${module.parent.name}_{module.stem}"
