"""The main job, as an engineer does it: type a plant, reduce it, move tau_c, read Ms, hand the link on."""

import re
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from pages.common.session.project import load
from simc_core import Plant
from tests.browser.tools import WIDTHS, both_themes, fits, frames, idle, picture

EXAMPLE = "exp(-3s)/((6s+1)(4s+1)(2s+1))"  # [V06] example 1: PI Kc 0.57, tau_I 8
PLACES = ("", "plant", "from_data", "half_rule", "tuning", "cascade", "lessons", "accuracy", "sources")
TRACEBACK = "[data-testid=stException]"


def follow(page: Page, name: str) -> None:
    """Click a link of the chain on top."""
    page.locator(".st-key-chain").get_by_role("link", name=name).click()
    page.wait_for_url(re.compile(name.lower().replace(" ", "_")))
    idle(page)


def type_plant(page: Page, text: str) -> None:
    field = page.get_by_label("Transfer function", exact=True)
    field.fill(text)
    field.press("Enter")
    idle(page)


def test_from_a_typed_plant_to_a_link_that_opens_the_same_design(server, fresh_server, open_page):
    page = open_page(f"{server}/plant")
    type_plant(page, EXAMPLE)
    expect(page.get_by_text("Stable, lag and dead time alike", exact=True)).to_be_visible()
    follow(page, "Half rule")
    expect(page.get_by_test_id("stMain")).to_contain_text(re.compile("tau1|τ1|τ_1"))
    follow(page, "Tuning")
    expect(page.get_by_test_id("stMain")).to_contain_text("0.5714")
    before = page.url
    page.get_by_role("slider").first.press("ArrowRight")
    page.wait_for_url(lambda url: url != before)
    idle(page)
    speed = re.search("speed=([^&]+)", page.url).group(1)
    expect(page.get_by_test_id("stMain")).to_contain_text("Ms")
    link = page.locator(".st-key-address_text pre").inner_text()
    again = open_page(re.sub(r"^http://[^/]+", fresh_server(), link))
    assert f"speed={speed}" in again.url
    assert (
        again.locator(".st-key-line .katex").first.inner_text()
        == page.locator(".st-key-line .katex").first.inner_text()
    )
    assert main_numbers(again) == main_numbers(page)


def main_numbers(page: Page) -> list[str]:
    """Every number the main area shows as text."""
    return re.findall(r"\d+\.\d+", page.get_by_test_id("stMain").inner_text())


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("place", PLACES)
def test_every_page_fits_both_widths_in_both_themes(place, width, server, open_page):
    page = open_page(f"{server}/{place}", width)
    for _ in both_themes(page):
        expect(page.get_by_test_id("stMain")).to_be_visible()
        assert page.locator(TRACEBACK).count() == 0
        picture(page, place or "home")
        assert fits(page)


def test_what_cannot_be_read_is_said_beside_the_field_and_the_last_plant_stays(server, open_page):
    page = open_page(f"{server}/plant")
    type_plant(page, "2/(5s+1)")
    type_plant(page, "2/(5s+")
    expect(page.get_by_test_id("stAlert")).to_be_visible()
    assert page.get_by_label("Transfer function", exact=True).input_value() == "2/(5s+"
    expect(page.locator(".st-key-line .katex").first).to_contain_text("5s+1")
    picture(page, "plant-error")


def test_table_and_polynomials_edit_the_same_plant(server, open_page):
    page = open_page(f"{server}/plant?plant=2/(5s%2B1)")
    page.get_by_role("radio", name="Factors").click()
    idle(page)
    gain = page.get_by_label("Gain k", exact=True)
    gain.fill("3")
    gain.press("Enter")
    expect(page.locator(".st-key-line .katex").first).to_contain_text("{3}")  # then the grid stays what it is
    idle(page)
    page.locator(".dvn-scroller").click(position={"x": 240, "y": 50})  # tau of row 1
    page.keyboard.press("Enter")  # opens the editor of the grid
    page.locator(".gdg-input:focus").wait_for()
    page.keyboard.press("Control+A")
    page.keyboard.type("8")
    frames(page)  # the grid takes what was typed with the next frame
    page.keyboard.press("Enter")
    idle(page)
    expect(page.locator(".st-key-line .katex").first).to_contain_text("8s+1")
    picture(page, "plant-factors")
    page.get_by_role("radio", name="Polynomials").click()
    idle(page)
    assert page.get_by_label("Numerator", exact=True).input_value() == "3"
    denominator = page.get_by_label("Denominator", exact=True)
    assert denominator.input_value() == "8 1"
    denominator.fill("12 7 1")
    denominator.press("Enter")
    idle(page)
    expect(page.locator(".st-key-line .katex").first).to_contain_text("(3s+1)(4s+1)")
    picture(page, "plant-polynomials")


def test_a_link_with_nonsense_says_what_was_ignored(server, open_page):
    page = open_page(f"{server}/tuning?plant=2/(5s%2B1)&tau_c=-3&colour=red")
    alert = page.get_by_test_id("stAlert").first
    expect(alert).to_contain_text("tau_c = -3")
    expect(alert).to_contain_text("colour = red")
    page.get_by_role("button", name="Dismiss").click()
    idle(page)
    expect(page.get_by_text("colour = red")).to_have_count(0)


def test_the_back_button_brings_the_former_design_back(server, open_page):
    page = open_page(f"{server}/plant?plant=2/(5s%2B1)")
    type_plant(page, "7/(9s+1)")
    expect(page.locator(".st-key-line .katex").first).to_contain_text("9s")
    page.wait_for_timeout(2100)  # for so long a former address counts as one that is late
    page.go_back()
    idle(page)
    expect(page.locator(".st-key-line .katex").first).to_contain_text("5s")
    assert page.get_by_label("Transfer function", exact=True).input_value() == "2/(5 s + 1)"


def test_keys_in_quick_succession_are_all_counted(server, open_page):
    page = open_page(f"{server}/plant?plant=2/(5s%2B1)")
    page.get_by_role("radio", name="Factors").click()
    idle(page)
    page.get_by_label("Gain k", exact=True).focus()
    page.keyboard.press("Control+A")
    page.keyboard.type("2.08")
    page.keyboard.press("Enter")
    page.wait_for_url(re.compile("plant=2.08%2F"))
    idle(page, settle=0.5)
    assert "plant=2.08%2F" in page.url


def test_the_saved_project_holds_the_design_that_is_shown(server, open_page):
    page = open_page(f"{server}/tuning?plant=2/(5s%2B1)*exp(-s)&tau_c=3")
    with page.expect_download() as download:
        page.get_by_role("button", name="Save project").click()
    assert download.value.suggested_filename == "simc-project.json"
    loops, reason = load(Path(download.value.path()).read_bytes())
    assert reason == ""
    assert (loops.design.plant, loops.design.tuning.tau_c) == (Plant(2.0, 1.0, (5.0,)), 3.0)
