"""Why a text is not one number, and what to write instead."""

import re
import unicodedata

LONGEST_QUOTE = 40
NUMBER = r"[+-]?[\d.,' ]*[\d.,](?:[eE][+-]?\d+)?"
WITH_UNIT = re.compile(rf"(?P<number>{NUMBER}) *(?P<unit>[^\W\d_]+(?:/[^\W\d_]+)?|°\w?|[$€£])\.?")
VULGAR = re.compile(r"(?P<whole>[+-]?\d*) *(?P<part>[½⅓⅔¼¾⅕⅛])")
PREFIX = {"k": "e3", "K": "e3", "M": "e6", "G": "e9", "µ": "e-6", "μ": "e-6", "n": "e-9"}
LOST_POWER = re.compile(r"(?P<number>[+-]?[\d.,]+) *[*x] *10 *(?P<power>[+-]?\d+)")


def no_number(name: str, found: str) -> str:
    """The message for the field `name` in which `found` was typed."""
    shown = quoted(found)
    return f"{name} must be one number, found '{shown}': {_way_out(found.strip())}"


def quoted(text: str) -> str:
    """`text` on one line, not longer than a message can bear."""
    line = " ".join(text.split())
    return line if len(line) <= LONGEST_QUOTE else line[: LONGEST_QUOTE - 3] + "..."


def _way_out(found: str) -> str:
    if re.fullmatch(r"[+-]?(?:inf|infinity|nan|∞)", found.lower()):
        return "it must be finite"
    if "=" in found:
        return "write the number alone, without a name and without ="
    if any(sign.isdigit() and not sign.isascii() and sign.isdecimal() for sign in found):
        return "write the digits 0 to 9"
    if vulgar := VULGAR.fullmatch(found):
        whole = vulgar["whole"]
        size = float(whole.strip("+-") or 0) + round(unicodedata.numeric(vulgar["part"]), 4)
        return f"write {'-' * whole.startswith('-')}{size:g}"
    if re.search(r"π|\bpi\b", found):
        return "write digits, 3.1416 for π"
    if re.fullmatch(r"[-+\d.,]+ *[dD] *[+-]?\d+|[-+\d.,]+ *[eE] *[+-]? *\d+", found):
        return "write a power of ten without blanks, as in 1e-3"
    if re.fullmatch(r"\d+:\d+(?::\d+)?", found):
        return "write one number in the time unit of this loop, 2.5 for two minutes and a half"
    if "%" in found:
        return "leave out the percent sign and write the number in the unit of this field"
    if lost := LOST_POWER.fullmatch(found):
        return f"if 10{lost['power']} is a power of ten, write {lost['number']}e{lost['power']}"
    if (unit := WITH_UNIT.fullmatch(found)) and unit["unit"] in PREFIX:
        number = unit["number"].strip()
        return f"write {number}{PREFIX[unit['unit']]} if '{unit['unit']}' is a power of ten, {number} if it is a unit"
    if unit := WITH_UNIT.fullmatch(found):
        return f"leave out '{unit['unit']}' and write {unit['number'].strip()} if that is the unit used here"
    if word := re.search(r"[^\W\d_]{2,}", found):
        return f"'{word[0]}' is not known here; write digits, for instance 1.4142 for sqrt(2)"
    if re.search(r"[\d.,]\s+[\d.,]", found):
        return "a blank can only separate groups of three digits; write it without blanks"
    if re.fullmatch(r"[-+\d.,]+", found) and len(re.findall(r"[.,]", found)) > 1:
        return "write one decimal point or comma and no other"
    if re.search(r"\d\s*[-+*^]+\s*[\d(]", found):
        return "work it out first; only a fraction like 11/5 is understood"
    return "write for instance 0.5 or 0,5, 1e-3 or 11/5"
