"""By ear, by keyboard, on both themes: axe-core (node_modules/axe-core, no network), headings, focus, tab stops."""

import pytest
from playwright.sync_api import Page, expect

from tests.browser.test_headers import PAGES
from tests.browser.tools import ROOT, drawn, idle, wait_until

AXE = ROOT / "node_modules" / "axe-core" / "axe.min.js"
# What Streamlit 1.67 itself does wrong, rule -> selectors of its elements; nothing of ours may be added.
STREAMLITS = {
    # The groups of st.navigation are div between ul and li: structure of its pages, streamlit/streamlit#8399
    "list": ["[data-testid=stSidebarNavItems]"],
    "listitem": ["[data-testid=stSidebarNav] li"],
    # Takes the focus, has a name and no role: streamlit/streamlit#15921
    "presentation-role-conflict": ["[data-testid=stFileUploaderDropzone]"],
}
FAULTS = """async ([known, rules]) => {
    const options = rules ? {runOnly: rules} : {};
    const {violations} = await axe.run(document, {...options, resultTypes: ['violations']});
    const found = target => target.flat().reduce((root, one) => (root.shadowRoot ?? root).querySelector(one), document);
    return violations.flatMap(({id, nodes}) => nodes
        .filter(({target}) => !(known[id] ?? []).some(of => found(target).matches(of)))
        .map(({html, failureSummary}) => `${id}: ${html.slice(0, 200)} ${failureSummary}`));
}"""
# Names of what can be used or heads something, with signs that only LaTeX has.
NAMED = "[aria-label], [alt], button, label, th, [role=tab], [role=radio], h1, h2, h3"
LATEX = r"""named => [...document.querySelectorAll(named)]
    .map(e => e.getAttribute('aria-label') ?? e.getAttribute('alt') ?? e.querySelector('annotation')?.textContent ?? '')
    .filter(name => /[$\\]|[_^]\{/.test(name))"""
FOCUSED = """() => {
    let here = document.activeElement;
    while (here.shadowRoot?.activeElement) here = here.shadowRoot.activeElement;
    return here;
}"""
# How it looks with the focus, and without.
LOOKS = """async here => {
    const look = () => [here, here.parentElement, here.parentElement?.parentElement].filter(Boolean).map(box => {
        const {outlineStyle, outlineColor, boxShadow, borderColor} = getComputedStyle(box);
        return [outlineStyle === 'none' ? '' : outlineColor, boxShadow, borderColor].join();
    }).join(';');
    const settled = () => new Promise(done => setTimeout(done, 30));
    await settled();
    const seen = look();
    here.blur();
    await settled();
    const unfocused = look();
    here.focus({focusVisible: true});
    return [seen, unfocused];
}"""
WITHOUT_FIGURES = ("", "take_home", "many", "lessons", "accuracy", "sources")
PLANT = "plant=exp(-3s)/((6s%2B1)(4s%2B1)(2s%2B1))"


def faults(page: Page, rules: list[str] | None = None) -> list[str]:
    drawn(page)
    if not page.evaluate("'axe' in globalThis"):
        page.evaluate(AXE.read_text())
    return page.evaluate(FAULTS, [STREAMLITS, rules])


@pytest.mark.parametrize("place", PAGES)
def test_every_page_and_every_tab_is_for_everyone_and_keeps_to_the_policy(place, server, open_page):
    """What the policy of our answers forbids becomes an error of the console, which fails the test."""
    page = open_page(f"{server}/{place}")
    if place not in WITHOUT_FIGURES:
        expect(page.locator(".js-plotly-plot, .live").first).to_be_attached()
    for tab in page.get_by_role("tab").all() or [None]:
        if tab:
            tab.click()
            idle(page)
        assert faults(page) == []
        assert page.evaluate(LATEX, NAMED) == []
        assert page.locator("h1").count() >= 1
    page.emulate_media(color_scheme="dark")
    idle(page)
    assert faults(page, ["color-contrast"]) == []


def test_the_keyboard_comes_to_the_slider_soon_and_is_seen_all_the_way(server, open_page):
    page = open_page(f"{server}/tuning?{PLANT}")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    assert page.evaluate_handle(FOCUSED).get_attribute("role") == "slider"
    page.reload()
    idle(page)
    wait_until(page, lambda: page.locator(".skip_to_slider").count() == 1, "the slider is there")
    unseen = []
    for stop in range(60):
        page.keyboard.press("Tab")
        here = page.evaluate_handle(FOCUSED).as_element()
        name = here.evaluate("here => `${here.tagName} ${here.ariaLabel ?? here.innerText.slice(0, 30)}`")
        seen, unfocused = here.evaluate(LOOKS)
        if seen == unfocused and stop and not name.startswith("MAIN"):  # ours shows itself; where Streamlit's own leads
            unseen.append((stop, name))
    assert not unseen, unseen
