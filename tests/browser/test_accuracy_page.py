"""Accuracy page: at a glance, and without breaking a narrow screen."""

import pytest
from playwright.sync_api import expect

from tests.browser.tools import both_themes, fits, picture


@pytest.mark.parametrize("width", [1280, 390])
def test_the_verdict_is_on_top_and_wide_tables_scroll_in_themselves(width, server, open_page):
    page = open_page(f"{server}/accuracy", width)
    expect(page.locator(".strip.accuracy")).to_contain_text("within their tolerance")
    box = page.locator(".strip.accuracy").bounding_box()
    assert box["y"] + box["height"] < page.viewport_size["height"]
    assert fits(page)
    for _ in both_themes(page):
        page.locator(".strip.accuracy").scroll_into_view_if_needed()
        picture(page, "accuracy")
        page.locator(".st-key-references_3").scroll_into_view_if_needed()
        picture(page, "accuracy-limits")
