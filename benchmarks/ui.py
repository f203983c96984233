"""make bench-ui: how fast the live instrument is in headless Chromium, beside Streamlit's own slider in the same run.

    key press to paint     from the time stamp of a real key press to the second frame that shows what it changed
    redraws per second     frames with a different drawing while the handle is dragged
    first load             megabytes on the wire until a page is at rest, in a browser that has nothing yet
    sessions, arrivals     see visitors.py

Ratios hold on any machine, milliseconds on this one. Bounded: about two minutes. The last line is JSON.
"""

import asyncio
import json
import shutil
import statistics
import tempfile
import time
from pathlib import Path

from playwright.sync_api import Browser, Page, sync_playwright

from benchmarks.visitors import ARRIVALS, BARE, PLANT, SESSIONS, all_arrivals, p95, sessions
from tests.browser.conftest import ARGS
from tests.browser.tools import CHROMIUM, Server, Wire, idle

PRESSES, DRAG = 40, 2.0  # s
COLUMNS = (("tuning", "median ms", 11), ("tuning", "p95 ms", 9), ("bare", "median ms", 23), ("bare", "p95 ms", 9))
FIRST = ("", "plant", "half_rule", "tuning", "cascade", "accuracy")
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
        browser = playwright.chromium.launch(executable_path=shutil.which(CHROMIUM), args=ARGS)
        page = browser.new_page(viewport={"width": 1280, "height": 900})
        result = {"bare slider": bare(page), "live": live(page, f"tuning?plant={PLANT}")}
        result["live cascade"] = live(page, "cascade")
        result["first load"] = first_loads(browser)
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


def first_loads(browser: Browser) -> dict[str, float]:
    """MB on the wire of each page, and of a bare one."""
    server, found = Server(), {}
    for path in FIRST:
        found[path] = first_load(browser, f"{server.url}/{path}")
    server.stop()
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "bare.py"
        script.write_text(BARE)
        server = Server(script)
        found["bare"] = first_load(browser, server.url)
        server.stop()
    return found


def first_load(browser: Browser, address: str) -> float:
    """MB until the page is at rest."""
    page = browser.new_page()
    wire = Wire(page)
    page.goto(address)
    idle(page, 1.0)
    page.close()
    return wire.bytes / 1e6


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


def show(result: dict) -> None:
    """The table."""
    base = result["bare slider"]["median ms"]
    print("key press to paint        median ms   p95 ms   ratio to the bare slider")
    for name in ("bare slider", "live", "live cascade"):
        row = result[name]
        print(f"{name:24} {row['median ms']:10.1f} {row['p95 ms']:8.1f} {row['median ms'] / base:10.2f}")
    redraws = [f"{result[name]['redraws per second']:.0f} ({name})" for name in ("live", "live cascade")]
    print(f"\nredraws per second while dragging, four panels: {', '.join(redraws)}")
    loads = ", ".join(f"{name or 'home'} {size:.2f}" for name, size in result["first load"].items())
    print(f"\nfirst load, MB on the wire: {loads}")
    first = result["sessions"]["1"]["p95 ms"]
    print("\nsessions   release: median ms   p95 ms   ratio of p95   MB per session")
    for n, row in result["sessions"].items():
        ratio = row["p95 ms"] / first
        print(f"{n:>8} {row['median ms']:19.1f} {row['p95 ms']:8.1f} {ratio:14.2f} {row['MB per session']:16.2f}")
    print("\narrivals            median ms   p95 ms   bare page: median ms   p95 ms")
    for name, row in result["arrivals"].items():
        print(f"{name:17}", "".join(f"{row[each][key]:{width}.1f}" for each, key, width in COLUMNS))


if __name__ == "__main__":
    main()
