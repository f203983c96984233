"""Errors of the core. Every message names the field, its bound and the value received."""

import math

from simc_core.wording import said


class SimcError(ValueError):
    """Base of all errors that a user's input can cause."""


class InvalidParameter(SimcError):
    """A number outside its bounds, or fields that do not fit together."""


class WrongType(InvalidParameter, TypeError):
    """Something of another type than the one asked for."""


class ParseError(SimcError):
    """Text that is not a transfer function; `position` is the index of the fault in `text`."""

    def __init__(self, message: str, text: str = "", position: int = 0):
        super().__init__(message)
        self.text = text
        self.position = position


class NotReducible(SimcError):
    """The half rule does not cover this plant; the message says what can be done instead."""


class FormError(SimcError):
    """A controller that has no equivalent in the form asked for."""


class NotStable(SimcError):
    """A quantity was asked for that only a stable loop has."""


class OutOfDomain(SimcError):
    """A tuning rule was asked for a model, or a setting of its own, that it is not made for."""


class NoOptimum(SimcError):
    """No controller is best under the bound: none meets it, or ever better ones do."""


class NotIdentifiable(SimcError):
    """A trend from which no numbers may be given; the message says why, and what to record instead."""


class RuleEnds(InvalidParameter):
    """SIMC has no setting for this model; `change` is a change of the design that has one, {} if none is known."""

    def __init__(self, message: str, change: dict | None = None):
        super().__init__(message)
        self.change = change or {}


class BoxError(SimcError):
    """A number that a box does not take; `field` is its name there, `nearest` the nearest that it does, if any."""

    def __init__(self, message: str, field: str = "", value: float = math.nan, nearest: float = math.nan):
        super().__init__(message)
        self.field = field
        self.value = value
        self.nearest = nearest


class DataError(SimcError):
    """A file or a paste that is no trend; `line` and `column` count from 1, None where there is no such place."""

    def __init__(self, message: str, line: int | None = None, column: int | None = None):
        if line is not None and column is not None:
            message = said("line {line} column {column}: {message}", line=line, column=column, message=message)
        elif line is not None:
            message = said("line {line}: {message}", line=line, message=message)
        elif column is not None:
            message = said("column {column}: {message}", column=column, message=message)
        super().__init__(message)
        self.line = line
        self.column = column
