"""A Design as a project file: JSON with a version, checked on the way in. Pure: no streamlit."""

import json

from pages.common.session import links
from pages.common.session.design import Design

FORMAT = "simc-project"
VERSION = 1
LARGEST = 200_000  # bytes


def dump(design: Design) -> str:
    """The file's text. Its `design` holds the same names and texts as a link does."""
    return json.dumps({"format": FORMAT, "version": VERSION, "design": links.encode(design)}, indent=2) + "\n"


def load(data: bytes) -> tuple[Design | None, str]:
    """The design of a file, or None and the reason in words. All of it must be right, or none is taken."""
    if len(data) > LARGEST:
        return None, f"a project file has at most {LARGEST} bytes, got {len(data)}"
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
    if isinstance(version, bool) or version != VERSION:
        return None, f"version must be {VERSION}, got {str(version)[:40]}"
    fields = content.get("design")
    if not isinstance(fields, dict) or not all(isinstance(value, str) for value in fields.values()):
        return None, '"design" must be an object of texts'
    if "plant" not in fields:
        return None, '"design" must hold a plant'
    design, ignored = links.decode(fields)
    return (None, "; ".join(map(str, ignored))) if ignored else (design, "")
