"""Nothing is cut, on every page at every usual width: a projector, a zoomed laptop, a large screen, a phone."""

import pytest

from tests.browser.tools import fits, idle

WIDTHS = {1280: 900, 1024: 768, 853: 600, 1920: 1080, 390: 844}
PAGES = (
    "",
    "plant",
    "half_rule",
    "tuning",
    "cascade",
    "take_home?box=honeywell_udc",
    "accuracy",
    "from_data",
    "lessons?lesson=V1&step=3",
)
SITE = "unit=min&PV_unit=%C2%B0C&OP_unit=%25"
# Words that are wider than their place, and switches that end beyond the place they are in.
CUT = """() => {
    const roots = [document, ...[...document.querySelectorAll('*')].map(e => e.shadowRoot).filter(Boolean)];
    const all = selector => roots.flatMap(root => [...root.querySelectorAll(selector)]).filter(e => e.clientWidth);
    const names = ['button', 'small', '.settings', '.now', '[data-testid=stMain] [data-testid=stWidgetLabel]', 'h2'];
    const wide = all(names.join(', ')).filter(e => e.scrollWidth > e.clientWidth + 1);
    const beyond = all('[data-testid=stMain] [data-testid=stButtonGroup] button').filter(button => {
        const place = button.closest('[data-testid=stElementContainer]').getBoundingClientRect();
        return button.getBoundingClientRect().right > place.right + 1;
    });
    return [...wide, ...beyond].map(e => `${e.tagName} ${e.className}: ${e.innerText || e.title}`);
}"""


@pytest.mark.parametrize("place", PAGES)
def test_nothing_is_cut(place, server, open_page):
    page = open_page(f"{server}/{place}{'&' if '?' in place else '?'}{SITE}")
    for width, height in WIDTHS.items():
        page.set_viewport_size({"width": width, "height": height})
        page.wait_for_timeout(500)
        idle(page)
        assert fits(page), width
        assert page.evaluate(CUT) == [], width
