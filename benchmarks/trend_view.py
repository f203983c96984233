"""`python -m benchmarks.trend_view`: frames a second while a record of 100 000 samples is panned and zoomed.

A file is uploaded to the page From data in headless Chromium. Then the mouse drags on its figure: to draw a range that
is zoomed to, and, after a click in its mode bar, to pan and to draw plotly's own zoom box. Counted are frames whose
picture differs from the one before: the axis has moved, or the box has. `to all samples` is from letting go to the
figure with every sample of a range of 1500. Bounded: about a minute. The last line is JSON.
"""

import json
import shutil
import tempfile
import time
from pathlib import Path

import numpy as np
from playwright.sync_api import Page, sync_playwright

from tests.browser.conftest import ARGS
from tests.browser.tools import PATIENCE, Server, idle, wait_until
from tests.identification.simulated import rise

SAMPLES = 100_000
DRAG = 2.0  # s
FIGURE = ".st-key-figure_trend .js-plotly-plot"
COUNT = """figure => {
    globalThis.pictures = [];
    const read = () => [...figure.querySelectorAll('.plot, .xtick text, .zoombox, .select-outline')]
        .map(each => (each.getAttribute('transform') ?? '') + (each.getAttribute('d') ?? '')).join();
    const look = now => {
        if (globalThis.pictures === null) return;
        const picture = read();
        if (globalThis.pictures.at(-1)?.[1] !== picture) globalThis.pictures.push([now, picture]);
        requestAnimationFrame(look);
    };
    requestAnimationFrame(look);
}"""
COUNTED = """() => {
    const times = globalThis.pictures.slice(1).map(each => each[0]);
    globalThis.pictures = null;
    return times;
}"""
ALL_DRAWN = """figure => {
    const x = figure.calcdata?.find(each => each[0].trace.name === 'PV')?.map(point => point.x) ?? [];
    return x.length > 2 && x.every((each, i) => !i || Math.abs(each - x[i - 1] - 1) < 1e-9);
}"""


def main() -> None:
    """Run, print what was counted, then one line of JSON."""
    server = Server()
    try:
        with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
            browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=ARGS)
            page = browser.new_page(viewport={"width": 1280, "height": 900})
            page.set_default_timeout(1000 * PATIENCE)
            page.goto(f"{server.url}/from_data")
            idle(page)
            page.locator(".st-key-stack_from_data input[type=file]").set_input_files(record(Path(folder)))
            page.locator(f"{FIGURE} .scatterlayer").first.wait_for()
            idle(page, 1.0)
            result = measured(page)
            browser.close()
    finally:
        server.stop()
    for name, value in result.items():
        print(f"{name}: {value:.1f}")
    print(json.dumps(result))


def record(folder: Path) -> Path:
    """A file with noise at every sample, and a step of OP every few hours."""
    t = np.arange(float(SAMPLES))
    at = np.arange(5000.0, SAMPLES, 12_000.0)
    signs = np.where(np.arange(at.size) % 2, -1.0, 1.0)
    y = 60 + sum(6 * sign * rise(t - s - 90, 700.0) for sign, s in zip(signs, at, strict=True))
    y = y + 0.15 * np.random.default_rng(1).standard_normal(SAMPLES)
    u = 45 + 5 * (np.searchsorted(at, t, "right") % 2)
    path = folder / "day.csv"
    rows = "\n".join(f"{a:.0f};{b:.3f};{c}" for a, b, c in zip(t, y, u, strict=True))
    path.write_text(f"Time [s];PV;OP\n{rows}\n")
    return path


def measured(page: Page) -> dict[str, float]:
    """Frames a second of each drag, and the time until all samples of a range are there."""
    found = {"range drawn, frames/s": dragged(page)}
    whole(page)
    begun = drawn_over(page, 0.015)
    wait_until(page, lambda: page.locator(FIGURE).evaluate(ALL_DRAWN), "all samples are drawn")
    found["to all samples, s"] = time.monotonic() - begun
    whole(page)
    for name, button in (("panned", "pan"), ("zoom box", "zoom")):
        page.locator(FIGURE).hover()
        page.locator(f"{FIGURE} .modebar-btn[data-val={button}]").click()
        found[f"{name}, frames/s"] = dragged(page)
        idle(page)
    return found


def whole(page: Page) -> None:
    """Back to the whole record."""
    page.get_by_role("button", name="Whole record").click()
    idle(page, 1.0)


def drawn_over(page: Page, share: float) -> float:
    """Draw a range of this share of the record; when it was let go."""
    x, y, width = place(page)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + share * width, y + 5, steps=5)
    page.mouse.up()
    return time.monotonic()


def place(page: Page) -> tuple[float, float, float]:
    """A point of the record where a drag begins, and its width, px."""
    box = page.locator(f"{FIGURE} .nsewdrag").first.bounding_box()
    assert box
    return box["x"] + 0.2 * box["width"], box["y"] + 0.5 * box["height"], box["width"]


def dragged(page: Page, share: float = 0.6) -> float:
    """Different frames a second while the mouse goes to and fro on the record, pressed."""
    x, y, width = place(page)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 10, y)
    page.locator(FIGURE).evaluate(COUNT)
    begun = time.monotonic()
    while (gone := time.monotonic() - begun) < DRAG:
        page.mouse.move(x + 10 + share * width * gone / DRAG, y + 5)
    times = page.evaluate(COUNTED)
    page.mouse.up()
    return 1000 * (len(times) - 1) / (times[-1] - times[0])


if __name__ == "__main__":
    main()
