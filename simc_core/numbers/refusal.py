"""Why a text is not one number, and what to write instead."""

import re
import unicodedata

from simc_core.wording import said

LONGEST_QUOTE = 40
NUMBER = r"[+-]?[\d.,' ]*[\d.,](?:[eE][+-]?\d+)?"
WITH_UNIT = re.compile(rf"(?P<number>{NUMBER}) *(?P<unit>[^\W\d_]+(?:/[^\W\d_]+)?|°\w?|[$€£])\.?")
VULGAR = re.compile(r"(?P<whole>[+-]?\d*) *(?P<part>[½⅓⅔¼¾⅕⅛])")
PREFIX = {"k": "e3", "K": "e3", "M": "e6", "G": "e9", "µ": "e-6", "μ": "e-6", "n": "e-9"}
LOST_POWER = re.compile(r"(?P<number>[+-]?[\d.,]+) *[*x] *10 *(?P<power>[+-]?\d+)")


def no_number(name: str, found: str) -> str:
    """The message for the field `name` in which `found` was typed."""
    shown = quoted(found)
    return said(
        "{name} must be one number, found '{shown}': {way_out}", name=name, shown=shown, way_out=_way_out(found.strip())
    )


def quoted(text: str) -> str:
    """`text` on one line, not longer than a message can bear."""
    line = " ".join(text.split())
    return line if len(line) <= LONGEST_QUOTE else line[: LONGEST_QUOTE - 3] + "..."


def _way_out(found: str) -> str:
    if re.fullmatch(r"[+-]?(?:inf|infinity|nan|∞)", found.lower()):
        return said("it must be finite")
    if "=" in found:
        return said("write the number alone, without a name and without =")
    if any(sign.isdigit() and not sign.isascii() and sign.isdecimal() for sign in found):
        return said("write the digits 0 to 9")
    if vulgar := VULGAR.fullmatch(found):
        whole = vulgar["whole"]
        size = float(whole.strip("+-") or 0) + round(unicodedata.numeric(vulgar["part"]), 4)
        return said("write {sign}{size:g}", sign="-" * whole.startswith("-"), size=size)
    if re.search(r"π|\bpi\b", found):
        return said("write digits, 3.1416 for π")
    if re.fullmatch(r"[-+\d.,]+ *[dD] *[+-]?\d+|[-+\d.,]+ *[eE] *[+-]? *\d+", found):
        return said("write a power of ten without blanks, as in 1e-3")
    if re.fullmatch(r"\d+:\d+(?::\d+)?", found):
        return said("write one number in the time unit of this loop, 2.5 for two minutes and a half")
    if "%" in found:
        return said("leave out the percent sign and write the number in the unit of this field")
    if lost := LOST_POWER.fullmatch(found):
        return said(
            "if 10{power} is a power of ten, write {number}e{power}", power=lost["power"], number=lost["number"]
        )
    if (unit := WITH_UNIT.fullmatch(found)) and unit["unit"] in PREFIX:
        number = unit["number"].strip()
        return said(
            "write {number}{prefix} if '{unit}' is a power of ten, {number} if it is a unit",
            number=number,
            prefix=PREFIX[unit["unit"]],
            unit=unit["unit"],
        )
    if unit := WITH_UNIT.fullmatch(found):
        return said(
            "leave out '{unit}' and write {number} if that is the unit used here",
            unit=unit["unit"],
            number=unit["number"].strip(),
        )
    if word := re.search(r"[^\W\d_]{2,}", found):
        return said("'{word}' is not known here; write digits, for instance 1.4142 for sqrt(2)", word=word[0])
    if re.search(r"[\d.,]\s+[\d.,]", found):
        return said("a blank can only separate groups of three digits; write it without blanks")
    if re.fullmatch(r"[-+\d.,]+", found) and len(re.findall(r"[.,]", found)) > 1:
        return said("write one decimal point or comma and no other")
    if re.search(r"\d\s*[-+*^]+\s*[\d(]", found):
        return said("work it out first; only a fraction like 11/5 is understood")
    return said("write for instance 0.5 or 0,5, 1e-3 or 11/5")
