"""The lecture view: readable from the last row at every size, what is hidden stays hidden, a link opens it."""

import json
import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.tools import drawn, fits, frames, idle, picture, wait_until

EXAMPLE = "plant=exp(-3s)/((6s%2B1)(4s%2B1)(2s%2B1))"  # [V06] example 1
SIZES = ((1920, 1080), (1366, 768), (1280, 720), (1024, 768), (860, 560))
# Sizes of letters in sight, in px as they are on the screen, and where the plots end.
SEEN = """stage => {
    const own = e => [...e.childNodes].some(node => node.nodeType === 3 && node.textContent.trim());
    const letters = [...stage.querySelectorAll('*')].filter(e => e.checkVisibility() && own(e)
        && !e.closest('annotation, .spoken, .keys') && e.getBoundingClientRect().width > 1);
    const plots = [...stage.querySelectorAll('.plot')].filter(e => e.checkVisibility());
    return {
        letters: letters.map(e => [parseFloat(getComputedStyle(e).fontSize), e.textContent.slice(0, 20)]),
        plots: plots.map(e => e.getBoundingClientRect()).map(({width, height, bottom}) => [width, height, bottom]),
        handle: stage.querySelector('.handle').getBoundingClientRect().width,
        scrolls: stage.scrollHeight > stage.clientHeight + 1 || stage.scrollWidth > stage.clientWidth + 1,
    };
}"""
TYPE = "stage => parseFloat(getComputedStyle(stage).fontSize)"
# The focus is in the dialog, or with the browser itself.
INSIDE = (
    """(({activeElement: here}) => here === document.body || !!here.shadowRoot?.querySelector('dialog'))(document)"""
)
INK = """plot => {
    const {data} = plot.getContext('2d').getImageData(0, 0, plot.width, plot.height);
    let blue = 0;
    for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 200 && data[i + 2] > data[i] + 100) blue += 1;
    return blue;
}"""


def stage(page: Page):
    return page.locator("dialog.hall")


def at_rest(page: Page) -> None:
    expect(page.locator(".live")).to_have_attribute("data-exact", re.compile("true"))


def lecture(open_page, server, more="", place="tuning") -> Page:
    page = open_page(f"{server}/{place}?{EXAMPLE}{more}&lecture=1")
    expect(stage(page)).to_be_visible()
    at_rest(page)
    return page


@pytest.mark.parametrize("place", ["tuning", "cascade"])
def test_letters_are_as_large_as_the_last_row_needs_and_all_fits(place, server, open_page):
    """28 px at 1920 x 1080, in proportion on a smaller projector, 14 px at the least."""
    page = lecture(open_page, server, place=place)
    expect(stage(page).locator(".told math").first).to_be_visible()
    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        least = max(14.0, 28 * min(width / 1920, height / 1080))
        wait_until(page, lambda: abs(stage(page).evaluate(TYPE) - least) < 0.01, "it fits anew")  # noqa: B023
        frames(page)
        seen = stage(page).evaluate(SEEN)
        small = [each for each in seen["letters"] if each[0] < least * 0.999]
        assert not small, (width, small)
        assert not seen["scrolls"], width
        assert page.locator(".hall [data-figure]:visible").count() == 4
        assert seen["handle"] >= 1.3 * least
        assert len(seen["plots"]) == (1 if (width, height) == SIZES[-1] else 4)
        for across, high, bottom in seen["plots"]:
            assert across > 0.4 * width
            assert high > 0.2 * height
            assert bottom <= height + 1
        picture(page, f"lecture-{place}")


def test_it_is_modal_and_escape_leaves_it(server, open_page):
    page = lecture(open_page, server)
    for _ in range(30):
        page.keyboard.press("Tab")
        assert page.evaluate(INSIDE)
    page.keyboard.press("Escape")
    expect(stage(page)).to_have_count(0)
    assert (
        page.evaluate(
            "(() => { let e = document.activeElement; while (e.shadowRoot) e = e.shadowRoot.activeElement;"
            " return e.className; })()"
        )
        == "lecture"
    )


def test_h_hides_and_reveals_numbers_curves_and_the_future(server, open_page):
    page = lecture(open_page, server, "&panel=y")
    number = page.locator("[data-figure=Ms] b")
    plot = page.locator("figure[data-panel=y] canvas")
    whole = plot.evaluate(INK)
    assert whole > 500
    slider = page.get_by_role("slider")
    slider.press("h")
    expect(number).to_be_hidden()
    assert plot.evaluate(INK) == whole
    assert "1.62" not in page.locator("figure[data-panel=y] .plot").get_attribute("aria-label")
    slider.press("h")
    expect(number).to_be_visible()
    page.get_by_role("button", name="curves", exact=True).click()
    expect(number).to_be_hidden()
    assert plot.evaluate(INK) < 0.05 * whole
    page.get_by_role("button", name="future", exact=True).click()
    assert 0.2 * whole < plot.evaluate(INK) < 0.8 * whole
    slider.press("h")
    assert plot.evaluate(INK) == whole


