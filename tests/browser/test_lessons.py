"""A lesson in a class: what is hidden stays hidden, handle and curve are in sight, progress outlasts the visit."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.tools import fits, idle, picture, wait_until

HIDDEN = ".live .strip, .live .presets, .live .extras, .live .top .settings"


def panels(page: Page) -> list[str]:
    """Titles of the panels in sight, once the instrument has them."""
    expect(page.locator(".live.staged")).to_be_visible()
    wait_until(page, lambda: page.locator(".live figure canvas:visible").count() > 0, "curves are there")
    return [figure.get_attribute("data-panel") for figure in page.locator(".live figure:visible").all()]


def test_from_play_to_the_numbers_and_again_from_a_link_after_a_reload(server, open_page):
    page = open_page(f"{server}/lessons?lesson=V1&step=1")
    assert panels(page) == ["y", "u"]
    assert page.locator(HIDDEN).locator("visible=true").count() == 0
    page.get_by_role("slider").press("ArrowRight")  # free play
    page.wait_for_url(re.compile("speed="))
    page.get_by_role("button", name="Next").click()
    expect(page.get_by_role("heading", level=2)).to_contain_text("What becomes of the IAE")
    assert page.locator(".live:visible").count() == 0  # the question alone
    page.get_by_role("button", name="B It falls to about half").click()
    expect(page.get_by_role("button", name="Next")).to_be_visible()
    page.keyboard.press("n")
    page.wait_for_url(re.compile("step=3"))
    assert "speed=" not in page.url  # each step begins with its own design
    assert panels(page) == ["y", "u"]
    page.goto(f"{server}/lessons?lesson=V1&step=7")
    assert sorted(panels(page)) == ["sensitivity", "y"]
    cells = page.locator(".live [data-figure]:visible")
    expect(cells).to_have_count(2)
    expect(cells.first).to_contain_text("1.69")
    page.wait_for_function("() => /true/.test(localStorage.getItem('simc-lessons'))")  # the answer was seen
    page.goto(f"{server}/lessons")
    idle(page)
    expect(page.locator(".st-key-cards_subject_3")).to_contain_text("✓ predicted")  # kept by the browser


DRAWN = "figure[data-panel=sensitivity] canvas"
INK = "canvas => canvas.toDataURL()"


def test_a_panel_that_was_out_of_sight_shows_the_design_of_the_step_and_no_former_one(server, open_page):
    page = open_page(f"{server}/lessons?lesson=V1&step=5")
    panels(page)
    idle(page)
    wanted = page.locator(DRAWN).evaluate(INK)
    page.goto(f"{server}/lessons?lesson=V1&step=3")
    for step in (4, 5):
        panels(page)
        idle(page)
        page.keyboard.press("n")
        page.wait_for_url(re.compile(f"step={step}"))
    panels(page)
    wait_until(page, lambda: page.locator(DRAWN).evaluate(INK) == wanted, "|S| is that of the step opened by its link")


def test_a_question_is_for_the_last_row_too(server, open_page):
    """Where there is no instrument the page itself grows."""
    page = open_page(f"{server}/lessons?lesson=V1&step=2&lecture=1")
    expect(page.get_by_test_id("stSidebar")).to_be_hidden()
    expect(page.get_by_role("heading", level=2)).to_be_visible()
    page.keyboard.press("Escape")
    expect(page.get_by_test_id("stSidebar")).to_be_visible()


def test_what_was_moved_outlasts_a_reload_and_is_put_back_with_one_key(server, open_page):
    page = open_page(f"{server}/lessons?lesson=V1&step=3")
    panels(page)
    page.get_by_role("slider").press("ArrowRight")
    page.wait_for_url(re.compile("speed="))
    moved = page.get_by_role("slider").get_attribute("aria-valuenow")
    page.reload()
    panels(page)
    assert page.get_by_role("slider").get_attribute("aria-valuenow") == moved
    page.locator("h1").click()
    page.keyboard.press("z")
    page.wait_for_url(lambda url: "speed=" not in url)
    expect(page.get_by_role("slider")).to_have_attribute("aria-valuenow", "7")


@pytest.mark.parametrize(("width", "height"), [(1920, 1080), (1366, 768), (390, 844)])
def test_handle_and_curve_stand_on_one_screen(width, height, server, open_page):
    page = open_page(f"{server}/lessons?lesson=V1&step=4")
    page.set_viewport_size({"width": width, "height": height})
    panels(page)
    expect(page.get_by_role("slider")).to_have_count(1)  # of two, one is of the run before
    page.get_by_role("slider").scroll_into_view_if_needed()
    handle, curve = (page.locator(f".live {what}").first.bounding_box() for what in (".handle", "figure:visible"))
    assert curve["y"] + curve["height"] - handle["y"] <= height - 60  # below the line of Streamlit
    if width > 390:
        assert curve["y"] + curve["height"] <= height
    assert fits(page)
    picture(page, "lessons-step")


def test_a_controller_of_two_settings_has_two_knobs(server, open_page):
    page = open_page(f"{server}/lessons?lesson=I4&step=1")
    assert panels(page) == ["y", "sensitivity"]
    expect(page.locator(".live .track:visible")).to_have_count(2)
