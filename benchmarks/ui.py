"""make bench-ui: how fast the live instrument is in headless Chromium, beside Streamlit's own slider in the same run.

    key press to paint     from the time stamp of a real key press to the second frame that shows what it changed
    redraws per second     frames with a different drawing while the handle is dragged
    n sessions             websocket clients of one process, each releasing the slider now and then: from the request to
                           the end of the script, and the resident memory of the process per session

Ratios hold on any machine, milliseconds on this one. Bounded: about two minutes. The last line is JSON.
"""

import asyncio
import json
import math
import random
import re
import shutil
import statistics
import tempfile
import time
from pathlib import Path

from playwright.sync_api import Page, sync_playwright
from streamlit.proto.BackMsg_pb2 import BackMsg
from streamlit.proto.ForwardMsg_pb2 import ForwardMsg
from websockets.asyncio.client import connect

from tests.browser.conftest import ARGS
from tests.browser.tools import Server, idle

PRESSES, DRAG = 40, 2.0  # s
SESSIONS, RELEASES, PAUSE = (1, 30, 100), 3, 10.0  # pause: mean seconds between two releases of one session
PLANT = "exp(-3s)/((6s%2B1)(4s%2B1)(2s%2B1))"
PATIENCE = 60.0  # s
BARE = "import streamlit as st\nst.metric('value', st.slider('tau_c', 0, 1000, 500))\n"
WATCH = """([element, shown]) => {
    const read = () => shown ? document.querySelector(shown).textContent : element.dataset.drawn;
    globalThis.painted = new Promise(done => addEventListener('keydown', event => {
        const before = read();
        const look = () => read() === before ? requestAnimationFrame(look)
            : requestAnimationFrame(() => done(performance.now() - event.timeStamp));
        requestAnimationFrame(look);
    }, {once: true, capture: true}));
}"""
COUNT = """element => {
    globalThis.frames_drawn = [];
    const look = () => {
        if (globalThis.frames_drawn === null) return;
        if (globalThis.frames_drawn.at(-1)?.[1] !== element.dataset.drawn)
            globalThis.frames_drawn.push([performance.now(), element.dataset.drawn]);
        requestAnimationFrame(look);
    };
    look();
}"""


