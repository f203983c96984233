"""A record of a process: what was measured, what was sent to the actuator, and when."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simc_core import checks
from simc_core.errors import InvalidParameter, WrongType
from simc_core.wording import said

MOST_SAMPLES = 1_000_000  # of a trend; what is written every second for eleven days
LARGEST_INSTANT = 1e14  # holds a date in milliseconds or microseconds since 1970 times a few
SERIES = ("t", "y", "u", "r")


@dataclass(frozen=True, slots=True, eq=False)
class Trend:
    """A record y(t) of the measurement (PV) with the controller output u (OP) that is held between its instants.

    Parameters
    ----------
    t : array, shape (n,)
        Instants of y, in the user's time unit, never decreasing. Two samples may share an instant.
    y : array, shape (n,)
        Measurement (PV).
    u : array, shape (n,), or (m,) if `t_u` is given
        Controller output (OP): u[i] holds from its instant on. Before its first instant u[0] held for ever.
        Where two values share an instant, the later one holds from there.
    r : array, shape (n,), optional
        Set point (SP) at `t`.
    t_u : array, shape (m,), optional
        Instants of u where OP has its own, never decreasing. None: those of y.
    names, units : mapping, optional
        Names and units of the series, by "t", "y", "u", "r", as far as they are known; for labels only.
    notes : sequence of str, optional
        What was done to make this record from its source, one sentence each.

    Raises
    ------
    InvalidParameter
        A series has another length than its instants, fewer than 3 or more than 1e6 samples, a value that is not a
        number, or time goes backwards.

    Examples
    --------
    >>> from simc_core import Trend
    >>> Trend(t=[0, 1, 2, 3], y=[5, 5, 6, 7], u=[0, 1], t_u=[0, 0.5]).span
    3.0
    """

    t: NDArray[np.float64]
    y: NDArray[np.float64]
    u: NDArray[np.float64]
    r: NDArray[np.float64] | None = None
    t_u: NDArray[np.float64] | None = None
    names: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        t = _instants("t", self.t, least=3)
        if t[-1] <= t[0]:
            raise InvalidParameter(said("t must cover some time, found {t:g} throughout", t=float(t[0])))
        checks.real("t[-1] - t[0]", float(t[-1] - t[0]), 1 / checks.LONGEST_TIME, checks.LONGEST_TIME)
        held = None if self.t_u is None else _instants("t_u", self.t_u, least=1)
        own = t if held is None else held
        found = {
            "t": t,
            "y": _series("y", self.y, t.size, "t"),
            "u": _series("u", self.u, own.size, "t" if held is None else "t_u"),
            "r": None if self.r is None else _series("r", self.r, t.size, "t"),
            "t_u": held,
            "names": _labels("names", self.names),
            "units": _labels("units", self.units),
            "notes": tuple(
                note if isinstance(note, str) else str(note) for note in checks.items("notes", self.notes, 1000)
            ),
        }
        for name, value in found.items():
            object.__setattr__(self, name, value)

    @property
    def span(self) -> float:
        """Time from the first sample of y to the last."""
        return float(self.t[-1] - self.t[0])

    @property
    def instants_of_u(self) -> NDArray[np.float64]:
        """The instants from which the values of u hold, shape of u."""
        return self.t if self.t_u is None else self.t_u

    def between(self, begin: float, end: float) -> "Trend":
        """The part with begin <= t <= end; OP keeps the value that held when it begins.

        Raises InvalidParameter where fewer than 3 samples remain.
        """
        begin = checks.real("begin", begin, -LARGEST_INSTANT, LARGEST_INSTANT)
        end = checks.real("end", end, begin, LARGEST_INSTANT)
        first, last = np.searchsorted(self.t, begin, "left"), np.searchsorted(self.t, end, "right")
        if last - first < 3:
            raise InvalidParameter(said("begin and end must leave at least 3 samples, {n} remain", n=int(last - first)))
        cut = slice(int(first), int(last))
        at = self.instants_of_u
        start = max(int(np.searchsorted(at, begin, "right")) - 1, 0)
        stop = max(int(np.searchsorted(at, end, "right")), start + 1)
        t_u = np.maximum(at[start:stop], begin) if at[start] < begin else at[start:stop]
        return self._with(self.t[cut], self.y[cut], self.u[start:stop], None if self.r is None else self.r[cut], t_u)

    def without(self, begin: float, end: float) -> "Trend":
        """The record with the samples of y in begin <= t <= end left out; OP stays whole.

        Raises InvalidParameter where fewer than 3 samples remain.
        """
        begin = checks.real("begin", begin, -LARGEST_INSTANT, LARGEST_INSTANT)
        end = checks.real("end", end, begin, LARGEST_INSTANT)
        kept = (self.t < begin) | (self.t > end)
        if np.count_nonzero(kept) < 3:
            raise InvalidParameter(said("At least 3 samples must remain, found {n}", n=int(np.count_nonzero(kept))))
        r = None if self.r is None else self.r[kept]
        return self._with(self.t[kept], self.y[kept], self.u, r, self.instants_of_u)

    def _with(
        self, t: ArrayLike, y: ArrayLike, u: ArrayLike, r: ArrayLike | None, t_u: NDArray[np.float64] | None
    ) -> "Trend":
        return replace(self, t=t, y=y, u=u, r=r, t_u=t_u)  # type: ignore[arg-type]


def check_trend(trend: object) -> Trend:
    """`trend`, which must be a Trend. Raises WrongType."""
    if not isinstance(trend, Trend):
        raise WrongType(said("trend must be a Trend, found {found}", found=type(trend).__name__))
    return trend


def _instants(name: str, values: ArrayLike, least: int) -> NDArray[np.float64]:
    found = _numbers(name, values)
    if found.size < least:
        raise InvalidParameter(
            said("{name} must have at least {least} instants, found {n}", name=name, least=least, n=found.size)
        )
    back = np.flatnonzero(np.diff(found) < 0)
    if back.size:
        i = int(back[0])
        raise InvalidParameter(
            said(
                "{name} must not go backwards: {name}[{i}] = {value:.12g} follows {before:.12g}. Sort the samples "
                "first.",
                name=name,
                i=i + 1,
                value=float(found[i + 1]),
                before=float(found[i]),
            )
        )
    return found


def _series(name: str, values: ArrayLike, size: int, instants: str) -> NDArray[np.float64]:
    found = _numbers(name, values)
    if found.size != size:
        raise InvalidParameter(
            said(
                "{name} must have the length of {instants}, {size}, found {found}",
                name=name,
                instants=instants,
                size=size,
                found=found.size,
            )
        )
    return found


def _numbers(name: str, values: ArrayLike) -> NDArray[np.float64]:
    found = np.array(checks.array(name, values, MOST_SAMPLES))  # a copy of our own, for it is frozen below
    largest = LARGEST_INSTANT if name in ("t", "t_u") else checks.LARGEST_GAIN
    bad = np.flatnonzero(~(np.abs(found) <= largest))  # nan too
    if bad.size:
        i = int(bad[0])
        raise InvalidParameter(
            said(
                "{name} must hold numbers within +-{largest:g}, found {name}[{i}] = {found:g}",
                name=name,
                largest=largest,
                i=i,
                found=float(found[i]),
            )
        )
    found.setflags(write=False)
    return found


def _labels(name: str, given: Mapping[str, str]) -> dict[str, str]:
    if not isinstance(given, Mapping):
        raise WrongType(
            said(
                "{name} must be a mapping from {series} to text, found {found}",
                name=name,
                series=", ".join(SERIES),
                found=type(given).__name__,
            )
        )
    unknown = [key for key in given if key not in SERIES]
    if unknown:
        raise InvalidParameter(
            said(
                "{name} may have the keys {keys}, found {found!r}",
                name=name,
                keys=", ".join(SERIES),
                found=str(unknown[0])[:40],
            )
        )
    return {key: str(value) for key, value in given.items()}
