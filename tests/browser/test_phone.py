"""A phone and a tablet: what is moved and what it moves on one screen, places for fingers, nothing over a legend."""

import re
from collections.abc import Callable

import pytest
from playwright.sync_api import Page, expect

from tests.browser.tools import drawn, fits, picture, wait_until

FINGER = 44  # px
# What can be touched and is smaller than a finger: of it, or of the place around it that takes a touch for it.
SMALL = """finger => {
    const roots = [document, ...[...document.querySelectorAll('*')].map(e => e.shadowRoot).filter(Boolean)];
    const touched = 'button, a[href], [role=tab], [role=radio], summary';
    const all = roots.flatMap(root => [...root.querySelectorAll(touched)]).filter(e => !e.matches('p a'));
    const place = e => {
        const after = getComputedStyle(e, '::after');
        const {width, height} = e.getBoundingClientRect();
        return after.position === 'absolute' ? [parseFloat(after.width), parseFloat(after.height)] : [width, height];
    };
    return all.filter(e => e.checkVisibility() && e.getBoundingClientRect().width > 1
            && !e.closest('[data-testid=stSidebar], .skip_to_slider, .modebar'))
        .filter(e => place(e).some(size => size < finger - 0.5))
        .map(e => `${e.tagName} ${e.ariaLabel ?? e.innerText.slice(0, 30)} ${place(e)}`);
}"""
ALIKE = """([one, other]) => {
    const [a, b] = [one, other].map(e => e.getBoundingClientRect());
    return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}"""


@pytest.fixture
def on_a_phone(open_page, server) -> Callable[[str], Page]:
    """on_a_phone(place): a page on a phone: 390 x 844, fingers, no mouse."""
    return lambda place: open_page(f"{server}/{place}", 390, touch=True, mobile=True)


def test_the_slider_and_the_curve_it_moves_are_on_one_screen(on_a_phone):
    phone = on_a_phone("tuning")
    expect(phone.locator(".live")).to_have_attribute("data-exact", re.compile("true"))
    track, plot = (phone.locator(each).first.bounding_box() for each in (".track", "figure[data-panel=y] .plot"))
    assert track["y"] >= 0
    assert plot["y"] + plot["height"] <= 844
    assert phone.locator(".strip [data-figure]:visible").count() == 3
    picture(phone, "phone-tuning")
    phone.get_by_role("button", name="All numbers").tap()
    assert phone.locator(".strip [data-figure]:visible").count() > 8
    phone.get_by_role("button", name="All numbers").tap()
    for _ in range(4):
        pinch(phone)


def pinch(page: Page) -> None:
    """Two fingers go apart: what lies between them fills the panel, and a button says how to leave it."""
    figure = page.locator("figure[data-panel=y]")
    whole = figure.get_by_role("button", name="Reset zoom")
    expect(whole).to_be_hidden()
    box = figure.locator(".u-over").bounding_box()
    middle, high = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    touch = page.context.new_cdp_session(page)
    for kind, apart in (("touchStart", 40), ("touchMove", 80), ("touchMove", 120)):
        points = [{"x": middle + side * apart, "y": high, "id": side} for side in (-1, 1)]
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    expect(whole).to_be_visible()
    whole.tap()  # a finger that comes so soon after two others makes no click in Chromium
    expect(whole).to_be_hidden()


@pytest.mark.parametrize("place", ["tuning", "cascade", "half_rule"])
def test_what_is_touched_has_the_size_of_a_finger(place, on_a_phone):
    phone = on_a_phone(place)
    drawn(phone)
    assert phone.evaluate(SMALL, FINGER) == []
    assert fits(phone)
    if place == "half_rule":
        expect(phone.locator(".modebar-container").first).to_be_hidden()


def test_the_buttons_of_a_figure_are_never_over_its_legend(server, open_page):
    page = open_page(f"{server}/half_rule")
    drawn(page)
    for figure in page.locator(".js-plotly-plot:visible").all():
        figure.hover()
        bar, legend = (figure.locator(each).first.element_handle() for each in (".modebar", ".legend"))
        assert not page.evaluate(ALIKE, [bar, legend])


def test_a_tablet_stacks_what_has_no_room_beside_an_open_sidebar(server, open_page):
    """The window is wider than 640 px, the page in it is not."""
    page = open_page(f"{server}/tuning?view=figures")
    page.set_viewport_size({"width": 820, "height": 1180})
    wait_until(page, lambda: page.locator(".st-key-panels .js-plotly-plot:visible").count() == 1, "one panel is left")
    assert fits(page)
    picture(page, "tablet-figures")
