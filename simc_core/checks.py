"""The door: bounds of numbers and tuples, checked once, where a value enters the core."""

import math
from collections.abc import Callable, Collection, Iterable
from numbers import Real

import numpy as np
from numpy.typing import ArrayLike

from simc_core.errors import InvalidParameter, SimcError
from simc_core.wording import joined, said

LONGEST_TIME = 1e9  # largest time constant or dead time, and inverse of the smallest
LARGEST_GAIN = 1e12  # largest gain, and inverse of the smallest
MOST_FACTORS = 40  # poles of a plant; beyond that no number below would be worth reading


def real(name: str, value: object, low: float = -math.inf, high: float = math.inf) -> float:
    """`value` as a finite float in [low, high].

    Raises InvalidParameter: the message names the field, the bound and the value.
    """
    if type(value) is float:
        number = value
    elif isinstance(value, Real) and not isinstance(value, bool):
        number = float(value)
    else:
        raise InvalidParameter(said("{name} must be a number, found {value}", name=name, value=_shown(value)))
    if not math.isfinite(number):
        raise InvalidParameter(said("{name} must be finite, found {number}", name=name, number=number))
    if number < low:
        raise InvalidParameter(said("{name} must be >= {low:g}, found {number:g}", name=name, low=low, number=number))
    if number > high:
        raise InvalidParameter(
            said("{name} must be <= {high:g}, found {number:g}", name=name, high=high, number=number)
        )
    return number


def magnitude(name: str, value: object, largest: float) -> float:
    """`value` as a nonzero float, 1/largest <= |value| <= largest."""
    number = real(name, value)
    if number == 0:
        raise InvalidParameter(said("{name} must not be zero, found 0", name=name))
    if not 1 / largest <= abs(number) <= largest:
        raise InvalidParameter(
            said(
                "|{name}| must be between {low:g} and {high:g}, found {number:g}",
                name=name,
                low=1 / largest,
                high=largest,
                number=number,
            )
        )
    return number


def gain(name: str, value: object) -> float:
    """A nonzero gain."""
    return magnitude(name, value, LARGEST_GAIN)


def positive(name: str, value: object) -> float:
    """A gain > 0."""
    number = gain(name, value)
    if number < 0:
        raise InvalidParameter(said("{name} must be > 0, found {number:g}", name=name, number=number))
    return number


def time_constant(name: str, value: object) -> float:
    """A nonzero time constant of either sign."""
    return magnitude(name, value, LONGEST_TIME)


def positive_time(name: str, value: object) -> float:
    """A time constant > 0."""
    number = time_constant(name, value)
    if number < 0:
        raise InvalidParameter(said("{name} must be > 0, found {number:g}", name=name, number=number))
    return number


def optional_time(name: str, value: object) -> float:
    """A time >= 0: zero, or not below the smallest time the core works with."""
    number = real(name, value, low=0.0, high=LONGEST_TIME)
    if 0 < number < 1 / LONGEST_TIME:
        raise InvalidParameter(
            said(
                "{name} must be 0 or >= {low:g}, found {number:g}",
                name=name,
                low=1 / LONGEST_TIME,
                number=number,
            )
        )
    return number


def whole(name: str, value: object, low: int, high: int) -> int:
    """`value` as an int in [low, high]."""
    number = real(name, value, low, high)
    if number != int(number):
        raise InvalidParameter(said("{name} must be a whole number, found {number:g}", name=name, number=number))
    return int(number)


def items(name: str, values: object, most: int = MOST_FACTORS) -> tuple:
    """`values` as a tuple of at most `most` items."""
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise InvalidParameter(
            said("{name} must be a list of numbers, found {values}", name=name, values=_shown(values))
        )
    given = tuple(values)
    if len(given) > most:
        raise InvalidParameter(
            said("{name} may have at most {most} entries, found {given}", name=name, most=most, given=len(given))
        )
    return given


def array(name: str, values: ArrayLike, most: int) -> np.ndarray:
    """`values` as an array of floats, shape (n,), 1 <= n <= most; one number is an array of one."""
    try:
        found = np.atleast_1d(np.asarray(values, dtype=float))
    except (TypeError, ValueError):
        raise InvalidParameter(
            said("{name} must be a list of numbers, found {values}", name=name, values=_shown(values))
        ) from None
    if found.ndim != 1 or not 1 <= found.size <= most:
        raise InvalidParameter(
            said(
                "{name} must be a list of 1 to {most} numbers, found shape {shape}",
                name=name,
                most=most,
                shape=found.shape,
            )
        )
    return found


def one_of(
    name: str, value: object, choices: Collection[str], refusal: Callable[[str], SimcError] = InvalidParameter
) -> str:
    """`value`, which must be one of `choices`; "" among them is not told.

    Raises InvalidParameter, or what `refusal` makes of the message.
    """
    if isinstance(value, str) and value in choices:  # a list, which no dict can look up, is refused like any other
        return value
    told = joined(choice for choice in choices if choice)
    raise refusal(said("{name} must be one of {choices}, found {found}", name=name, choices=told, found=_shown(value)))


def text(name: str, value: object, longest: int) -> str:
    """`value`, which must be a str of at most `longest` characters."""
    if not isinstance(value, str):
        raise InvalidParameter(said("{name} must be text, found {kind}", name=name, kind=type(value).__name__))
    if len(value) > longest:
        raise InvalidParameter(
            said("{name} may have at most {longest} characters, found {n}", name=name, longest=longest, n=len(value))
        )
    return value


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 40 else text[:37] + "..."
