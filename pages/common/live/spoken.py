"""The words of the scripts in one language, as JavaScript that stands before them: see kit/words.js. No streamlit."""

import json
from functools import cache
from pathlib import Path

from pages.common.words.catalogues import catalogue
from pages.common.words.extraction import in_script
from simc_core.wording import Text

HERE = Path(__file__).parent


def spoken(language: str) -> str:
    """`const SPOKEN = ...;` with all templates of the scripts; nothing for English, which they are written in."""
    known = catalogue(language)
    if known is None:
        return ""
    words = {template: known.template(Text(template, template, {})) for template in _templates()}
    return f"const SPOKEN = {json.dumps({'language': language, 'words': words, 'decimal': ','}, ensure_ascii=False)};\n"


@cache
def _templates() -> tuple[str, ...]:
    files = [file for file in sorted(HERE.rglob("*.js")) if "vendor" not in file.parts]
    return tuple(each.one for file in files for each in in_script(file.read_text(encoding="utf-8"), file.name))
