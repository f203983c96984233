"""From the facts of a step test to settings, by a link to the same on another screen, and ink one can read."""

import re

from playwright.sync_api import expect

from tests.browser.tools import fits, idle, picture

FACTS = {
    "Change of OP [%]": "5",
    "Change of PV, to its new rest [°C]": "-11",
    "Dead time θ [min]": "0,5",
    "Time to 63 % from the step [min]": "3,5",
}
UNITS = "unit=min&PV_unit=%C2%B0C&OP_unit=%25"


def step_test(page, between) -> None:
    """The facts typed in, field by field."""
    page.get_by_text("Step test", exact=True).click()
    for label, text in FACTS.items():
        field = page.get_by_role("textbox", name=label)
        field.fill(text)
        field.press("Enter")
        between(page)
    expect(page).to_have_url(re.compile("facts=step~5~-11~0.5~3.5"))


def test_what_is_typed_while_the_page_answers_to_another_field_stays(server, open_page):
    """Fields that have just come, filled faster than any run of the page."""
    for pause in (0, 60, 120):
        step_test(open_page(f"{server}/plant?{UNITS}"), lambda page, pause=pause: page.wait_for_timeout(pause))


def test_facts_of_a_step_test_become_settings_elsewhere(server, open_page):
    page = open_page(f"{server}/plant?{UNITS}")
    step_test(page, idle)
    picture(page, "step-test")
    other = open_page(page.url.replace("/plant?", "/tuning?"), 390)
    assert fits(other)
    expect(other.get_by_role("group", name="Settings")).to_contain_text("1.364 %/°C")  # 3/(2.2 (0.5 + 0.5))
    expect(other.get_by_role("group", name="Settings")).to_contain_text("direct")


def test_words_of_figures_can_be_read_on_the_dark_theme(server, open_page):
    page = open_page(f"{server}/tuning?plant=1/(5s%2B1)&view=figures", theme="dark")
    page.locator(".js-plotly-plot .xtick text").first.wait_for()
    ink = page.locator(".js-plotly-plot .xtick text").first.evaluate("text => getComputedStyle(text).fill")
    assert min(map(int, re.findall(r"\d+", ink)[:3])) > 150, ink
