"""What all sessions of one process share: made once, whoever asks for it meanwhile waits. Pure: no streamlit.

Thirty who open one link within a second ask thirty times for the same tables and studies.
"""

from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from functools import wraps
from threading import Lock
from typing import Generic, ParamSpec, TypeVar

Thing = TypeVar("Thing")
Given = ParamSpec("Given")


@dataclass(slots=True)
class _Making:
    """The lock of one thing that is being made, and how many hold it or wait for it."""

    lock: Lock = field(default_factory=Lock)
    threads: int = 0


class Shared(Generic[Thing]):
    """Things by the name of what they depend on, which nobody changes.

    Parameters
    ----------
    most : int
        At most so much is kept, but always the newest thing; what was asked for longest ago goes first.
    size : callable
        How much of it a thing is; each counts as one unless given.
    """

    def __init__(self, most: int, size: Callable[[Thing], int] = lambda thing: 1):
        self.most = most
        self._size = size
        self._lock = Lock()
        self._kept: OrderedDict[Hashable, Thing] = OrderedDict()
        self._sum = 0
        self._making: dict[Hashable, _Making] = {}

    def get(self, name: Hashable, make: Callable[[], Thing]) -> Thing:
        """The thing of this name.

        Parameters
        ----------
        name : hashable
            Says all that the thing depends on: same name, same thing.
        make : callable
            Makes it where it is not kept. If it raises, nothing is kept, and the next who waits makes it.
        """
        with self._lock:
            if name in self._kept:
                return self._used(name)
            making = self._making.setdefault(name, _Making())
            making.threads += 1
        try:
            with making.lock:
                return self._made(name, make)
        finally:
            with self._lock:
                making.threads -= 1
                if not making.threads:
                    del self._making[name]

    def _made(self, name: Hashable, make: Callable[[], Thing]) -> Thing:
        with self._lock:
            if name in self._kept:  # made while this thread waited
                return self._used(name)
        thing = make()
        with self._lock:
            self._kept[name] = thing
            self._sum += self._size(thing)
            while self._sum > self.most and len(self._kept) > 1:
                _, gone = self._kept.popitem(last=False)
                self._sum -= self._size(gone)
        return thing

    def _used(self, name: Hashable) -> Thing:
        self._kept.move_to_end(name)
        return self._kept[name]


def shared(most: int) -> Callable[[Callable[Given, Thing]], Callable[Given, Thing]]:
    """Decorator of a pure function: its results are shared by all who give the same arguments.

    Parameters
    ----------
    most : int
        So many results are kept.
    """

    def of(function: Callable[Given, Thing]) -> Callable[Given, Thing]:
        kept: Shared[Thing] = Shared(most)

        @wraps(function)
        def found(*given: Given.args, **named: Given.kwargs) -> Thing:
            return kept.get((given, *sorted(named.items())), lambda: function(*given, **named))

        return found

    return of
