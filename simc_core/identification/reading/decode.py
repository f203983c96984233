"""Bytes to text: marks, UTF-16 without one, and the code pages of Windows."""

import codecs

from simc_core.errors import DataError
from simc_core.wording import said

MOST_BYTES = 20_000_000  # of a file: a week at one second with three signals has about as much
MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig", "UTF-8"),
    (codecs.BOM_UTF16_LE, "utf-16", "UTF-16"),
    (codecs.BOM_UTF16_BE, "utf-16", "UTF-16"),
)
PROBE = 4000  # bytes that tell UTF-16 by its zero bytes
A_PICTURE = said("the file is a picture, not a table: export the numbers as CSV or as a spreadsheet")
FOREIGN = {
    b"%PDF": said("the file is a PDF, not a table: export the numbers as CSV or as a spreadsheet"),
    b"\x89PNG": A_PICTURE,
    b"\xff\xd8\xff": A_PICTURE,
    b"GIF8": A_PICTURE,
}


def decoded(data: bytes, encoding: str | None = None) -> tuple[str, str]:
    """The text of a file and what was understood of its encoding.

    Parameters
    ----------
    data : bytes
        At most `MOST_BYTES`.
    encoding : str, optional
        Of the file, where it is known; else it is found.

    Raises
    ------
    DataError
        Too large, not text, or not in the encoding that was given.
    """
    if len(data) > MOST_BYTES:
        raise DataError(
            said(
                "a file may have at most {most} MB, found {size:.1f} MB: cut out the test, or export every second "
                "sample",
                most=MOST_BYTES // 1_000_000,
                size=len(data) / 1e6,
            )
        )
    for mark, why in FOREIGN.items():
        if data.startswith(mark):
            raise DataError(why)
    if encoding is not None:
        try:
            return data.decode(encoding), said("Text in {encoding}, as told.", encoding=encoding)
        except (LookupError, UnicodeDecodeError):
            raise DataError(
                said("encoding must be the one of the file, it cannot be read as {encoding}", encoding=encoding[:20])
            ) from None
    for mark, name, title in MARKS:
        if data.startswith(mark):
            return data.decode(name, errors="replace"), said("Text in {encoding}.", encoding=title)
    wide = _wide(data[:PROBE])
    if wide:
        return data.decode(wide, errors="replace"), said("Text in {encoding}.", encoding="UTF-16")
    if b"\x00" in data[:PROBE]:
        raise DataError(said("the file is not text: it holds zero bytes. Export it as CSV or as a spreadsheet (xlsx)"))
    try:
        return data.decode("utf-8"), said("Text in {encoding}.", encoding="UTF-8")
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace"), said("Text in Windows-1252, since it is not UTF-8.")


def _wide(head: bytes) -> str:
    """UTF-16 without its mark: every second byte of Latin text is zero."""
    pairs = max(len(head) // 2, 1)
    for name, odd in (("utf-16-le", 1), ("utf-16-be", 0)):
        if head[odd::2].count(0) > 0.4 * pairs and head[1 - odd :: 2].count(0) < 0.1 * pairs:
            return name
    return ""
