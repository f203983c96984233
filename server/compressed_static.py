"""The files of the browser's side, compressed once and kept, not once a request.

Streamlit serves its own static files as they are: compressing megabytes for each visitor costs more than it saves.
Their names hold a hash of what they hold, so the answer to a name never changes ("immutable") and can be kept.
Brotli saves another sixth; browsers take it over https and on their own machine only, so gzip stays.
"""

import asyncio
import gzip
from collections import OrderedDict
from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial

import brotli
from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

WORTH_IT = (".css", ".js", ".svg", ".wasm")  # fonts and pictures are compressed already
MOST_BYTES = 16_000_000  # kept in one process; all the files that our pages load are about 3 MB
CODINGS = {  # the best first
    "br": partial(brotli.compress, quality=9),  # 11 saves a tenth more and takes 10 s for plotly.js, 9 half a second
    "gzip": partial(gzip.compress, compresslevel=9, mtime=0),
}
NOT_MODIFIED = (b"cache-control", b"etag", b"vary")  # what a 304 repeats [RFC 9110, 15.4.5]
CONDITIONS = (b"accept-encoding", b"if-none-match", b"if-modified-since")
REPLACED = ("content-length", "content-encoding", "etag", "vary", "accept-ranges")


@dataclass(frozen=True, slots=True)
class Answer:
    """A whole answer, body compressed."""

    headers: tuple[tuple[bytes, bytes], ...]
    etag: bytes
    body: bytes


class CompressedStatic:
    """ASGI middleware: answers GET of immutable text files from memory in a coding the browser takes.

    Parameters
    ----------
    app : ASGIApp
        What serves the files.
    most_bytes : int
        At most so many bytes are kept; what was asked for longest ago goes first.
    """

    def __init__(self, app: ASGIApp, most_bytes: int = MOST_BYTES):
        self.app = app
        self.most_bytes = most_bytes
        self._kept: OrderedDict[tuple[str, str], Answer] = OrderedDict()
        self._being_made: dict[tuple[str, str], asyncio.Task[Answer | None]] = {}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer from memory, or let the app answer."""
        if not _asks_for_text(scope):
            await self.app(scope, receive, send)
            return
        coding = _coding(scope)
        answer = await self._answer(scope, coding) if coding else None
        if answer is None:
            await self.app(scope, receive, _varying(send))
        elif answer.etag in Headers(scope=scope).get("if-none-match", "").encode():
            await _send(send, 304, [(name, value) for name, value in answer.headers if name in NOT_MODIFIED], b"")
        else:
            await _send(send, 200, list(answer.headers), answer.body)

    async def _answer(self, scope: Scope, coding: str) -> Answer | None:
        """The compressed file; None if the app had no immutable file of this name."""
        key = (scope["path"], coding)
        if key in self._kept:
            self._kept.move_to_end(key)
            return self._kept[key]
        if key not in self._being_made:  # thirty who come together wait for one
            task = self._being_made[key] = asyncio.ensure_future(self._make(scope, coding))
            task.add_done_callback(lambda _: self._being_made.pop(key))
        return await asyncio.shield(self._being_made[key])

    async def _make(self, scope: Scope, coding: str) -> Answer | None:
        status, headers, body = await _whole_answer(self.app, scope)
        if status != 200 or "immutable" not in headers.get("cache-control", ""):
            return None
        answer = await asyncio.to_thread(_compressed, headers, body, coding)
        self._kept[scope["path"], coding] = answer
        while sum(len(kept.body) for kept in self._kept.values()) > self.most_bytes:
            self._kept.popitem(last=False)
        return answer


def _asks_for_text(scope: Scope) -> bool:
    if scope["type"] != "http" or scope["method"] not in ("GET", "HEAD"):
        return False
    return "/static/" in scope["path"] and scope["path"].endswith(WORTH_IT)


def _coding(scope: Scope) -> str | None:
    headers = Headers(scope=scope)
    if scope["method"] != "GET" or "range" in headers:
        return None
    return best_coding(headers.get("accept-encoding", ""))


def _varying(send: Send) -> Send:
    """Tell caches on the way that the file has another form too."""

    async def told(message: Message) -> None:
        if message["type"] == "http.response.start":
            MutableHeaders(scope=message).add_vary_header("Accept-Encoding")
        await send(message)

    return told


def best_coding(accepted: str, codings: Iterable[str] = CODINGS) -> str | None:
    """The first of our codings that an Accept-Encoding names, and not to refuse it (q=0).

    Parameters
    ----------
    accepted : str
        The header's value.
    codings : iterable of str
        The best first.

    Returns
    -------
    str or None
        None where none is named: then the file goes as it is.

    References
    ----------
    .. [1] RFC 9110, section 12.5.3.
    """
    wishes = [wish.partition(";") for wish in accepted.lower().split(",")]
    taken = {name.strip() for name, _, weight in wishes if weight.strip().removeprefix("q=").strip("0.") or not weight}
    return next((coding for coding in codings if coding in taken), None)


async def _whole_answer(app: ASGIApp, scope: Scope) -> tuple[int, Headers, bytes]:
    """What the app answers if nobody has the file yet and nothing is compressed."""
    status, headers, parts = 500, [], []

    async def take(message: Message) -> None:
        nonlocal status, headers
        if message["type"] == "http.response.start":
            status, headers = message["status"], message["headers"]
        elif message["type"] == "http.response.body":
            parts.append(message.get("body", b""))

    async def nothing() -> Message:  # nobody leaves and nobody says more: the file is wanted in any case
        return await asyncio.get_running_loop().create_future()

    plain = [(name, value) for name, value in scope["headers"] if name not in CONDITIONS]
    await app({**scope, "headers": plain, "extensions": {}}, nothing, take)
    return status, Headers(raw=headers), b"".join(parts)


def _compressed(headers: Headers, body: bytes, coding: str) -> Answer:
    small = CODINGS[coding](body)
    etag = f'"{headers.get("etag", "").removeprefix("W/").strip(chr(34))}-{coding}"'.encode()
    own = [(b"content-encoding", coding.encode()), (b"content-length", str(len(small)).encode()), (b"etag", etag)]
    own.append((b"vary", b"Accept-Encoding"))
    kept = [(name, value) for name, value in headers.raw if name.decode() not in REPLACED]
    return Answer((*kept, *own), etag, small)


async def _send(send: Send, status: int, headers: list[tuple[bytes, bytes]], body: bytes) -> None:
    await send({"type": "http.response.start", "status": status, "headers": headers})
    await send({"type": "http.response.body", "body": body})
