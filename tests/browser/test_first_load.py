"""The first visit to a fresh server by a browser that has nothing yet: what it costs on the wire, and that it works."""

from collections.abc import Callable

import pytest
from playwright.sync_api import Browser, expect

from pages.common.shell.header import NO_LOOP
from tests.browser.tools import PATIENCE, WIDTHS, Wire, idle, watch

GOALS = {  # MB
    "": 2.0,
    "plant": 3.0,
    "from_data": 3.0,
    "half_rule": 3.0,
    "tuning": 2.0,
    "cascade": 3.0,
    "lessons": 2.0,
    "accuracy": 2.0,
    "sources": 2.0,
}
LINK = "plant=2 exp(-s)/(10s%2B1)&order=1&tau_c=3&Ga=3/(10s%2B1)"


@pytest.mark.parametrize(("place", "most"), GOALS.items())
def test_a_deep_link_may_be_the_first_request_of_a_fresh_server_and_is_small(fresh_server, chromium, place, most):
    """The first run is slow and another one overtakes it: what it had put into the fields must come all the same.

    On a full machine it may be overtaken after it has sent a table, which then comes twice: such a visit is repeated.
    """
    loaded = least_of_two(lambda: first_load(fresh_server(), chromium, place), most)
    assert 0.5 < loaded <= most  # half a megabyte is what Streamlit needs at the least: it was counted


def least_of_two(measured: Callable[[], float], most: float) -> float:
    once = measured()
    return once if once <= most else min(once, measured())


def first_load(server: str, chromium: Browser, place: str) -> float:
    """Megabytes on the wire, of a page that came as it should."""
    faults: list[str] = []
    context = chromium.new_context(viewport={"width": 1280, "height": WIDTHS[1280]})
    page = context.new_page()
    page.set_default_timeout(1000 * PATIENCE)
    watch(page, faults)
    wire = Wire(page)
    page.goto(f"{server}/{place}?{LINK}")
    idle(page, settle=1.0)
    if place not in NO_LOOP:
        expect(page.locator(".st-key-line .katex").first).to_contain_text("10s")
    expect(page.get_by_test_id("stSidebarNav")).to_contain_text("Half rule")
    if place == "plant":
        expect(page.get_by_label("Transfer function", exact=True)).to_have_value("2 exp(-s)/(10 s + 1)")
    if place == "tuning":
        expect(page.get_by_role("radio", name="PI", exact=True)).to_be_checked()
    assert page.get_by_test_id("stException").count() == 0
    assert "tau_c=3" in page.url
    context.close()
    assert not faults, "\n".join(faults)
    return wire.bytes / 1e6
