"""The tuning page as the eye gets it: all of it at once on a wide screen, one panel at a time on a narrow one."""

import pytest
from playwright.sync_api import Page, expect

from tests.browser.tools import fits, idle, nyquist_scale, picture

EXAMPLE = "exp(-3s)/((6s%2B1)(4s%2B1)(2s%2B1))"  # [V06] example 1
PANELS = ("y", "u", "nyquist", "sensitivity")


def figures(open_page, server, width=1280) -> Page:
    """The figures to export, open."""
    page = open_page(f"{server}/tuning?plant={EXAMPLE}&view=figures", width)
    idle(page)
    return page


def panel(page: Page, key: str):
    return page.locator(f".st-key-panel_{key}")


def test_everything_that_decides_is_in_sight_without_scrolling(server, open_page):
    page = figures(open_page, server)
    for key in PANELS:
        panel(page, key).locator(".main-svg").first.wait_for()
        box = panel(page, key).bounding_box()
        assert box["y"] + box["height"] <= 900
    strip = page.locator(".strip").bounding_box()
    assert strip["y"] + strip["height"] < panel(page, "y").bounding_box()["y"]
    assert page.locator(".st-key-panel").is_hidden()
    picture(page, "tuning-all")


def test_a_narrow_screen_shows_one_panel_and_two_figures_a_row(server, open_page):
    page = figures(open_page, server, 390)
    assert [panel(page, key).is_visible() for key in PANELS] == [True, False, False, False]
    page.locator(".st-key-panel").get_by_text("Nyquist").click()
    idle(page)
    assert [panel(page, key).is_visible() for key in PANELS] == [False, False, True, False]
    expect(panel(page, "nyquist").locator(".main-svg").first).to_be_visible()
    columns = page.evaluate("getComputedStyle(document.querySelector('.strip')).gridTemplateColumns")
    assert len(columns.split()) == 2
    assert fits(page)


@pytest.mark.parametrize("key", ["Enter", " "])
def test_pinning_works_from_the_keyboard_and_is_drawn(key, server, open_page):
    page = figures(open_page, server)
    page.get_by_role("button", name="Pin as A").press(key)
    idle(page)
    assert "pins=" in page.url
    page.get_by_label("exact").fill("20")
    page.get_by_label("exact").press("Enter")
    idle(page)
    expect(panel(page, "y").locator(".legendtext", has_text="A")).to_be_visible()


def test_nyquist_is_drawn_one_to_one_and_figures_export_as_svg(server, open_page):
    page = figures(open_page, server)
    panel(page, "nyquist").locator(".main-svg").first.wait_for()
    assert nyquist_scale(page) == pytest.approx(1, rel=1e-6)
    panel(page, "nyquist").hover()
    with page.expect_download() as download:
        panel(page, "nyquist").locator("[data-title*='Download']").click()
    assert download.value.suggested_filename == "nyquist.svg"
