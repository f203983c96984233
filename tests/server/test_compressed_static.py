"""Compressed once, kept within a bound, and the same file in the end: against the files on disk and RFC 9110."""

import asyncio
import gzip
import http.client
from pathlib import Path

import brotli
import pytest
import streamlit

from server.compressed_static import CompressedStatic, best_coding
from tests.browser.tools import Server
from tests.server.client import Client

STATIC = Path(streamlit.__file__).parent / "static" / "static"
GZIP = {"Accept-Encoding": "gzip, deflate"}  # over plain http
BOTH = {"Accept-Encoding": "gzip, deflate, br, zstd"}


@pytest.fixture(scope="module")
def get():
    """get(path, headers): status, headers and body from the server as it ships."""
    server = Server()

    def ask(path: str, headers: dict[str, str], method: str = "GET") -> tuple[int, http.client.HTTPMessage, bytes]:
        connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=30)
        connection.request(method, path, headers=headers)
        answer = connection.getresponse()
        body = answer.read()
        connection.close()
        return answer.status, answer.headers, body

    yield ask
    server.stop()


@pytest.mark.parametrize(("wish", "coding", "read"), [(GZIP, "gzip", gzip.decompress), (BOTH, "br", brotli.decompress)])
@pytest.mark.parametrize("name", ["js/PlotlyChart.*.js", "js/react-dom.*.js", "css/index.*.css"])
def test_the_browser_gets_the_file_compressed_and_may_keep_it(get, name, wish, coding, read):
    [path] = STATIC.glob(name)
    address = f"/static/{path.relative_to(STATIC)}"
    status, headers, body = get(address, wish)
    assert status == 200
    assert read(body) == path.read_bytes()
    assert len(body) < 0.5 * path.stat().st_size
    assert (headers["Content-Encoding"], headers["Content-Length"]) == (coding, str(len(body)))
    assert "immutable" in headers["Cache-Control"]
    assert headers["Vary"] == "Accept-Encoding"
    assert headers.get_content_type() in ("text/javascript", "application/javascript", "text/css")
    assert headers["X-Content-Type-Options"] == "nosniff"
    status, again, body = get(address, wish | {"If-None-Match": headers["ETag"]})
    assert (status, again["ETag"], body) == (304, headers["ETag"], b"")


def test_whoever_takes_no_gzip_gets_the_file_as_it_is(get):
    [path] = STATIC.glob("js/react-dom.*.js")
    for wish in ({}, {"Accept-Encoding": "identity"}, {"Accept-Encoding": "gzip;q=0, zstd"}):
        status, headers, body = get(f"/static/js/{path.name}", wish)
        assert (status, body, headers["Content-Encoding"]) == (200, path.read_bytes(), None)
        assert headers["Vary"] == "Accept-Encoding"
    plain = headers["ETag"]
    assert get(f"/static/js/{path.name}", GZIP)[1]["ETag"] != plain
    status, headers, body = get(f"/static/js/{path.name}", GZIP | {"Range": "bytes=0-9"})
    assert (status, headers["Content-Encoding"], body) == (206, None, path.read_bytes()[:10])


def test_what_is_no_file_stays_the_answer_of_streamlit(get):
    status, headers, body = get("/static/js/nothing.js", GZIP)
    assert (status, headers["Cache-Control"], headers["Content-Encoding"]) == (200, "no-cache", None)
    assert b"<title>Streamlit</title>" in body


def test_below_a_path_of_another_site_all_is_the_same():
    server = Server(below="/simc")
    try:
        connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=30)
        [path] = STATIC.glob("js/react-dom.*.js")
        connection.request("GET", f"/simc/static/js/{path.name}", headers=GZIP)
        answer = connection.getresponse()
        assert gzip.decompress(answer.read()) == path.read_bytes()
        connection.close()
        asyncio.run(asyncio.wait_for(session(server.url), 60))
    finally:
        server.stop()


async def session(url: str) -> None:
    client = Client(url, {"Origin": url.removesuffix("/simc")})
    await client.open()
    await client.run("tuning")
    await client.close()


class Files:
    """An app that serves /static/N.js, N kB of text that does not shrink well, and counts how often it was asked."""

    def __init__(self):
        self.asked = 0

    async def __call__(self, scope, receive, send) -> None:
        self.asked += 1
        await asyncio.sleep(0.01)
        size = int(scope["path"].split("/")[-1].removesuffix(".js"))
        body = b"".join(f"{i * 2654435761 % 2**32:08x}".encode() for i in range(125 * size))
        headers = [(b"etag", b'"a"'), (b"cache-control", b"public, immutable"), (b"content-type", b"text/javascript")]
        await send({"type": "http.response.start", "status": 200, "headers": headers})
        await send({"type": "http.response.body", "body": body})


async def ask(app, size: int) -> bytes:
    parts = []

    async def take(message) -> None:
        parts.append(message.get("body", b""))

    headers = [(b"accept-encoding", b"gzip")]
    await app({"type": "http", "method": "GET", "path": f"/static/{size}.js", "headers": headers}, None, take)
    return b"".join(parts)


def test_thirty_who_come_together_wait_for_one():
    files = Files()
    app = CompressedStatic(files)

    async def together() -> list[bytes]:
        return await asyncio.gather(*(ask(app, 20) for _ in range(30)))

    assert len(set(asyncio.run(together()))) == 1
    assert files.asked == 1


def test_what_was_asked_for_longest_ago_goes_first():
    files = Files()

    async def one_after_the_other() -> list[int]:
        bound = 2.5 * len(await ask(CompressedStatic(Files()), 20))
        app, counts = CompressedStatic(files, most_bytes=int(bound)), []
        for size in (20, 21, 20, 19, 20, 21):  # two fit: 21 goes when 19 comes, 20 was asked for in between
            await ask(app, size)
            counts.append(files.asked)
        return counts

    assert asyncio.run(one_after_the_other()) == [1, 2, 2, 3, 3, 4]


@pytest.mark.parametrize(
    ("accepted", "right"),
    [
        ("gzip", "gzip"),
        ("gzip, deflate, br, zstd", "br"),
        ("zstd, GZIP", "gzip"),
        ("gzip;q=0.5", "gzip"),
        ("gzip; q=1.0, br;q=0", "gzip"),
        ("gzip;q=0", None),
        ("gzip;q=0.000, br;q=0", None),
        ("x-gzip, zstd", None),
        ("", None),
    ],
)
def test_accept_encoding(accepted, right):  # RFC 9110, 12.5.3
    assert best_coding(accepted) == right
