"""Tables that all sessions of one process share: thirty who open one link wait for one table. Pure: no streamlit."""

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, field
from threading import Lock

MOST_BYTES = 64_000_000  # a table has 0.1 to 1 MB


@dataclass(slots=True)
class _Making:
    """The lock of one table that is being made, and how many hold it or wait for it."""

    lock: Lock = field(default_factory=Lock)
    threads: int = 0


class SharedTables:
    """Messages by the name of what they hold; each is made once, whoever asks for it meanwhile waits.

    Parameters
    ----------
    most_bytes : int
        At most so many bytes are kept, but always the newest message; what was asked for longest ago goes first.
    """

    def __init__(self, most_bytes: int):
        self.most_bytes = most_bytes
        self._lock = Lock()
        self._kept: OrderedDict[str, bytes] = OrderedDict()
        self._bytes = 0
        self._making: dict[str, _Making] = {}

    def get(self, name: str, make: Callable[[], bytes]) -> bytes:
        """The message of this name.

        Parameters
        ----------
        name : str
            Says all that the message depends on: same name, same message.
        make : callable
            Makes the message where it is not kept. If it raises, nothing is kept, and the next who waits makes it.

        Returns
        -------
        bytes
            The message.
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

    def _made(self, name: str, make: Callable[[], bytes]) -> bytes:
        with self._lock:
            if name in self._kept:  # made while this thread waited
                return self._used(name)
        message = make()
        with self._lock:
            self._kept[name] = message
            self._bytes += len(message)
            while self._bytes > self.most_bytes and len(self._kept) > 1:
                _, gone = self._kept.popitem(last=False)
                self._bytes -= len(gone)
        return message

    def _used(self, name: str) -> bytes:
        self._kept.move_to_end(name)
        return self._kept[name]


TABLES = SharedTables(MOST_BYTES)
