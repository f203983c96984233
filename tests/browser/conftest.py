"""Real Chromium against a real server. A test fails on a browser error and on any request to another host."""

import os
import shutil
from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Browser, Page, expect, sync_playwright

from tests.browser.tools import ARGS, CHROMIUM, PATIENCE, WIDTHS, Server, Tab, idle

expect.set_options(timeout=1000 * PATIENCE)


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
    """The address of the server that all tests of a worker share."""
    one = Server()
    yield one.url
    one.stop()


@pytest.fixture(scope="session")
def chromium() -> Iterator[Browser]:
    """Debian's Chromium, headless."""
    path = shutil.which(CHROMIUM)
    assert path, f"the browser tests need Chromium: apt-get install {CHROMIUM}"
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=ARGS)
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def idle_tabs(chromium) -> Iterator[list[Tab]]:
    """Tabs that no test uses now. What a tab has loaded and compiled once it has: a page takes a third of the time."""
    tabs: list[Tab] = []
    yield tabs
    for tab in tabs:
        tab.close()


@pytest.fixture
def open_page(request, server, chromium, idle_tabs) -> Iterator[Callable[..., Page]]:
    """A factory of pages, idle, each in a context that no other page has.

    Storage, cookies and permissions are empty; only the browser's cache may be warm. When the test ends, errors of the
    browser and requests to other hosts fail it, and its tabs are left to the next one unless it failed.
    """
    used: list[Tab] = []
    failed_before = request.session.testsfailed

    def start(
        address: str,
        width: int = 1280,
        theme: str = "light",
        touch: bool = False,
        locale: str = "en-US",
        mobile: bool = False,
    ) -> Page:
        how = {"has_touch": touch, "locale": locale, "is_mobile": mobile}
        tab = next((tab for tab in idle_tabs if tab.how == how), None)
        if tab is None:
            tab = Tab(chromium, how)
        else:
            idle_tabs.remove(tab)
        used.append(tab)
        page = tab.page
        page.set_viewport_size({"width": width, "height": WIDTHS[width]})
        page.emulate_media(color_scheme=theme, reduced_motion="reduce")  # what moves while we wait is painted in vain
        page.goto(address)
        idle(page)
        return page

    yield start
    faults = [fault for tab in used for fault in tab.faults]
    for tab in used:
        if faults or request.session.testsfailed > failed_before:
            tab.close()
        else:
            tab.clean(server)
            idle_tabs.append(tab)
    assert not faults, "\n".join(faults)


def pytest_xdist_auto_num_workers() -> int:
    """Half as many again as there are cores: what waits for a page to come to rest leaves them idle."""
    return max(1, 3 * (os.cpu_count() or 1) // 2)
