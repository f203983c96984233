"""A process engineer retunes a loop: minutes, %, decimal commas, the settings of the plant, and the link at the end."""

import re

import numpy as np
import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser.tools import PATIENCE, WIDTHS, choose, idle, picture, wait_until, watch

PLANT = "2,2 e^{-1,5s}/(12,5s+1)"  # °C per %, minutes
NOW = 0.8, 9.0  # Kc in %/°C and tau_I in min, as they are in the plant
THETA, LONGER = 1.5, 1.3
CLIPBOARD = "navigator.clipboard.readText()"


def peak(Kc: float, tau_I: float, theta: float) -> float:
    """Ms of 2.2 e^{-theta s}/(12.5 s + 1) with PI, on a grid."""
    s = 1j * np.geomspace(1e-3, 30, 400_000)
    L = 2.2 * np.exp(-theta * s) / (12.5 * s + 1) * Kc * (1 + 1 / (tau_I * s))
    return float(np.max(1 / np.abs(1 + L)))


def at_rest(page: Page) -> None:
    """Exact numbers are shown, and the column beside them is of the same design."""
    expect(page.locator(".live")).to_have_attribute("data-exact", "true")
    idle(page)
    expect(page.get_by_test_id("stMain")).not_to_have_attribute("data-moving", re.compile(""))


def figure(page: Page, name: str) -> float:
    """A number of the strip with all its digits."""
    return float(page.locator(f"[data-figure={name}]").get_attribute("title").split("\n")[0])


def typed(page: Page, field: Locator, text: str) -> None:
    field.fill(text)
    field.press("Enter")
    idle(page)


def field(page: Page, key: str) -> Locator:
    return page.locator(f".st-key-{key} input")


def everything(page: Page) -> dict[str, str]:
    """What the page says: formula, settings, strip, comparison."""
    return {
        "plant": page.locator(".st-key-line").inner_text(),
        "settings": page.locator(".settings").first.inner_text(),
        "strip": page.locator(".live .strip").inner_text(),
        "exact": str([each.get_attribute("title") for each in page.locator("[data-figure]").all()]),
        "change": page.locator(".st-key-told").inner_text(),
    }


@pytest.fixture
def engineers(chromium):
    """Pages of a German browser, each in a context of its own."""
    faults, contexts = [], []

    def start(address: str) -> Page:
        context = chromium.new_context(
            locale="de-DE",
            viewport={"width": 1280, "height": WIDTHS[1280]},
            permissions=["clipboard-read", "clipboard-write"],
        )
        contexts.append(context)
        page = context.new_page()
        page.set_default_timeout(1000 * PATIENCE)
        watch(page, faults)
        page.goto(address)
        idle(page)
        return page

    yield start
    for context in contexts:
        context.close()
    assert not faults, "\n".join(faults)


def test_the_whole_path(server, fresh_server, engineers):
    page = engineers(server)
    # the plant is pasted
    page.evaluate("text => navigator.clipboard.writeText(text)", PLANT)
    page.locator(".st-key-home_plant input").click()
    page.keyboard.press("Control+v")
    page.get_by_role("button", name="Tune", exact=True).click()
    page.wait_for_url(re.compile("/tuning"))
    at_rest(page)

    # minutes, °C and %
    page.get_by_test_id("stSidebar").get_by_text("Loop sheet").click()
    unit = page.get_by_test_id("stSidebar").get_by_role("combobox", name=re.compile("Time unit"))
    choose(page, unit, "min")
    idle(page)
    typed(page, page.get_by_label("Unit of PV"), "°C")
    typed(page, page.get_by_label("Unit of OP"), "%")
    at_rest(page)
    expect(page.locator(".settings").first).to_contain_text("%/°C")
    expect(page.locator("[data-figure=settling_setpoint]")).to_contain_text("min")
    expect(page.locator(".st-key-line")).to_contain_text("1.5 min")
    assert figure(page, "Ms") == pytest.approx(peak(12.5 / 2.2 / 3, 12.0, THETA), rel=1e-5)  # SIMC, tau_c = theta

    # what is in the plant now, beside it
    page.get_by_text("In the plant now").click()
    page.get_by_role("button", name="Enter them").click()
    idle(page)
    typed(page, field(page, "now_SeriesPid_Kc"), "0,8")
    typed(page, field(page, "now_SeriesPid_tau_I"), "9")
    at_rest(page)
    told = page.locator(".st-key-told")
    expect(told).to_contain_text(f"{peak(*NOW, THETA):.3g}")
    expect(told).to_contain_text(f"{figure(page, 'Ms'):.3g}")

    # my settings, by hand
    page.get_by_text("My settings", exact=True).click()
    idle(page)
    typed(page, field(page, "own_SeriesPid_Kc"), "1,5")
    typed(page, field(page, "own_SeriesPid_tau_I"), "11/1")
    at_rest(page)
    before = peak(1.5, 11.0, THETA)
    assert figure(page, "Ms") == pytest.approx(before, rel=1e-5)

    # the dead time grows by 30 %, and the controller is kept
    page.get_by_text("What if the plant changes").click()
    at_rest(page)
    handle = page.get_by_role("slider", name="Dead time theta")
    track = page.locator(".track", has=handle)
    low, high = (float(handle.get_attribute(name)) for name in ("aria-valuemin", "aria-valuemax"))
    box = track.bounding_box()
    x, share = box["x"], box["width"] / np.log(high / low)
    page.mouse.move(x + share * np.log(THETA / low), box["y"] + 13)
    page.mouse.down()
    for part in np.linspace(0, 1, 12):
        page.mouse.move(x + share * np.log(THETA * (1 + (LONGER - 1) * part) / low), box["y"] + 13)
        page.wait_for_timeout(20)
    page.mouse.up()
    at_rest(page)
    theta = float(handle.get_attribute("aria-valuenow"))
    assert theta == pytest.approx(LONGER * THETA, rel=0.02)
    worse = peak(1.5, 11.0, theta)
    assert figure(page, "Ms") == pytest.approx(worse, rel=1e-5)
    expect(page.get_by_test_id("stMarkdown").filter(has_text="The settings are the same")).to_contain_text(
        f"{before:.3g}"
    )
    assert field(page, "own_SeriesPid_Kc").input_value() == "1,5"
    picture(page, "engineer-what-if")
    page.get_by_role("button", name="Back to the plant").click()
    at_rest(page)
    assert figure(page, "Ms") == pytest.approx(before, rel=1e-5)
    assert float(handle.get_attribute("aria-valuenow")) == THETA

    # the comparison
    page.get_by_role("tab", name="Compare").click()
    idle(page)
    cell = page.locator("canvas [role=gridcell]")
    for Ms in (before, peak(*NOW, THETA)):
        expect(cell.filter(has_text=re.compile(f"^{Ms:.4g}$"))).to_have_count(1)
    page.get_by_role("tab", name="Live").click()
    page.get_by_text("Settings", exact=True).click()
    at_rest(page)
    mine = everything(page)

    # the link, elsewhere
    page.locator(".st-key-address_text").get_by_role("button", name="Copy").click()
    wait_until(page, lambda: page.evaluate(CLIPBOARD).startswith("http"), "the link is copied")  # the plant was there
    link = page.evaluate(CLIPBOARD)
    elsewhere = engineers(re.sub(r"^http://[^/]+", fresh_server(), link))
    at_rest(elsewhere)
    assert everything(elsewhere) == mine
    assert field(elsewhere, "own_SeriesPid_Kc").input_value() in ("1.5", "1,5")
    picture(elsewhere, "engineer-link")
