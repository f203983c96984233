"""Servers, waiting, pictures: what the browser tests share."""

import os
import re
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from urllib.request import urlopen

from playwright.sync_api import Browser, Error, Locator, Page, TimeoutError

ROOT = Path(__file__).parents[2]
PICTURES = Path(__file__).parent / "screenshots"
WIDTHS = {1280: 900, 390: 844}
THEMES = ("light", "dark")
# Debian's Chromium, built without a window: a tenth less work
CHROMIUM = "chromium-headless-shell"
ARGS = [
    "--font-render-hinting=none",  # text as wide as in a window
    "--js-flags=--no-maglev --no-turbofan",  # a page is gone before code that is compiled so well has paid for itself
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1",
]
IDLE = "[data-testid=stApp][data-test-script-state=notRunning]"
LOOK = 0.05  # seconds from a look at the page to the next
# Whether it was found at rest so many times in a row, before the end of our patience.
RESTED = """([idle, looks, wait, patience]) => new Promise(done => {
    const end = performance.now() + patience;
    let quiet = 0;
    const look = () => {
        quiet = document.querySelector(idle)?.checkVisibility() ? quiet + 1 : 0;
        if (quiet === looks || performance.now() > end) done(quiet === looks);
        else setTimeout(look, wait);
    };
    setTimeout(look, wait);
})"""
DRAWN = """() => {
    const seen = what => [...document.querySelectorAll(what)].filter(element => element.checkVisibility());
    return seen('[data-testid=stPlotlyChart]').every(figure => figure.querySelector('.main-svg'))
        && !seen('[data-testid=stSkeleton], [data-stale=true]').length;
}"""
LIGHTNESS = "element => Number(getComputedStyle(element).backgroundColor.match(/\\d+/)[0])"  # its red, 0 to 255
VIOLATIONS = """document.addEventListener('securitypolicyviolation', event => {
    console.error('forbidden by the policy: ' + event.violatedDirective + ' ' + event.blockedURI);
});"""
# On a deep link Streamlit first looks for itself below the page's own path, and finds itself one level up.
PROBE = re.compile(r"/\w+/_stcore/(health|host-config)$")
PATIENCE = 60  # seconds, on a busy machine, until a server has started, a page has run, a condition holds


