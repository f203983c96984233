"""Nothing leaves the machine: what the server's process connects to or looks up, seen by Python's audit hooks."""

import asyncio
import os
import subprocess
import sys
from pathlib import Path

import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import InvalidStatus

from tests.browser.tools import ROOT, Server

HOOK = str(Path(__file__).parent / "outgoing")


def watched(log: Path) -> dict[str, str]:
    return {"PYTHONPATH": HOOK, "OUTGOING_LOG": str(log)}


def open_session(url: str, origin: str | None) -> None:
    """Open a session as a page of `origin` would, and close it."""

    async def once() -> None:
        address = url.replace("http", "ws") + "/_stcore/stream"
        async with connect(address, subprotocols=["streamlit"], origin=origin, proxy=None):
            pass

    asyncio.run(asyncio.wait_for(once(), 20))


@pytest.fixture
def log(tmp_path) -> Path:
    return tmp_path / "outgoing.log"


@pytest.mark.parametrize("address", ["('192.0.2.1', 9)", "('127.0.0.1', 9)"])
def test_the_hook_sees_a_connection(log, address):
    code = f"import socket; socket.socket(socket.AF_INET, socket.SOCK_DGRAM).connect({address})"
    subprocess.run([sys.executable, "-c", code], env=os.environ | watched(log), cwd=ROOT, check=False, timeout=30)
    assert log.read_text().splitlines() == ["watching", f"socket.connect {address}"]


def test_a_page_of_another_origin_is_refused_and_nobody_is_asked(log):
    server = Server(environment=watched(log))
    try:
        for origin in ("https://example.org", "http://127.0.0.1:1", "null", "http://[", "http://127.0.0.1@example.org"):
            with pytest.raises(InvalidStatus) as refused:
                open_session(server.url, origin)
            assert refused.value.response.status_code == 403
        open_session(server.url, server.url)
        open_session(server.url, None)  # not a browser
    finally:
        server.stop()
    assert set(log.read_text().splitlines()) == {"watching"}


def test_an_allowed_origin_is_let_in_and_nobody_is_asked(log):
    options = ("--server.corsAllowedOrigins=https://course.example.org",)
    server = Server(options=options, environment=watched(log))
    try:
        open_session(server.url, "https://course.example.org")
        with pytest.raises(InvalidStatus):
            open_session(server.url, "https://course.example.org.example.net")
    finally:
        server.stop()
    assert set(log.read_text().splitlines()) == {"watching"}


def test_the_server_listens_on_this_machine_only():
    server = Server()
    try:
        listening = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
        found = [fields[1] for fields in listening if fields[3] == "0A" and fields[1].endswith(f":{server.port:04X}")]
    finally:
        server.stop()
    assert found == [f"0100007F:{server.port:04X}"]  # 127.0.0.1, bytes as Linux prints them
