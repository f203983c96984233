"""A link as a code that a phone reads."""

from io import BytesIO

import segno

LONGEST = 1000  # characters; more make a code that a telephone does not read


def qr_svg(link: str) -> str:
    """An SVG picture without a size of its own; empty where the link is too long."""
    if len(link) > LONGEST:
        return ""
    out = BytesIO()
    segno.make(link, micro=False, error="l").save(out, kind="svg", xmldecl=False, svgns=True, omitsize=True, border=2)
    return out.getvalue().decode()
