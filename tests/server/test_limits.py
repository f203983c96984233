"""What one visitor may send."""

import asyncio

import pytest
from websockets.exceptions import ConnectionClosed

from tests.browser.tools import Server
from tests.server.client import Client

TOO_BIG, PROTOCOL_ERROR = 1009, 1002  # RFC 6455, 7.4.1


@pytest.fixture(scope="module")
def url():
    server = Server()
    yield server.url
    server.stop()


@pytest.mark.parametrize(("size", "code"), [(999_000, PROTOCOL_ERROR), (1_001_000, TOO_BIG), (6_000_000, TOO_BIG)])
def test_a_message_of_more_than_a_megabyte_ends_the_session(url, size, code):
    async def send() -> int:
        client = Client(url)
        await client.open()
        try:
            await client.socket.send(b"\xff" * size)  # no message of Streamlit: where it is read, it is refused as such
            while True:
                await client.socket.recv()
        except ConnectionClosed as closed:
            return closed.rcvd.code

    assert asyncio.run(asyncio.wait_for(send(), 30)) == code


@pytest.mark.parametrize("place", ["", "plant", "from_data", "half_rule", "tuning", "cascade"])
def test_every_page_runs_whatever_its_link_says(url, place):
    async def visit() -> None:
        client = Client(url)
        await client.open()
        await client.run(place, "form=![x](//host/a.png)&plant=%ED%A0%80&%00=%FF&h=" + "9" * 5000)
        await client.close()

    asyncio.run(asyncio.wait_for(visit(), 60))
