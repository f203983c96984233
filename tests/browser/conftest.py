"""Real Chromium against a real server. A test fails on a browser error and on any request to another host."""

import shutil
from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, sync_playwright

from tests.browser.tools import ARGS, PATIENCE, WIDTHS, Server, idle, watch


@pytest.fixture
def fresh_server() -> Iterator[Callable[[], str]]:
    """A factory of servers that nobody has asked anything yet; gives their addresses."""
    servers: list[Server] = []

    def start() -> str:
        servers.append(Server())
        return servers[-1].url

    yield start
    for server in servers:
        server.stop()


@pytest.fixture(scope="session")
def server() -> Iterator[str]:
    """The address of the server that all tests share."""
    one = Server()
    yield one.url
    one.stop()


@pytest.fixture(scope="session")
def chromium() -> Iterator[Browser]:
    """Debian's Chromium, headless."""
    path = shutil.which("chromium")
    assert path, "the browser tests need Chromium: apt-get install chromium"
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=ARGS)
        yield browser
        browser.close()


@pytest.fixture
def open_page(chromium) -> Iterator[Callable[..., Page]]:
    """open_page(address, width=1280, theme="light", touch=False): a page in a context of its own, idle.

    When the test ends, errors of the browser and requests to other hosts fail it.
    """
    contexts: list[BrowserContext] = []
    faults: list[str] = []

    def start(address: str, width: int = 1280, theme: str = "light", touch: bool = False) -> Page:
        context = chromium.new_context(
            viewport={"width": width, "height": WIDTHS[width]}, color_scheme=theme, has_touch=touch
        )
        contexts.append(context)
        page = context.new_page()
        page.set_default_timeout(1000 * PATIENCE)
        watch(page, faults)
        page.goto(address)
        idle(page)
        return page

    yield start
    for context in contexts:
        context.close()
    assert not faults, "\n".join(faults)
