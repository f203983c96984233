"""How long a page, an edit and the published pairs take in headless Chromium, on a server that is warm.

    page switch     click on a link of the sidebar until the other page has run and is painted; beside it the same in an
                    app of two bare pages
    plant, cascade  Enter in a field until the script has run and all is painted
    pairs           click on the tab until all ten pairs stand there

    python -m benchmarks.switches

Milliseconds hold on the machine that printed them, the ratio to the bare page anywhere. Bounded: about a minute.
"""

import json
import shutil
import statistics
import tempfile
from pathlib import Path

from playwright.sync_api import Page, sync_playwright

from tests.browser.conftest import ARGS
from tests.browser.tools import CHROMIUM, Server, idle

ROUNDS = 5
BARE = """import streamlit as st
def page(name):
    def run():
        st.set_page_config(page_title=name)
        st.write(name)
    return st.Page(run, title=name, url_path=name.lower())
st.navigation([page("One"), page("Two")]).run()
"""
# From the next click or Enter until `done` holds and the script is at rest, to the second frame that shows it.
WATCH = """([kind, done]) => {
    const rest = "[data-testid=stApp][data-test-script-state=notRunning]";
    const holds = new Function("return " + done);
    globalThis.painted = new Promise(told => addEventListener(kind, event => {
        const begin = event.timeStamp;
        const look = () => document.querySelector(rest) && holds()
            ? requestAnimationFrame(() => requestAnimationFrame(() => told(performance.now() - begin)))
            : requestAnimationFrame(look);
        requestAnimationFrame(look);
    }, {once: true, capture: true}));
}"""


def main() -> None:
    """Run, print a table, then one line of JSON."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which(CHROMIUM), args=ARGS)
        page = browser.new_page(viewport={"width": 1280, "height": 900})
        result = {"bare": bare(page)} | ours(page)
        browser.close()
    print("from the hand to the paint, warm        median ms   worst ms")
    for name, times in result.items():
        print(f"{name:38} {statistics.median(times):10.0f} {max(times):10.0f}")
    print(json.dumps(result))


def bare(page: Page) -> list[float]:
    """Between two pages with one word each."""
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "bare.py"
        script.write_text(BARE)
        server = Server(script)
        page.goto(server.url)
        idle(page)
        times = [switch(page, name) for _ in range(ROUNDS) for name in ("Two", "One")]
        server.stop()
    return times


def ours(page: Page) -> dict[str, list[float]]:
    """Each page from the one before it; edits; the pairs."""
    server = Server()
    titles = (
        "Plant",
        "From data",
        "Half rule",
        "Tuning",
        "Rules",
        "Cascade",
        "Take home",
        "Many loops",
        "Accuracy",
        "Home",
    )
    page.goto(server.url)
    idle(page)
    for title in titles:  # everything is imported and compiled
        switch(page, title)
    found = {f"to {title}": [] for title in titles}
    for _ in range(ROUNDS):
        for title in titles:
            found[f"to {title}"].append(switch(page, title))
    switch(page, "Plant")
    found["plant, Enter"] = [edit(page, "Transfer function", f"exp(-s)/({7 + i}s+1)") for i in range(ROUNDS)]
    switch(page, "Cascade")
    page.get_by_role("button", name="primary").press("Enter")
    idle(page)
    found["cascade, Enter"] = [edit(page, "Transfer function", f"exp(-s)/({20 + i}s+1)") for i in range(ROUNDS)]
    page.evaluate(WATCH, ["click", "document.querySelectorAll('[data-testid=stDataFrame]').length == 2"])
    page.get_by_role("tab", name="Published pairs").click()
    found["pairs"] = [page.evaluate("() => painted")]
    server.stop()
    return found


def switch(page: Page, title: str) -> float:
    """To the page of this title by the sidebar, ms."""
    page.evaluate(WATCH, ["click", f"document.title.startsWith('{title}')"])
    page.locator("[data-testid=stSidebarNav]").get_by_role("link", name=title, exact=True).click()
    taken = page.evaluate("() => painted")
    idle(page)
    return taken


def edit(page: Page, label: str, text: str) -> float:
    """Enter behind a new text in the first field of this label, ms."""
    field = page.get_by_label(label, exact=True).first
    field.fill(text)
    before = page.locator(".st-key-line").inner_text()
    page.evaluate(WATCH, ["keydown", f"document.querySelector('.st-key-line').innerText != {json.dumps(before)}"])
    field.press("Enter")
    taken = page.evaluate("() => painted")
    idle(page)
    return taken


if __name__ == "__main__":
    main()
