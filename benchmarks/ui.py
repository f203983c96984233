"""make bench-ui: how fast the live instrument is in headless Chromium, beside Streamlit's own slider in the same run.

    key press to paint     from the time stamp of a real key press to the second frame that shows what it changed
    redraws per second     frames with a different drawing while the handle is dragged
    n sessions             websocket clients of one process, each releasing the slider now and then: from the request to
                           the end of the script, and the resident memory of the process per session
    n arrivals             websocket clients that open one link within a few seconds: from the connection to the end of
                           the script, beside a bare page in the same run

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

from tests.browser.conftest import ARGS
from tests.browser.tools import Server, idle
from tests.server.client import Client

PRESSES, DRAG = 40, 2.0  # s
SESSIONS, RELEASES, PAUSE = (1, 30, 100), 3, 10.0  # pause: mean seconds between two releases of one session
PLANT = "exp(-3s)/((6s%2B1)(4s%2B1)(2s%2B1))"
ARRIVALS = ((30, 1.0), (100, 10.0))  # visitors, and the seconds within which they come
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
    result["arrivals"] = {f"{n} in {within:g} s": all_arrivals(n, within) for n, within in ARRIVALS}
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
    """n clients of one process, whose first designs differ."""
    server = Server()
    try:
        async with asyncio.timeout(4 * PATIENCE):
            await visit(server.url, query("7"))  # the process has imported everything
            before, clients = memory(server), [Client(server.url) for _ in range(n)]
            for each in clients:  # one after the other: a class that comes in, not a stampede
                await each.open()
                await each.run("tuning", query("7"))
            times = await asyncio.gather(
                *(release(each, *((RELEASES, PAUSE) if n > 1 else (10, 0.5))) for each in clients)
            )
            grown = memory(server) - before
            await asyncio.gather(*(each.close() for each in clients))
        found = [time for each in times for time in each]
        return {"median ms": statistics.median(found), "p95 ms": p95(found), "MB per session": grown / n}
    finally:
        server.stop()


async def release(client: Client, times: int, pause: float) -> list[float]:
    """Releases of the slider at random moments; ms of each."""
    found = []
    for _ in range(times):
        await asyncio.sleep(random.uniform(0.5, 1.5) * pause)
        found.append(await client.run("tuning", query(f"{random.uniform(5, 9):.4g}")))
    return found


def all_arrivals(n: int, within: float) -> dict[str, dict[str, float]]:
    """Arrivals at the tuning page and, in the same run, at a bare one."""
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "bare.py"
        script.write_text(BARE)
        bare = asyncio.run(arrivals(Server(script), "", "", n, within))
    return {"tuning": asyncio.run(arrivals(Server(), "tuning", query("7"), n, within)), "bare": bare}


async def arrivals(server: Server, page: str, link: str, n: int, within: float) -> dict[str, float]:
    """n visitors who open one link at random moments within so many seconds."""
    try:
        async with asyncio.timeout(PATIENCE):
            await visit(
                server.url, "" if not page else f"{link}&b=0.9", page
            )  # everything is imported, no table is made
            times = await asyncio.gather(*(late(random.uniform(0, within), server.url, link, page) for _ in range(n)))
        return {"median ms": statistics.median(times), "p95 ms": p95(times)}
    finally:
        server.stop()


async def late(wait: float, *link: str) -> float:
    """A visit after a while."""
    await asyncio.sleep(wait)
    return await visit(*link)


async def visit(url: str, link: str, page: str = "tuning") -> float:
    """Open a page, and leave; ms from the connection to the end of the script."""
    begin, client = time.perf_counter(), Client(url)
    await client.open()
    await client.run(page, link)
    taken = 1000 * (time.perf_counter() - begin)
    await client.close()
    return taken


def query(tau_c: str) -> str:
    """The link of a design."""
    return f"plant={PLANT}&order=1&tau_c={tau_c}"


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
    print("\narrivals            median ms   p95 ms   bare page: median ms   p95 ms")
    for name, row in result["arrivals"].items():
        print(f"{name:17}", "".join(f"{row[each][key]:{width}.1f}" for each, key, width in COLUMNS))


COLUMNS = (("tuning", "median ms", 11), ("tuning", "p95 ms", 9), ("bare", "median ms", 23), ("bare", "p95 ms", 9))


if __name__ == "__main__":
    main()
