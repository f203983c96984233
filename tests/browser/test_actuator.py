"""The loop as built: typed in, drawn, linked, and marked on every other view."""

import pytest
from playwright.sync_api import expect

from tests.browser.tools import both_themes, fits, idle, picture

EXAMPLE = "exp(-3s)/((6s%2B1)(4s%2B1)(2s%2B1))"  # [V06] example 1
LIMITED = f"/tuning?plant={EXAMPLE}&tau_c=2&u_min=0&u_max=1.1"
NAMES = {"linear", "no anti-windup", "as built"}


def traces(page, key: str) -> list:
    """Names of the curves of a figure."""
    return page.evaluate(
        f"[...document.querySelectorAll('.st-key-figure_{key} .js-plotly-plot')].flatMap(p => p.data.map(d => d.name))"
    )


def test_limits_are_typed_drawn_linked_and_taken_away_again(server, open_page):
    page = open_page(f"{server}/tuning?plant={EXAMPLE}&tau_c=2")
    expect(page.get_by_text("As built:")).to_have_count(0)
    page.get_by_role("tab", name="As built").click()
    idle(page)
    highest = page.get_by_role("textbox", name="Highest u")
    highest.fill("1.1")
    highest.press("Enter")
    page.wait_for_url("**u_max=1.1**")
    idle(page)
    expect(page.locator(".st-key-mark_wide")).to_contain_text("u limited to ≤ 1.1")
    page.locator(".st-key-figure_built_u .main-svg").first.wait_for()
    assert set(traces(page, "built_u")) >= NAMES | {"u max"}
    highest.fill("")
    highest.press("Enter")
    expect(page.get_by_text("As built:")).to_have_count(0)
    page.wait_for_url(lambda url: "u_max" not in url)


def test_every_view_says_that_the_loop_as_built_is_another(server, open_page):
    page = open_page(server + LIMITED)
    for view in ("Live", "Bode of L", "Model error", "Compare", "As built"):
        page.get_by_role("tab", name=view).click()
        expect(page.get_by_role("tab", name=view)).to_have_attribute("aria-selected", "true")
        idle(page)
        box = page.locator(".st-key-mark_wide").bounding_box()
        assert 0 < box["y"] < 300
    page.get_by_role("tab", name="Live").click()
    idle(page)
    picture(page, "actuator-mark")
    page.get_by_role("button", name="Open the loop as built").click()
    idle(page)
    expect(page.get_by_role("textbox", name="Highest u")).to_have_value("1.1")


@pytest.mark.parametrize("width", [1280, 390])
def test_the_view_fits_and_reads_well(width, server, open_page):
    page = open_page(f"{server}{LIMITED}&noise=0.01&sampling=0.5", width)
    expect(page.locator(".st-key-mark_" + ("wide" if width == 1280 else "narrow"))).to_be_visible()
    page.get_by_role("tab", name="As built").click()
    idle(page)
    page.locator(".st-key-figure_built_u .main-svg").first.wait_for()
    page.locator(".strip.built").scroll_into_view_if_needed()
    for _ in both_themes(page):
        assert fits(page)
        picture(page, "actuator")
    if width == 1280:
        box = page.locator(".st-key-figure_built_u").bounding_box()
        assert box["y"] + box["height"] <= 900