def main() -> None:
    """Run, print a table, then one line of JSON."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=ARGS)
        page = browser.new_page(viewport={"width": 1280, "height": 900})
        result = {"bare slider": bare(page), "live": live(page, f"tuning?plant={PLANT}")}
        result["live cascade"] = live(page, "cascade")
        browser.close()
    result["sessions"] = {str(n): asyncio.run(sessions(n)) for n in SESSIONS}
    show(result)
    print(json.dumps(result))


def live(page: Page, path: str) -> dict[str, float]:
    """Key presses and a drag on the (last) slider of the instrument of a page."""
    server = Server()
    page.goto(f"{server.url}/{path}")
    element = page.wait_for_selector(".live[data-exact=true]")
    idle(page)
    found = presses(page, page.locator(".handle").last, [element, None])
    box = page.locator(".track").last.bounding_box()
    y = box["y"] + 12
    page.mouse.move(box["x"] + 0.3 * box["width"], y)
    page.mouse.down()
    element.evaluate(COUNT)
    begin = time.perf_counter()
    while (part := (time.perf_counter() - begin) / DRAG) < 1:
        page.mouse.move(box["x"] + (0.3 + 0.4 * part) * box["width"], y)
    drawn = page.evaluate("() => { const found = frames_drawn; frames_drawn = null; return found; }")
    page.mouse.up()
    server.stop()
    span = (drawn[-1][0] - drawn[0][0]) / 1000
    return found | {"redraws per second": (len(drawn) - 1) / span}


def bare(page: Page) -> dict[str, float]:
    """The least Streamlit does: one slider, one metric."""
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "bare.py"
        script.write_text(BARE)
        server = Server(script)
        page.goto(server.url)
        shown = "[data-testid=stMetricValue]"
        element = page.wait_for_selector(shown)
        idle(page)
        found = presses(page, page.get_by_role("slider"), [element, shown])
        server.stop()
    return found


def presses(page: Page, handle, watched: list) -> dict[str, float]:
    """Median and 95 % point of key press to paint, ms; presses far enough apart that the server is at rest again."""
    times = []
    for i in range(PRESSES):
        page.evaluate(WATCH, watched)
        handle.press("ArrowRight" if i % 8 < 4 else "ArrowLeft")
        times.append(page.evaluate("() => painted"))
        page.wait_for_timeout(100)
        idle(page, 0.1)
    return {"median ms": statistics.median(times), "p95 ms": p95(times)}


async def sessions(n: int) -> dict[str, float]:
    """n clients of one process; each adds a table of its own, since their first designs differ."""
    server = Server()
    try:
        async with asyncio.timeout(4 * PATIENCE):
            first = Client(server.url)
            await first.open()  # the process has imported everything
            await first.socket.close()
            before, clients = memory(server), [Client(server.url) for _ in range(n)]
            for each in clients:  # one after the other: a class that comes in, not a stampede
                await each.open()
            await asyncio.gather(*(each.release(*((RELEASES, PAUSE) if n > 1 else (10, 0.5))) for each in clients))
            grown = memory(server) - before
            await asyncio.gather(*(each.socket.close() for each in clients))
        times = [each for one in clients for each in one.times]
        return {"median ms": statistics.median(times), "p95 ms": p95(times), "MB per session": grown / n}
    finally:
        server.stop()


class Client:
    """A browser as the server sees it: it asks for reruns and keeps what it was told to keep."""

    def __init__(self, url: str):
        self.address = url.replace("http", "ws") + "/_stcore/stream"
        self.times: list[float] = []
        self.kept: list[str] = []

    async def open(self) -> None:
        """The tuning page for the first time."""
        self.socket = await connect(self.address, subprotocols=["streamlit"], max_size=None)
        await self.rerun("7")

    async def release(self, times: int, pause: float) -> None:
        """Releases of the slider at random moments."""
        for _ in range(times):
            await asyncio.sleep(random.uniform(0.5, 1.5) * pause)
            self.times.append(await self.rerun(f"{random.uniform(5, 9):.4g}"))

    async def rerun(self, tau_c: str) -> float:
        """ms until the script has ended."""
        asked = BackMsg()
        asked.rerun_script.query_string = f"plant={PLANT}&order=1&tau_c={tau_c}"
        asked.rerun_script.page_name = "tuning"
        asked.rerun_script.cached_message_hashes.extend(self.kept)
        begin = time.perf_counter()
        await self.socket.send(asked.SerializeToString())
        while True:
            message = ForwardMsg.FromString(await self.socket.recv())
            if message.metadata.cacheable and message.hash not in self.kept:
                self.kept.append(message.hash)
            if message.WhichOneof("type") == "script_finished":
                if message.script_finished != ForwardMsg.FINISHED_SUCCESSFULLY or not self.kept:
                    raise RuntimeError("the page did not run")  # the table is large enough to be kept
                return 1000 * (time.perf_counter() - begin)


def memory(server: Server) -> float:
    """Resident memory of the process, MB."""
    status = Path(f"/proc/{server.process.pid}/status").read_text()
    return int(re.search(r"VmRSS:\s+(\d+)", status)[1]) / 1024


def p95(times: list[float]) -> float:
    """95 % of the times are below."""
    return sorted(times)[math.ceil(0.95 * len(times)) - 1]


def show(result: dict) -> None:
    """The table."""
    base = result["bare slider"]["median ms"]
    print("key press to paint        median ms   p95 ms   ratio to the bare slider")
    for name in ("bare slider", "live", "live cascade"):
        row = result[name]
        print(f"{name:24} {row['median ms']:10.1f} {row['p95 ms']:8.1f} {row['median ms'] / base:10.2f}")
    redraws = [f"{result[name]['redraws per second']:.0f} ({name})" for name in ("live", "live cascade")]
    print(f"\nredraws per second while dragging, four panels: {', '.join(redraws)}")
    first = result["sessions"]["1"]["p95 ms"]
    print("\nsessions   release: median ms   p95 ms   ratio of p95   MB per session")
    for n, row in result["sessions"].items():
        ratio = row["p95 ms"] / first
        print(f"{n:>8} {row['median ms']:19.1f} {row['p95 ms']:8.1f} {ratio:14.2f} {row['MB per session']:16.2f}")


if __name__ == "__main__":
    main()
