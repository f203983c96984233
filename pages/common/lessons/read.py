"""A lesson from the text of a file: TOML, bounded, every error with the field it is about. Pure: no streamlit."""

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import fields
from typing import Any

from pages.common.lessons.lesson import MOST, Claim, Lesson, Move, Printed
from simc_core.errors import InvalidParameter, SimcError
from simc_core.wording import Text, joined, said

LARGEST = 30_000  # bytes
TABLES = {"play": Move, "moves": Move, "claims": Claim, "printed": Printed}


def read_lesson(data: bytes, own: bool = False) -> Lesson:
    """The lesson of a file. own: of this program. Raises InvalidParameter, which names the field."""
    if len(data) > LARGEST:
        raise InvalidParameter(said("a lesson has at most {most} bytes, found {found}", most=LARGEST, found=len(data)))
    try:
        content = tomllib.loads(data.decode("utf-8-sig").replace("\r\n", "\n"))
    except UnicodeDecodeError:
        raise InvalidParameter(said("a lesson is a text in UTF-8")) from None
    except (ValueError, RecursionError) as error:  # also a number of thousands of digits
        raise InvalidParameter(said("the file is no TOML: {error}", error=str(error)[:200])) from None
    return lesson_of(content, own)


def lesson_of(content: Mapping[str, Any], own: bool = False) -> Lesson:
    """The lesson of what the file says."""
    given = dict(content)
    if "own" in given:
        raise InvalidParameter(said("own is no field of a lesson"))
    given["design"] = _texts("design", given.get("design", {}), MOST["design"])
    given["cases"] = {
        str(name): _texts(f"cases.{name}", case, MOST["design"])
        for name, case in _table("cases", given.get("cases", {})).items()
    }
    for name in ("moves", "claims", "printed"):
        rows = given.get(name, [])
        if not isinstance(rows, list) or len(rows) > MOST[name]:
            raise InvalidParameter(said("{name} must be at most {most} tables, [[{name}]]", name=name, most=MOST[name]))
        kind = TABLES[name]
        given[name] = tuple(_record(f"{name} {i}", kind, row) for i, row in enumerate(rows, 1))
    if "play" in given:
        given["play"] = _record("play", Move, given["play"])
    return _made("", Lesson, given | {"own": own})


def _record(place: str, kind: type, row: Any) -> Any:
    return _made(f"{place}: ", kind, _table(place, row))


def _made(place: str, kind: type, given: Mapping[str, Any]) -> Any:
    """The record with these fields. What may be missing has a default."""
    known = {each.name: each for each in fields(kind)}
    strange = next((name for name in given if name not in known), None)
    if strange is not None:
        raise InvalidParameter(
            said("{name} is no field; there are {known}", name=f"{place}{str(strange)[:30]}", known=", ".join(known))
        )
    try:
        return kind(**{name: _typed(name, known[name].type, value) for name, value in given.items()})
    except TypeError:
        missing = next(name for name, each in known.items() if name not in given and _needed(each))
        raise InvalidParameter(said("{name} is missing", name=f"{place}{missing}")) from None
    except SimcError as error:
        raise InvalidParameter(joined([place, str(error)], "")) from None


def _needed(each) -> bool:
    return each.default is each.default_factory  # both are MISSING


WANTED: dict[Any, tuple[Callable[[Any], bool], Text]] = {
    str: (
        lambda value: isinstance(value, str),
        said("{name} must be a text in quotes, found {found}", name="", found=""),
    ),
    int: (
        lambda value: isinstance(value, int) and not isinstance(value, bool),
        said("{name} must be a whole number, found {found}", name="", found=""),
    ),
    tuple[str, ...]: (
        lambda value: isinstance(value, list) and all(isinstance(each, str) for each in value),
        said("{name} must be a list of texts in quotes, found {found}", name="", found=""),
    ),
}


def _typed(name: str, kind: Any, value: Any) -> Any:
    if kind not in WANTED:
        return value
    right, wanted = WANTED[kind]
    if not right(value):
        raise InvalidParameter(wanted.put(name=name, found=_short(value)))
    return tuple(value) if isinstance(value, list) else value


def _table(place: str, value: Any) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise InvalidParameter(
            said("{place} must be a table of fields, found {found}", place=place, found=_short(value))
        )
    return value


def _short(value: Any) -> str:
    try:
        return str(value)[:30]
    except ValueError:  # a hexadecimal number of thousands of digits
        return said("a number")


def _texts(place: str, value: Any, most: int) -> dict[str, str]:
    table = _table(place, value)
    if len(table) > most:
        raise InvalidParameter(
            said("{place} must have at most {most} fields, found {found}", place=place, most=most, found=len(table))
        )
    for name, text in table.items():
        if not isinstance(text, str):
            raise InvalidParameter(
                said(
                    '{place}: {name} must be a text in quotes, as in a link: "{found}"',
                    place=place,
                    name=str(name)[:30],
                    found=_short(text),
                )
            )
    return table
