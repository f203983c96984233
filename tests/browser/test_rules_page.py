"""Rules page in Chromium: the table and both pictures at a glance, a click on either picks a rule."""

import pytest
from playwright.sync_api import expect

from tests.browser.tools import fits, idle, picture

LAG = "plant=exp(-s)/(8s%2B1)"
POINT = """(name) => {
    const plot = document.querySelector('.st-key-figure_rules_trade_off .js-plotly-plot');
    const layout = plot._fullLayout, box = plot.getBoundingClientRect();
    const trace = plot.data.find((each) => each.name === 'PI rules'), i = trace.text.indexOf(name);
    const at = (axis, value) => axis._offset + axis.d2p(value);
    return [box.x + at(layout.xaxis, trace.x[i]), box.y + at(layout.yaxis, trace.y[i])];
}"""


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("width", [1280, 390])
def test_table_and_pictures_stand_in_their_place(width, theme, server, open_page):
    page = open_page(f"{server}/rules?{LAG}&compared_rule=zn_step-PI", width, theme)
    expect(page.locator(".stDataFrame")).to_be_visible()
    expect(page.locator(".st-key-figure_rules_trade_off .main-svg").first).to_be_visible()
    expect(page.get_by_text("Ziegler-Nichols, step, PI").first).to_be_visible()
    assert fits(page)
    picture(page, "rules")
    page.get_by_role("radio", name="Kc and τI").or_(page.get_by_text("Kc and τI")).first.click()
    idle(page)
    expect(page.locator(".st-key-figure_rules_plane .main-svg").first).to_be_visible()
    page.locator(".st-key-figure_rules_plane").scroll_into_view_if_needed()
    picture(page, "rules-plane")


def test_a_click_in_the_picture_and_a_row_of_the_table_pick_a_rule(server, open_page):
    page = open_page(f"{server}/rules?{LAG}")
    expect(page.locator(".st-key-figure_rules_trade_off .main-svg").first).to_be_visible()
    page.locator(".st-key-figure_rules_trade_off").scroll_into_view_if_needed()
    page.mouse.move(*page.evaluate(POINT, "AMIGO, PI"))
    page.mouse.click(*page.evaluate(POINT, "AMIGO, PI"))
    expect(page.get_by_text("AMIGO, PI, AH04")).to_be_visible()
    assert "compared_rule=amigo-PI" in page.url
    idle(page)
    table = page.locator(".stDataFrame")
    table.scroll_into_view_if_needed()
    box = table.bounding_box()
    page.mouse.click(box["x"] + 15, box["y"] + 35 + 2.5 * 27)  # the third row
    expect(page.get_by_text("Lambda, PI, paper industry")).to_be_visible()
    page.get_by_role("button", name="Take over").click()
    page.wait_for_url("**/tuning?*")
    assert "controller=own" in page.url
