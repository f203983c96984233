"""Another language in the browser: what the scripts say and show, and the choice of it."""

import re

from playwright.sync_api import Page, expect

from tests.browser.test_live import at_rest
from tests.browser.tools import ROOT, Server, choose, idle
from tests.pages.wrapped import BRACKETS, SYMBOLS, WORD, outside

# All that an instrument shows or a screen reader says of it: one piece each.
TEXTS = """root => {
    const copy = root.cloneNode(true);
    for (const index of copy.querySelectorAll('sub')) index.replaceWith(index.textContent);
    copy.normalize();
    return [...copy.querySelectorAll('*')].flatMap(element => [
        ...[...element.childNodes].filter(node => node.nodeType === 3).map(node => node.data),
        ...['title', 'aria-label', 'aria-valuetext', 'aria-roledescription'].map(name => element.getAttribute(name)),
    ]).filter(Boolean);
}"""


def left_in_english(page: Page) -> list[str]:
    """What stands outside brackets and is no symbol, or has a decimal point."""
    texts = page.locator(".live").evaluate(TEXTS)
    assert len(texts) > 50
    return [
        text
        for text in texts
        if any(word not in {*SYMBOLS, "PNG"} for word in WORD.findall(outside(text))) or re.search(r"\d\.\d", text)
    ]


def test_instruments_speak_the_language_that_is_chosen(open_page):
    server = Server(ROOT / "tests" / "browser" / "in_brackets.py")
    try:
        page = open_page(f"{server.url}/tuning?tau_c=3.5&plant=exp(-s)/(8.5s%2B1)")
        at_rest(page)
        expect(page.locator("html")).to_have_attribute("lang", "en")
        for field, typed in (("b", "0.5"), ("τF/τD", "0.1 0")):
            page.get_by_role("textbox", name=field, exact=True).fill(typed)
            page.keyboard.press("Enter")
            idle(page)
        at_rest(page)
        choose(page, page.get_by_role("combobox", name="Language"), "in brackets")
        expect(page.locator("html")).to_have_attribute("lang", BRACKETS)
        expect(page.locator(".live")).to_have_count(1)
        expect(page.locator(".live .more")).to_have_text("⟦All numbers⟧")
        at_rest(page)
        assert left_in_english(page) == []
        expect(page.get_by_role("slider", name="tau_c")).to_have_attribute("aria-valuetext", "⟦3,5, 3,5 times theta⟧")
        expect(page.locator(".st-key-widget_b input")).to_have_value("0,5")  # what is good is told anew
        expect(page.locator(".st-key-widget_filter input")).to_have_value("0.1 0")  # what is not stays as typed
        assert re.search("tau_c=3.5.*b=0.5.*lang=xx", page.url)
        page.get_by_role("button", name="⟦Trade-off⟧").click()
        assert left_in_english(page) == []
        page.goto(f"{server.url}/cascade?lang={BRACKETS}")
        idle(page)
        at_rest(page)
        assert left_in_english(page) == []
        page.get_by_role("tab", name="⟦Settings⟧").click()
        idle(page)
        choose(page, page.get_by_role("combobox", name="⟦Language⟧"), "English")
        expect(page.get_by_role("tab", name="Settings", exact=True)).to_have_attribute("aria-selected", "true")
        expect(page.locator("html")).to_have_attribute("lang", "en")
    finally:
        server.stop()
