"""Rules page in Chromium: the table and both pictures at a glance, a click on either picks a rule."""

import math

import pytest
from playwright.sync_api import Page, expect

from tests.browser.tools import fits, frames, idle, picture

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
    at_rest(page)
    assert fits(page)
    page.locator(".live").scroll_into_view_if_needed()
    assert page.locator(".live figure:visible").count() == (3 if width == 1280 else 2)
    picture(page, "rules-plane")


def at_rest(page: Page) -> None:
    expect(page.locator(".live.plane")).to_have_attribute("data-exact", "true")


def middle(page: Page) -> tuple[float, float]:
    box = page.locator(".point").bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def settings(page: Page) -> list[float]:
    """Kc and tau_I where the knobs are."""
    knobs = [page.get_by_role("slider", name=name) for name in ("Controller gain Kc", "Integral time tau_I")]
    return [float(knob.get_attribute("aria-valuenow")) for knob in knobs]


def released(page: Page, own: str) -> None:
    """The design holds what was released, and the numbers are exact."""
    page.wait_for_url(f"**own=ideal~{own}~*controller=own*")
    at_rest(page)


def test_my_settings_are_a_point_that_is_dragged_and_the_responses_follow(server, open_page):
    page = open_page(f"{server}/rules?{LAG}&view=plane")
    at_rest(page)
    page.locator(".live").scroll_into_view_if_needed()
    x, y = middle(page)
    assert settings(page) == [4, 8]
    page.mouse.move(x, y)
    page.mouse.down()
    peaks = set()
    for step in range(8):
        page.mouse.move(x + 8 * step, y + 6 * step)
        frames(page)
        peaks.add(page.locator("[data-figure=Ms] b").inner_text())
    assert len(peaks) > 5  # the figures follow, and nobody was asked
    assert page.locator(".live").get_attribute("data-exact") == "false"
    assert middle(page) == pytest.approx((x + 56, y + 42), abs=2)
    page.mouse.up()
    Kc, tau_I = settings(page)
    assert Kc > 4.5
    assert tau_I < 7
    released(page, f"{Kc:g}~{tau_I:g}")
    assert middle(page) == pytest.approx((x + 56, y + 42), abs=2)  # it stays where it was left


def test_the_point_moves_by_keys(server, open_page):
    page = open_page(f"{server}/rules?{LAG}&view=plane")
    at_rest(page)
    for key in ("ArrowRight", "ArrowDown", "ArrowDown"):
        page.locator(".point").press(key)
    released(page, f"{4 * 10 ** (1 / 40):.3g}~{8 * 10 ** (-2 / 40):.3g}")
    assert "Kc = 4.24" in page.locator(".point").get_attribute("aria-valuetext")


def test_a_finger_drags_the_point_on_a_phone(server, open_page):
    page = open_page(f"{server}/rules?{LAG}&view=plane", 390, touch=True)
    at_rest(page)
    page.locator(".live figure[data-panel=plane]").scroll_into_view_if_needed()
    x, y = middle(page)
    finger = page.context.new_cdp_session(page)
    for kind, points in (
        ("touchStart", [{"x": x, "y": y}]),
        *(("touchMove", [{"x": x + step, "y": y + 2 * step}]) for step in range(4, 25, 4)),
        ("touchEnd", []),
    ):
        finger.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        frames(page)
    Kc, tau_I = settings(page)
    assert Kc > 4.1
    assert tau_I < 7
    released(page, f"{Kc:g}~{tau_I:g}")
    assert middle(page) == pytest.approx((x + 24, y + 48), abs=2)  # the page has not moved under the finger


def place(page: Page, Kc: float, tau_I: float) -> tuple[float, float]:
    """Where that is on the screen: both axes are logarithmic, and end where the knobs do."""
    box = page.locator(".live figure[data-panel=plane] .u-over").bounding_box()
    shares = []
    for name, value in (("Controller gain Kc", Kc), ("Integral time tau_I", tau_I)):
        knob = page.get_by_role("slider", name=name)
        low, high = (float(knob.get_attribute(f"aria-value{end}")) for end in ("min", "max"))
        shares.append(math.log(value / low) / math.log(high / low))
    return box["x"] + shares[0] * box["width"], box["y"] + (1 - shares[1]) * box["height"]


def test_a_click_in_the_plane_picks_a_rule(server, open_page):
    page = open_page(f"{server}/rules?{LAG}&view=plane")
    at_rest(page)
    page.locator(".live").scroll_into_view_if_needed()
    assert place(page, 4, 8) == pytest.approx(middle(page), abs=1.5)
    page.mouse.click(*place(page, 2.160, 5.332))  # AMIGO
    page.wait_for_url("**compared_rule=amigo-PI*")
    expect(page.locator("p", has_text="AMIGO, PI, [AH04]")).to_be_visible()
    assert settings(page) == [4, 8]


def test_another_plant_is_a_question_and_leaves_the_design(server, open_page):
    page = open_page(f"{server}/rules?{LAG}&view=plane&compared_plant=integrating")
    at_rest(page)
    expect(page.get_by_text("not that of the design, which stays")).to_be_visible()
    page.locator(".point").focus()
    page.keyboard.press("ArrowRight")
    expect(page.locator(".live.plane")).to_have_attribute("data-exact", "false")
    at_rest(page)
    assert settings(page) == [0.53, 8]
    assert "controller=own" not in page.url


def test_a_click_in_the_picture_and_a_row_of_the_table_pick_a_rule(server, open_page):
    page = open_page(f"{server}/rules?{LAG}")
    expect(page.locator(".st-key-figure_rules_trade_off .main-svg").first).to_be_visible()
    page.locator(".st-key-figure_rules_trade_off").scroll_into_view_if_needed()
    page.mouse.move(*page.evaluate(POINT, "AMIGO, PI"))
    page.mouse.click(*page.evaluate(POINT, "AMIGO, PI"))
    expect(page.locator("p", has_text="AMIGO, PI, [AH04]")).to_be_visible()
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
