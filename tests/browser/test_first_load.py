"""What a first visit costs: bytes on the wire until the page is at rest, in a browser that has nothing yet."""

import pytest
from playwright.sync_api import expect

from tests.browser.tools import Wire, idle

GOALS = {"": 2.0, "tuning": 2.0, "cascade": 3.0, "plant": 3.0, "half_rule": 3.0, "accuracy": 2.0}  # MB


@pytest.mark.parametrize(("place", "most"), GOALS.items())
def test_a_first_visit_is_small(server, chromium, place, most):
    context = chromium.new_context(viewport={"width": 1280, "height": 900})
    page = context.new_page()
    wire = Wire(page)
    page.goto(f"{server}/{place}")
    idle(page, settle=1.0)
    context.close()
    assert 0.5 < wire.bytes / 1e6 <= most  # half a megabyte is what Streamlit needs at the least: it was counted


def test_the_first_visitor_of_a_fresh_server_finds_every_field_filled(fresh_server, open_page):
    """The first run is slow and another one overtakes it: what it had put into the fields must come all the same."""
    page = open_page(f"{fresh_server()}/plant?plant=2/(5s%2B1)")
    expect(page.get_by_label("Transfer function", exact=True)).to_have_value("2/(5 s + 1)")
    page = open_page(f"{fresh_server()}/tuning?plant=2/(5s%2B1)")
    expect(page.get_by_role("radio", name="PI", exact=True)).to_be_checked()
