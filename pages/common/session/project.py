"""All loops as a project file: JSON with a version, checked on the way in. Pure: no streamlit.

    {"format": "simc-project", "version": 2, "current": 0, "loops": [{"id": "...", "design": {"plant": "...", ...}}]}

A design holds the same names and texts as a link does. Files of version 1 hold one design and are read as before.
The browser's own storage holds the same text.
"""

import json
import re

from pages.common.session import links
from pages.common.session.design import Design
from pages.common.session.loops import MOST_LOOPS, Entry, Loops, new_id
from simc_core.errors import SimcError
from simc_core.wording import joined, said

FORMAT = "simc-project"
VERSION = 2
LARGEST = 200_000  # bytes
ID = re.compile(r"[0-9a-f]{1,32}")


def dump(loops: Loops) -> str:
    """The file's text."""
    kept = [{"id": entry.id, "design": links.encode(entry.design)} for entry in loops.entries]
    content = {"format": FORMAT, "version": VERSION, "current": loops.current, "loops": kept}
    return json.dumps(content, indent=2) + "\n"


def load(data: bytes) -> tuple[Loops | None, str]:
    """The loops of a file, or None and the reason in words. All of it must be right, or none is taken."""
    if len(data) > LARGEST:
        return None, f"a project file has at most {LARGEST} bytes, found {len(data)}"
    try:
        content = json.loads(data.decode("utf-8-sig"))  # Windows puts a mark before the text
        json.dumps(content, ensure_ascii=False).encode()
    except UnicodeEncodeError:  # \ud800 alone is JSON, but no character
        return None, "it holds half a character: a surrogate without its other half"
    except (UnicodeDecodeError, ValueError, RecursionError):
        return None, "it is not JSON text"
    if not isinstance(content, dict) or content.get("format") != FORMAT:
        return None, f'it is not a project file of this program: "format" must be "{FORMAT}"'
    version = content.get("version")
    if isinstance(version, bool) or version not in (1, VERSION):
        return None, f"version must be 1 or {VERSION}, found {str(version)[:40]}"
    if version == 1:
        content = {"loops": [content], "current": 0}
    try:
        return _loops(content), ""
    except SimcError as error:
        return None, str(error)


def _loops(content: dict) -> Loops:
    listed, current = content.get("loops"), content.get("current", 0)
    if not isinstance(listed, list) or not 1 <= len(listed) <= MOST_LOOPS:
        raise SimcError(said('"loops" must be a list of 1 to {most_loops} loops', most_loops=MOST_LOOPS))
    if isinstance(current, bool) or not isinstance(current, int):
        raise SimcError(said('"current" must be the place of a loop in the list'))
    return Loops(tuple(_entry(each) for each in listed), current)


def _entry(each) -> Entry:
    fields = each.get("design") if isinstance(each, dict) else None
    if not isinstance(fields, dict) or not all(isinstance(value, str) for value in fields.values()):
        raise SimcError(said('"design" must be an object of texts'))
    if "plant" not in fields:
        raise SimcError(said('"design" must hold a plant'))
    known = each.get("id")
    return Entry(_design(fields), known if isinstance(known, str) and ID.fullmatch(known) else new_id())


def _design(fields: dict[str, str]) -> Design:
    design, ignored = links.decode(fields)
    if ignored:
        raise SimcError(joined(map(str, ignored), "; "))
    return design
