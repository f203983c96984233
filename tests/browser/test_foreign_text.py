"""What Streamlit reads in a text beyond CommonMark, tried where it is read: no picture, link, formula or emoji."""

from urllib.parse import urlencode

import pytest

from pages.common.parts.refusals import AROUND
from tests.browser.tools import idle

ATTACKS = {
    "a picture": "![x](//127.0.0.1:9/a.png)",
    "a link": "[Log in](//127.0.0.1:9) https://127.0.0.1:9/ www.example.org someone@example.org",
    "html": "<img src=//127.0.0.1:9/a.png><b>x</b>",
    "formulas": "$x^2$ $$y$$ \\frac",
    "words of Streamlit": ":red[x] :smile: :material/login: a -> b",
    "a way back": "C:\\temp \\ 5",
    "backticks": "``` a `b` ``",
}
MARKUP = "img, a, .katex, svg, b, [data-testid=stIconMaterial], span[style*=color]"


@pytest.mark.parametrize("attack", ATTACKS.values(), ids=ATTACKS)
def test_a_link_shows_what_stands_in_it_and_nothing_more(server, open_page, attack):
    page = open_page(f"{server}/plant?" + urlencode({"form": attack, attack[:40]: "1"}))
    alert = page.get_by_test_id("stAlert").first
    content = alert.locator("[data-testid=stMarkdownContainer]").first
    assert content.locator(MARKUP).count() == 0
    assert attack[:40] in content.inner_text().replace("material_", "material/")  # Streamlit's own, harmless
    field = page.get_by_label("Transfer function", exact=True)
    field.fill(attack)
    field.press("Enter")
    idle(page)
    complaint = page.get_by_test_id("stAlert").last
    complaint.locator("pre").wait_for()  # Streamlit loads what shows a block of code when it is first needed
    echo = attack[:AROUND]  # the fault stands in front, and the echo is cut behind it
    assert echo in complaint.inner_text().replace("material_", "material/")
    assert complaint.locator("img, a, .katex").count() == 0
