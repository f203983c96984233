"""Accuracy page: at a glance, and without breaking a narrow screen."""

import pytest
from playwright.sync_api import expect

from tests.browser.tools import fits, picture


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("width", [1280, 390])
def test_the_verdict_is_on_top_and_wide_tables_scroll_in_themselves(width, theme, server, open_page):
    page = open_page(f"{server}/accuracy", width, theme)
    expect(page.locator(".strip.accuracy")).to_contain_text("within their tolerance")
    box = page.locator(".strip.accuracy").bounding_box()
    assert box["y"] + box["height"] < page.viewport_size["height"]
    assert fits(page)
    picture(page, "accuracy")
    page.locator(".st-key-references_3").scroll_into_view_if_needed()
    picture(page, "accuracy-limits")
