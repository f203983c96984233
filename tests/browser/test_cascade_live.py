"""The instrument of the cascade page: two sliders that move without the server, each with the other loop held."""

import re

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from simc_core import Plant, margins
from simc_core.cascade.by_simc import simc_cascade
from tests.browser.test_live import at_rest, live
from tests.browser.tools import both_themes, frames, idle, picture

PAIR_1 = "Ga=2exp(-2s)/(5s%2B1)&Gb=exp(-s)/((2s%2B1)(3s%2B1))"  # [PSB] pair 1
PAIR_6 = "Ga=2exp(-2s)/(20s%2B1)&Gb=exp(-s)/(20s-1)&method=synthesis"  # an unstable inner block


def opened(open_page, server, cascade=PAIR_1, **how) -> Page:
    page = open_page(f"{server}/cascade?{cascade}", **how)
    at_rest(page)
    return page


def handle(page: Page, loop: str):
    return live(page).get_by_role("slider", name=f"of the {loop} loop")


def row(page: Page, loop: str):
    """Slider, its value and its settings."""
    return live(page).locator(".top", has=page.get_by_role("slider", name=f"of the {loop} loop"))


def value(page: Page, loop: str) -> float:
    return float(handle(page, loop).get_attribute("aria-valuenow"))


def figure(page: Page, name: str) -> float:
    return float(page.locator(f"[data-figure={name}]").get_attribute("title").split("\n")[0])


def drag(page: Page, loop: str, start: float, end: float) -> set[str]:
    """Along the track, without letting go; what was drawn on the way."""
    box = row(page, loop).locator(".track").bounding_box()
    y, seen = box["y"] + 13, set()
    page.mouse.move(box["x"] + start * box["width"], y)
    page.mouse.down()
    for part in np.linspace(start, end, 20):
        page.mouse.move(box["x"] + part * box["width"], y)
        frames(page)
        seen.add(live(page).get_attribute("data-drawn"))
    return seen


@pytest.mark.parametrize("width", [1280, 390])
def test_pictures(server, open_page, width):
    page = opened(open_page, server, width=width)
    if width == 1280:
        box = page.locator(".field.responses").bounding_box()
        assert box["y"] + box["height"] <= 900
    else:
        live(page).evaluate("element => element.scrollIntoView()")
        assert page.locator("figure:visible").count() == 1
    for _ in both_themes(page):
        picture(page, "cascade-live")


@pytest.mark.parametrize("loop", ["inner", "outer"])
def test_a_drag_redraws_without_the_server_and_its_release_asks_once(server, open_page, loop):
    page = opened(open_page, server)
    sent = []
    page.on("websocket", lambda socket: socket.on("framesent", lambda frame: sent.append(frame)))
    page.reload()
    idle(page)  # both tables have come
    at_rest(page)
    before = len(sent)
    assert len(drag(page, loop, 0.5, 0.7)) > 8
    assert live(page).get_attribute("data-exact") == "false"
    assert page.locator("[data-figure=IAE_d2] b").inner_text() != "–"
    assert len(sent) == before
    page.mouse.up()
    at_rest(page)
    assert len(sent) > before
    idle(page)
    assert f"tau_c_{loop}={value(page, loop):g}"[:14] in page.url


def test_what_is_read_while_it_moves_is_what_python_says_on_release(server, open_page):
    page = opened(open_page, server)
    idle(page)
    drag(page, "inner", 0.5, 0.6)
    names = ("Ms_outer", "Ms_inner", "GM", "PM_deg", "delay_margin", "IAE_setpoint", "IAE_d1", "IAE_d2")
    expect(page.locator("[data-figure=GM]")).to_have_attribute("title", re.compile("interpolated"))
    read = [float(page.locator(f"[data-figure={name}] b").inner_text()) for name in names]
    page.mouse.up()
    at_rest(page)
    assert read == pytest.approx([figure(page, name) for name in names], rel=0.02)
    primary, secondary = Plant(2, 2, (5,)), Plant(1, 1, (2, 3))
    design = simc_cascade(primary, secondary, tau_c_inner=value(page, "inner"), inner="PID", outer="PID")
    assert figure(page, "Ms_inner") == pytest.approx(margins(design.loop.inner_loop).Ms, rel=1e-9)
    assert value(page, "outer") == pytest.approx(design.tau_c_outer)  # it follows: nobody has decided it


def test_the_outer_loop_stays_where_it_was_put(server, open_page):
    page = opened(open_page, server)
    handle(page, "outer").press("PageUp")
    at_rest(page)
    idle(page)
    outer = value(page, "outer")
    handle(page, "inner").press("PageUp")
    at_rest(page)
    assert value(page, "outer") == pytest.approx(outer)
    assert "tau_c_outer" in page.url


def test_lambda_of_the_outer_loop_is_held_while_the_inner_one_moves(server, open_page):
    page = opened(open_page, server, PAIR_6)
    idle(page)
    outer = value(page, "outer")
    assert handle(page, "inner").get_attribute("aria-label").startswith("Time constant lambda")
    handle(page, "inner").press("ArrowRight")
    expect(live(page)).to_have_attribute("data-exact", "false")
    at_rest(page)
    idle(page)
    assert value(page, "outer") == pytest.approx(outer, rel=1e-6)


def test_keys_home_end_and_a_range_that_is_not_stable(server, open_page):
    page = opened(open_page, server, PAIR_6)
    idle(page)
    inner = handle(page, "inner")
    assert row(page, "inner").locator(".hatch").count() >= 1
    inner.press("Home")
    assert value(page, "inner") == pytest.approx(float(inner.get_attribute("aria-valuemin")))
    expect(page.locator("[data-figure=GM] b")).to_have_text("–")
    expect(page.locator("[data-figure=Ms_inner]")).to_contain_text("Not stable")
    at_rest(page)
    for name in ("Ms_outer", "Ms_inner", "GM", "IAE_d1"):
        expect(page.locator(f"[data-figure={name}] b")).to_have_text("–")
    assert row(page, "inner").locator(".hatch").count() >= 1
    picture(page, "cascade-live-unstable")
    inner.press("End")
    assert value(page, "inner") == pytest.approx(float(inner.get_attribute("aria-valuemax")))


def test_touch_moves_a_slider(server, open_page):
    page = opened(open_page, server, width=390, touch=True)
    track = row(page, "outer").locator(".track")
    track.scroll_into_view_if_needed()
    box, before = track.bounding_box(), value(page, "outer")
    page.touchscreen.tap(box["x"] + box["width"] * 0.85, box["y"] + 13)
    assert value(page, "outer") > 1.5 * before
    at_rest(page)
