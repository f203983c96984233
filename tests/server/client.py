"""A browser as the server sees it: a websocket that asks for runs of a page and keeps what it was told to keep."""

import time

from streamlit.proto.BackMsg_pb2 import BackMsg
from streamlit.proto.ForwardMsg_pb2 import ForwardMsg
from websockets.asyncio.client import connect


class Client:
    """One session.

    Parameters
    ----------
    url : str
        Address of the app, such as "http://127.0.0.1:8501".
    headers : dict, optional
        Headers of the request that opens the session.
    """

    def __init__(self, url: str, headers: dict[str, str] | None = None):
        self.address = url.replace("http", "ws") + "/_stcore/stream"
        self.headers = headers
        self.kept: list[str] = []
        self.bytes = 0

    async def open(self) -> None:
        """Connect; no page is asked for yet."""
        self.socket = await connect(
            self.address, subprotocols=["streamlit"], additional_headers=self.headers, max_size=None, proxy=None
        )

    async def close(self) -> None:
        """The tab is closed."""
        await self.socket.close()

    async def run(self, page: str, query: str = "") -> float:
        """Ask for a page; ms until its script has ended. Raises RuntimeError if it failed."""
        asked = BackMsg()
        asked.rerun_script.query_string = query
        asked.rerun_script.page_name = page
        asked.rerun_script.cached_message_hashes.extend(self.kept)
        begin = time.perf_counter()
        await self.socket.send(asked.SerializeToString())
        while True:
            data = await self.socket.recv()
            self.bytes += len(data)
            message = ForwardMsg.FromString(data)
            if message.metadata.cacheable and message.hash not in self.kept:
                self.kept.append(message.hash)
            if message.WhichOneof("type") == "script_finished":
                if message.script_finished != ForwardMsg.FINISHED_SUCCESSFULLY:
                    raise RuntimeError("the page did not run")
                return 1000 * (time.perf_counter() - begin)
            if message.delta.new_element.WhichOneof("type") == "exception":
                raise RuntimeError(f"the page shows {message.delta.new_element.exception.type}")
