"""Typing and pasting numbers and plants in a real browser of three countries: every number is the one typed."""

from collections.abc import Callable
from urllib.parse import parse_qs, urlencode, urlsplit

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser.tools import idle

LOCALES = ("de-DE", "en-US", "cs-CZ")
PLANT = "2 exp(-3 s)/((20 s + 1) (4 s + 1))"
PRINTED = "                2\n  exp(-3*s) * -------\n              5 s + 1\n"  # as a program prints it, three lines


@pytest.fixture(params=[pytest.param(locale, marks=pytest.mark.xdist_group(locale)) for locale in LOCALES])
def opened(request, server, open_page) -> Callable[[str], Page]:
    """opened(place): the example on this page in a browser that is set to this country.

    One worker has all tests of a country: a tab of another country must load and compile everything for itself.
    """

    def start(place: str) -> Page:
        page = open_page(f"{server}/{place}?" + urlencode({"plant": PLANT}), locale=request.param)
        page.context.grant_permissions(["clipboard-read", "clipboard-write"])
        return page

    return start


def field(page: Page, label: str) -> Locator:
    return page.get_by_role("textbox", name=label, exact=True)


def typed(page: Page, label: str, text: str) -> None:
    """Key by key, as a hand does it."""
    field(page, label).fill("")
    field(page, label).press_sequentially(text)
    field(page, label).press("Enter")
    idle(page)


def pasted(page: Page, label: str, text: str) -> None:
    page.evaluate("text => navigator.clipboard.writeText(text)", text)
    field(page, label).press("Control+a")
    field(page, label).press("Control+v")
    field(page, label).press("Enter")
    idle(page)


def address(page: Page) -> dict[str, str]:
    return {name: values[0] for name, values in parse_qs(urlsplit(page.url).query).items()}


def test_numbers_typed_and_pasted_on_the_tuning_page(opened):
    page = opened("tuning")
    for how, text, meant in (
        (typed, "2,75", "2.75"),
        (typed, "11/5", "2.2"),
        (typed, "0.5", "0.5"),
        (pasted, "1\u202f200", "1200"),
        (pasted, "0,75", "0.75"),
    ):
        how(page, "τc, exact", text)
        expect(field(page, "τc, exact")).to_have_value(text)
        assert address(page)["tau_c"] == meant
    typed(page, "τc, exact", "1,234")
    expect(page.get_by_text("0.75 stays in use")).to_be_visible()
    assert address(page)["tau_c"] == "0.75"
    typed(page, "τc, exact", "0,8")
    expect(page.get_by_text("stays in use")).to_have_count(0)
    typed(page, "b", "0,6")
    assert address(page) | {"tau_c": "0.8", "b": "0.6"} == address(page)


def test_the_smallest_tau_c_for_an_Ms_is_typed_with_a_comma(opened):
    page = opened("tuning")
    typed(page, "Fastest tau_c with Ms up to", "1,5")
    with_comma = address(page)["tau_c"]
    typed(page, "Fastest tau_c with Ms up to", "1.5")
    assert address(page)["tau_c"] == with_comma
    typed(page, "Fastest tau_c with Ms up to", "1,500")
    expect(page.get_by_text("can be read in two ways")).to_be_visible()


def test_plants_typed_and_pasted(opened):
    page = opened("plant")
    for text, words in (
        ("2,5 e^{-0,75s}/(12 500s+1)", "gain 2.5, lag 12500, dead time 0.75"),
        (PRINTED, "gain 2, lag 5, dead time 3"),
        ("G_{a1} = \\frac{2e^{-2s}}{5s+1}", "gain 2, lag 5, dead time 2"),
    ):
        pasted(page, "Transfer function", text)
        expect(page.get_by_text(f"Read: {words}.")).to_be_visible()
    pasted(page, "Transfer function", "\\frob{2}/(5s+1)")
    expect(page.get_by_test_id("stAlert")).to_contain_text("\\frob{2}/(5s+1)")
    page.get_by_role("radio", name="Factors").click()
    idle(page)
    typed(page, "Gain k", "−0,5")
    pasted(page, "Dead time θ", "2,75")
    assert address(page)["plant"] == "-0.5 exp(-2.75 s)/(5 s + 1)"