def test_a_movement_leaves_a_ghost_and_return_brings_it_back(server, open_page):
    page = lecture(open_page, server)
    slider = page.get_by_role("slider")
    begun = slider.get_attribute("aria-valuenow")
    slider.press("2")
    at_rest(page)
    idle(page)
    moved = slider.get_attribute("aria-valuenow")
    assert moved != begun
    slider.press("r")
    expect(slider).to_have_attribute("aria-valuenow", begun)
    at_rest(page)
    slider.press(" ")
    wait_until(page, lambda: slider.get_attribute("aria-valuenow") != begun, "the sweep has begun")
    slider.press(" ")
    at_rest(page)  # it stays where it is, with exact numbers
    assert slider.get_attribute("aria-valuenow") != begun


def test_one_crosshair_goes_through_all_panels(server, open_page):
    page = open_page(f"{server}/tuning?{EXAMPLE}")
    at_rest(page)
    box = page.locator("figure[data-panel=sensitivity] .u-over").bounding_box()
    page.mouse.move(box["x"] + 0.4 * box["width"], box["y"] + 0.5 * box["height"])
    expect(page.locator("figure[data-panel=nyquist] .dot")).to_have_count(1)
    expect(page.locator("figure[data-panel=y] .cross")).to_have_count(0)
    box = page.locator("figure[data-panel=y] .u-over").bounding_box()
    page.mouse.move(box["x"] + 0.25 * box["width"], box["y"] + 0.5 * box["height"])
    for panel in ("y", "u"):
        line = page.locator(f"figure[data-panel={panel}] .cross")
        assert float(line.evaluate("e => parseFloat(e.style.left) / e.parentElement.clientWidth")) == pytest.approx(
            0.25, abs=0.01
        )
    expect(page.locator("figure[data-panel=nyquist] .dot")).to_have_count(0)


def test_its_link_opens_the_same_view_and_comes_as_a_code(server, open_page):
    page = lecture(open_page, server, "&panel=nyquist")
    expect(page.locator("figure[data-panel=nyquist]")).to_be_visible()
    expect(page.locator("figure[data-panel=y]")).to_be_hidden()
    page.get_by_role("slider").press("q")
    code = page.locator(".card img")
    expect(code).to_be_visible()
    link = page.locator(".card div").inner_text()
    assert re.search(r"[?&]plant=.*&view=responses&panel=nyquist&lecture=1$", link)
    assert code.evaluate("image => image.decode().then(() => image.naturalWidth > 0)")
    assert json.dumps(link).count("127.0.0.1") == 1


def test_a_page_without_an_instrument_is_for_the_last_row_too_and_tells_step_by_step(server, open_page):
    """Figures have 28 px; the half rule comes line by line; H hides curves; Esc leaves."""
    page = open_page(f"{server}/half_rule?{EXAMPLE}&lecture=1")
    drawn(page)
    expect(page.get_by_test_id("stSidebar")).to_be_hidden()
    assert fits(page)
    sizes = page.locator(".js-plotly-plot:visible text").evaluate_all(
        "texts => texts.filter(t => t.textContent).map(t => parseFloat(getComputedStyle(t).fontSize))"
    )
    assert min(sizes) >= 28
    steps = page.locator(".st-key-story li")
    expect(steps.nth(0)).to_be_visible()
    expect(steps.nth(1)).to_be_hidden()
    page.keyboard.press("ArrowRight")
    expect(steps.nth(1)).to_be_visible()
    expect(steps.nth(2)).to_be_hidden()
    curves = page.locator(".scatterlayer").first
    page.keyboard.press("h")
    expect(curves).to_be_hidden()
    page.keyboard.press("h")
    expect(curves).to_be_visible()
    picture(page, "lecture-half-rule")
    page.keyboard.press("Escape")
    expect(page.get_by_test_id("stSidebar")).to_be_visible()
    expect(steps.last).to_be_visible()


def test_a_link_shows_one_figure_of_a_page_alone(server, open_page):
    page = open_page(f"{server}/plant?{EXAMPLE}&panel=plant_bode&lecture=1")
    drawn(page)
    expect(page.locator(".js-plotly-plot:visible")).to_have_count(1)
    expect(page.get_by_label("Transfer function", exact=True)).to_be_hidden()
