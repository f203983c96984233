"""Records with measures that are computed when they are first asked for: who does not ask does not pay for them.

Such a measure is a property, no field: equality, repr and `dataclasses.fields` know nothing of it. Copies and pickles
keep it; a record that was made by hand, or by `dataclasses.replace`, does not know where it comes from and has none.
"""

from collections.abc import Callable, Sequence
from dataclasses import fields
from functools import cached_property
from typing import Any, Generic, TypeVar, cast

More = TypeVar("More")


class Later(Generic[More]):
    """What `make(*of)` returns, one for each of some records, made once."""

    def __init__(self, make: Callable[..., Sequence[More]], *of: object):
        self._make, self._of = make, of

    @cached_property
    def values(self) -> Sequence[More]:
        """Of each record."""
        return self._make(*self._of)

    def attach(self, records: Sequence["OnDemand[More]"]) -> None:
        """The records ask here from now on."""
        for i, record in enumerate(records):
            object.__setattr__(record, "_later", (self, i))


class OnDemand(Generic[More]):
    """Base of frozen dataclasses with slots that have such measures."""

    __slots__ = ("_later",)

    def _asked(self, unknown: More) -> More:
        """What is measured later; `unknown` where nobody knows what the record was measured on."""
        later, i = getattr(self, "_later", (None, 0))
        return unknown if later is None else cast("More", later.values[i])

    def __reduce__(self) -> tuple[Any, ...]:
        values = [getattr(self, field.name) for field in fields(cast("Any", self))]
        return _again, (type(self), values, getattr(self, "_later", (None, 0)))


def _again(kind: type, values: list[Any], later: tuple[Later | None, int]) -> OnDemand:
    record = kind(*values)
    object.__setattr__(record, "_later", later)
    return cast("OnDemand", record)