class Server:
    """A fresh `streamlit run` of a script, app.py unless told otherwise, on a port of 127.0.0.1, a free one if None.

    Settings are those of .streamlit/config.toml, as for everybody, but for `options` of the command line.
    below: a path of the site, such as /simc, below which the app is.
    """

    def __init__(
        self,
        script: Path = ROOT / "app.py",
        port: int | None = None,
        options: tuple[str, ...] = (),
        environment: dict[str, str] | None = None,
        folder: Path = ROOT,
        below: str = "",
    ):
        if port is None:
            with socket.socket() as free:
                free.bind(("127.0.0.1", 0))
                port = free.getsockname()[1]
        self.port = port
        self.url = f"http://127.0.0.1:{port}{below}"
        options = (*options, f"--server.baseUrlPath={below}") if below else options
        command = [sys.executable, "-m", "streamlit", "run", str(script)]
        self.process = subprocess.Popen(
            [*command, f"--server.port={port}", *options],
            cwd=folder,
            env=os.environ | (environment or {}),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self._wait()

    def _wait(self) -> None:
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            try:
                with urlopen(self.url + "/_stcore/health", timeout=1) as answer:
                    if answer.status == 200:
                        return
            except OSError:
                time.sleep(0.1)
        self.stop()
        raise RuntimeError(f"the server did not answer within {PATIENCE} s")

    def stop(self) -> None:
        self.process.terminate()
        self.process.wait(timeout=10)


def idle(page: Page, settle: float = 0.25) -> None:
    """Wait until the script has run and stays at rest for `settle` seconds.

    The page looks for itself: each look asked for from here is work of four processes.
    """
    end = time.monotonic() + PATIENCE
    while True:
        page.wait_for_selector(IDLE)
        try:
            assert page.evaluate(RESTED, [IDLE, round(settle / LOOK), 1000 * LOOK, 1000 * PATIENCE]), "it does not rest"
            return
        except Error as error:
            if "context was destroyed" not in str(error):  # another page has come, and took with it what was looking
                raise
            assert time.monotonic() < end, f"waited {PATIENCE} s in vain until the page is at rest"


def drawn(page: Page) -> None:
    """Wait until every figure in sight is there and nothing of a former run is left."""
    wait_until(page, lambda: page.evaluate(DRAWN), "the page is drawn")


def choose(page: Page, box: Locator, name: str) -> None:
    """Take an option of a list, which what still scrolls or comes in may have closed again."""
    box.scroll_into_view_if_needed()
    idle(page)
    option = page.get_by_role("option", name=name, exact=True)
    end = time.monotonic() + PATIENCE
    while True:
        if not option.is_visible():
            box.click()
        try:
            option.click(timeout=3000)
            return
        except TimeoutError:
            assert time.monotonic() < end, f"waited {PATIENCE} s in vain for {name}"


def wait_until(page: Page, holds: Callable[[], bool], what: str) -> None:
    """Ask again and again, for a patient while, until it holds."""
    end = time.monotonic() + PATIENCE
    while not holds():
        assert time.monotonic() < end, f"waited {PATIENCE} s in vain until {what}"
        page.wait_for_timeout(20)


def frames(page: Page) -> None:
    """Two frames of the browser: what a movement changes is painted in the second at the latest."""
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def both_themes(page: Page) -> Iterator[str]:
    """Light, then dark, on the same page: the browser says that its theme has changed, and the page follows."""
    for theme in THEMES:
        page.emulate_media(color_scheme=theme)
        ground = page.locator("[data-testid=stApp]")
        wait_until(page, lambda: (ground.evaluate(LIGHTNESS) < 128) == (theme == "dark"), f"the page is {theme}")  # noqa: B023
        idle(page)
        yield theme


def picture(page: Page, name: str) -> Path:
    """Store a screenshot as screenshots/NAME-WIDTH-THEME.png and give its path."""
    dark = page.evaluate("matchMedia('(prefers-color-scheme: dark)').matches")
    PICTURES.mkdir(exist_ok=True)
    path = PICTURES / f"{name}-{page.viewport_size['width']}-{THEMES[dark]}.png"
    drawn(page)
    page.screenshot(path=path, animations="disabled")
    return path


def fits(page: Page) -> bool:
    """Nothing sticks out to the right: the page does not scroll sideways."""
    return page.evaluate("document.querySelector('[data-testid=stMain]').scrollWidth <= innerWidth")


def nyquist_scale(page: Page) -> float:
    """Pixels per unit along the real axis of the Nyquist panel, over those along the imaginary one."""
    return page.evaluate(
        """() => {
            const layout = document.querySelector('.st-key-panel_nyquist .js-plotly-plot')._fullLayout;
            const per = axis => axis._length / (axis.range[1] - axis.range[0]);
            return per(layout.xaxis) / per(layout.yaxis);
        }"""
    )


def watch(page: Page, faults: list[str]) -> None:
    """Enter among the faults: errors of the console, exceptions, what the policy forbids, requests to other hosts."""

    def console(message) -> None:
        where = message.location.get("url", "")
        if message.type == "error" and not PROBE.search(where):
            faults.append(f"console: {message.text} {where}")

    def request(asked) -> None:
        if not asked.url.startswith(("http://127.0.0.1:", "ws://127.0.0.1:", "data:", "blob:", "about:")):
            faults.append(f"request to another host: {asked.url}")

    page.add_init_script(VIOLATIONS)
    page.on("console", console)
    page.on("pageerror", lambda error: faults.append(f"exception: {error}"))
    page.on("request", request)


class Tab:
    """A page in a context of its own, watched, for one test after the other."""

    def __init__(self, browser: Browser, how: dict):
        self.how = how  # settings of the context
        self.page = browser.new_context(**how).new_page()
        self.page.set_default_timeout(1000 * PATIENCE)
        self.faults: list[str] = []
        watch(self.page, self.faults)

    def clean(self, server: str) -> None:
        """Leave the app, that it writes no more, and forget what a test left: storage, cookies, permissions, mouse."""
        self.page.goto(f"{server}/_stcore/health")
        self.page.evaluate("localStorage.clear(); sessionStorage.clear()")
        self.page.context.clear_cookies()
        self.page.context.clear_permissions()
        self.page.mouse.move(0, 0)
        self.faults.clear()

    def close(self) -> None:
        self.page.context.close()


class Wire:
    """Counts the bytes a page receives from now on, compressed as they come, websockets included."""

    def __init__(self, page: Page):
        self.bytes = 0
        devtools = page.context.new_cdp_session(page)
        devtools.send("Network.enable")
        devtools.on("Network.loadingFinished", lambda event: self._add(event["encodedDataLength"]))
        devtools.on("Network.webSocketFrameReceived", lambda event: self._add(_length(event["response"])))

    def _add(self, size: float) -> None:
        self.bytes += int(size)


def _length(frame: dict) -> int:
    """Bytes of a frame; DevTools gives binary ones (opcode 2) as base64."""
    return 3 * len(frame["payloadData"]) // 4 if frame["opcode"] == 2 else len(frame["payloadData"])
