"""The cascade page in Chromium: from a pair of the paper to a link, every tab, both widths and themes."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.tools import WIDTHS, both_themes, drawn, fits, idle, nyquist_scale, picture

TABS = ("Live", "Figures", "Bode", "Settings", "Windup", "Published pairs")
PANELS = ("y1", "y2", "u", "nyquist")
TRACEBACK = "[data-testid=stException]"


def peaks(page: Page) -> list[float]:
    """Msa and Msb as the strip shows them."""
    shown = page.locator(".strip .first b")
    expect(shown).to_have_count(2)
    return [float(text) for text in shown.all_inner_texts()]


def choose_pair(page: Page, title: str) -> None:
    page.get_by_role("combobox", name="From the literature").click()
    page.get_by_role("option", name=title).click()
    idle(page)


def tab(page: Page, name: str) -> None:
    page.get_by_role("tab", name=name).click()
    expect(page.get_by_role("tab", name=name)).to_have_attribute("aria-selected", "true")
    idle(page)
    drawn(page)


def test_from_a_pair_of_the_paper_to_a_link_that_opens_the_same_cascade(server, fresh_server, open_page):
    page = open_page(f"{server}/cascade")
    tab(page, "Figures")
    choose_pair(page, "Pair 1a")
    expect(page.get_by_role("radio", name="Direct synthesis")).to_be_checked()
    assert peaks(page) == pytest.approx([2.0, 2.0], abs=0.01)
    expect(page.locator(".strip")).to_contain_text("2.31")  # IAE of d2, as printed
    outer = page.locator(".st-key-loop_outer")
    outer.get_by_role("radio", name="PI", exact=True).click()
    page.wait_for_url("**outer=PI**")
    idle(page)
    assert peaks(page) == pytest.approx([2.0, 2.0], abs=0.01)
    for name in TABS:
        tab(page, name)
        assert page.locator(TRACEBACK).count() == 0
    tab(page, "Figures")
    link = page.locator(".st-key-address_text pre").inner_text()
    again = open_page(re.sub(r"^http://[^/]+", fresh_server(), link))
    tab(again, "Figures")
    expect(again.locator(".strip")).to_have_text(page.locator(".strip").inner_text(), use_inner_text=True)
    assert again.locator(".diagram .wide").text_content() == page.locator(".diagram .wide").text_content()


def test_everything_that_decides_is_in_sight_without_scrolling(server, open_page):
    page = open_page(f"{server}/cascade")
    tab(page, "Figures")
    for key in PANELS:
        panel = page.locator(f".st-key-panel_{key}")
        panel.locator(".main-svg").first.wait_for()
        box = panel.bounding_box()
        assert box["y"] + box["height"] <= 900
    expect(page.locator(".diagram .wide")).to_be_visible()
    expect(page.locator(".diagram .narrow")).to_be_hidden()
    assert "Block diagram" in page.locator(".diagram .wide").get_attribute("aria-label")
    assert nyquist_scale(page) == pytest.approx(1, rel=1e-6)


def test_a_narrow_screen_has_its_own_diagram_and_one_panel(server, open_page):
    page = open_page(f"{server}/cascade", 390)
    tab(page, "Figures")
    expect(page.locator(".diagram .narrow")).to_be_visible()
    expect(page.locator(".diagram .wide")).to_be_hidden()
    visible = [page.locator(f".st-key-panel_{key}").is_visible() for key in PANELS]
    assert visible == [True, False, False, False]
    page.locator(".st-key-panel").get_by_text("Nyquist").click()
    idle(page)
    expect(page.locator(".st-key-panel_nyquist .main-svg").first).to_be_visible()


def test_the_keyboard_is_enough_to_type_a_block_and_to_switch_the_method(server, open_page):
    page = open_page(f"{server}/cascade")
    page.get_by_role("button", name="primary").press("Enter")
    field = page.get_by_label("Transfer function", exact=True)
    field.fill("exp(-s)/(20s-1)")
    field.press("Enter")
    idle(page)
    page.keyboard.press("Escape")
    expect(page.get_by_test_id("stAlert").first).to_contain_text("use direct synthesis")
    page.get_by_role("button", name="Use direct synthesis").press("Enter")
    page.wait_for_url("**method=synthesis**")


def test_a_tab_of_the_tuning_page_does_not_follow_to_the_cascade(server, open_page):
    page = open_page(f"{server}/tuning", 390)
    page.get_by_role("radio", name="Figures to export").click()
    idle(page)
    page.locator(".st-key-panel").get_by_text("|S| |T|").click()
    idle(page)
    page.locator(".st-key-chain").get_by_role("link", name="Cascade").click()
    page.wait_for_url(re.compile("cascade"))
    idle(page)
    tab(page, "Figures")
    expect(page.locator(".st-key-panel_y1 .main-svg").first).to_be_visible()
    assert page.locator(TRACEBACK).count() == 0


@pytest.mark.parametrize("width", WIDTHS)
def test_every_tab_fits_both_widths_in_both_themes(width, server, open_page):
    page = open_page(f"{server}/cascade?method=synthesis&b_outer=0.3", width)
    for _ in both_themes(page):
        for name in TABS:
            tab(page, name)
            assert fits(page)
            picture(page, f"cascade-{name.split()[0].lower()}")
