"""On A4 a page keeps all its panels and its link and loses what can only be pressed; in a course page it fits."""

import re

import pytest
from playwright.sync_api import expect

from tests.browser.tools import drawn, fits, idle, picture

PLANT = "plant=exp(-3s)/((6s%2B1)(4s%2B1)(2s%2B1))"
WIDTH = 703  # px of A4 between margins of 12 mm
PAPER_HIDES = ("[data-testid=stSidebar]", "[data-testid=stHeader]", ".st-key-chain", ".modebar-container")
# Figures that end beyond the sheet, and canvases that are wider than the box they are in.
CUT = """width => [...document.querySelectorAll('[data-testid=stMain] *')]
    .flatMap(e => e.shadowRoot ? [...e.shadowRoot.querySelectorAll('canvas')] : e.matches('.main-svg') ? [e] : [])
    .filter(e => e.checkVisibility())
    .map(e => [e.getBoundingClientRect(), (e.closest('.plot') ?? e).getBoundingClientRect()])
    .filter(([own, box]) => own.right > width + 1 || own.width > box.width + 1)
    .map(([own]) => own.right)"""


@pytest.mark.parametrize(("place", "panels"), [("tuning", 4), ("half_rule", 2), ("tuning?view=figures", 4)])
def test_a_page_on_a4_has_all_panels_and_its_link_and_cuts_nothing(place, panels, server, open_page):
    page = open_page(f"{server}/{place}{'&' if '?' in place else '?'}{PLANT}")
    drawn(page)
    expect(page.locator(".st-key-on_paper")).to_be_hidden()
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    page.emulate_media(media="print")
    page.set_viewport_size({"width": WIDTH, "height": 1000})
    expect(page.locator(".st-key-on_paper")).to_contain_text(
        re.compile(r"/(tuning|half_rule)\?plant=.*\d{4}-\d\d-\d\d", re.S)
    )
    for hidden in PAPER_HIDES:
        expect(page.locator(hidden).first).to_be_hidden()
    assert page.locator("figure:visible canvas, .js-plotly-plot:visible > div").count() >= panels
    assert page.evaluate(CUT, WIDTH) == []
    picture(page, f"paper-{place.split('?')[0]}-{panels}")
    page.emulate_media(media="screen")
    page.evaluate("dispatchEvent(new Event('afterprint'))")
    pdf = page.pdf(prefer_css_page_size=True)
    assert 1 <= len(re.findall(rb"/Type\s*/Page\b", pdf)) <= 4
    assert re.search(rb"/MediaBox\s*\[0 0 59[45]", pdf)  # A4 is 595 points wide


def test_a_course_page_has_the_slider_and_curves_in_900_by_600_and_nobody_follows_its_reader(server, open_page):
    page = open_page(f"{server}/tuning?{PLANT}&embed=true&utm_source=moodle&utm_medium=lti&fbclid=x&gclid=y")
    page.set_viewport_size({"width": 900, "height": 600})
    expect(page.locator(".live")).to_have_attribute("data-exact", re.compile("true"))
    idle(page)
    assert page.get_by_test_id("stAlert").count() == 0
    assert "utm_" not in page.url
    expect(page.get_by_test_id("stSidebar")).to_have_attribute("data-collapsed", "true")
    expect(page.locator(".st-key-line .katex").first).to_be_visible()
    track, plot = (page.locator(each).first.bounding_box() for each in (".track", "figure[data-panel=y] .plot"))
    assert track["y"] > 0
    assert plot["y"] + plot["height"] <= 600
    assert fits(page)
