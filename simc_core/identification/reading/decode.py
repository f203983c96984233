"""Bytes to text: marks, UTF-16 without one, and the code pages of Windows."""

import codecs

from simc_core.errors import DataError

MOST_BYTES = 20_000_000  # of a file: a week at one second with three signals has about as much
MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig", "UTF-8"),
    (codecs.BOM_UTF16_LE, "utf-16", "UTF-16"),
    (codecs.BOM_UTF16_BE, "utf-16", "UTF-16"),
)
PROBE = 4000  # bytes that tell UTF-16 by its zero bytes
FOREIGN = {b"%PDF": "a PDF", b"\x89PNG": "a picture", b"\xff\xd8\xff": "a picture", b"GIF8": "a picture"}


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
            f"a file may have at most {MOST_BYTES // 1_000_000} MB, found {len(data) / 1e6:.1f} MB: "
            "cut out the test, or export every second sample"
        )
    for mark, what in FOREIGN.items():
        if data.startswith(mark):
            raise DataError(f"the file is {what}, not a table: export the numbers as CSV or as a spreadsheet")
    if encoding is not None:
        try:
            return data.decode(encoding), f"Text in {encoding}, as told."
        except (LookupError, UnicodeDecodeError):
            raise DataError(f"encoding must be the one of the file, it cannot be read as {encoding[:20]}") from None
    for mark, name, title in MARKS:
        if data.startswith(mark):
            return data.decode(name, errors="replace"), f"Text in {title}."
    wide = _wide(data[:PROBE])
    if wide:
        return data.decode(wide, errors="replace"), "Text in UTF-16."
    if b"\x00" in data[:PROBE]:
        raise DataError("the file is not text: it holds zero bytes. Export it as CSV or as a spreadsheet (xlsx)")
    try:
        return data.decode("utf-8"), "Text in UTF-8."
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace"), "Text in Windows-1252, since it is not UTF-8."


def _wide(head: bytes) -> str:
    """UTF-16 without its mark: every second byte of Latin text is zero."""
    pairs = max(len(head) // 2, 1)
    for name, odd in (("utf-16-le", 1), ("utf-16-be", 0)):
        if head[odd::2].count(0) > 0.4 * pairs and head[1 - odd :: 2].count(0) < 0.1 * pairs:
            return name
    return ""
