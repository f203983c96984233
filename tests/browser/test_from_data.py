"""From an example to a model to its tuning, with the same numbers on both pages; by keyboard and on a phone too."""

import re
from itertools import pairwise
from urllib.parse import unquote_plus

from playwright.sync_api import expect

from tests.browser.tools import fits, idle, picture


def test_an_example_becomes_a_model_becomes_a_tuning(server, open_page):
    page = open_page(f"{server}/from_data")
    page.get_by_role("combobox", name=re.compile("Or an example")).click()
    page.get_by_role("option", name="Step test, up and down").click()
    idle(page)
    model = page.get_by_role("group", name=re.compile("Parameters of the model"))
    expect(model).to_contain_text("°C/%")
    page.locator(".st-key-figure_trend .js-plotly-plot .scatterlayer").first.wait_for()
    picture(page, "from-data-step")
    k, theta, tau1 = model.locator("b").all_inner_texts()[:3]
    page.get_by_role("button", name="Tune this model").click()
    page.wait_for_url(re.compile("/tuning"))
    idle(page)
    expect(page).to_have_url(re.compile("origin=FOPDT"))
    given = dict(part.split("=", 1) for part in page.url.split("?")[1].split("&"))
    number = r"\d+\.?\d*(?:e-?\d+)?"
    found = [float(each) for each in re.findall(number, unquote_plus(given["plant"]))]
    for shown in (k, theta, tau1):
        assert min(abs(float(shown) / each - 1) for each in found if each) < 1e-3, (shown, given["plant"])
    expect(page.get_by_role("group", name="Settings")).to_contain_text("%/°C")
    page.go_back()
    idle(page)
    expect(page.get_by_role("group", name=re.compile("Parameters of the model"))).to_contain_text(k)


def test_a_file_is_uploaded_fitted_and_forgotten(server, open_page, tmp_path):
    path = tmp_path / "tank.csv"
    rows = [f"{i};{50 + 0.1 * max(0, min(i - 25, 100)):.2f};{40 if i < 20 else 45}" for i in range(120)]
    path.write_text("Zeit [s];PV [%];OP [%]\n" + "\n".join(rows))
    page = open_page(f"{server}/from_data", 390)
    page.locator(".st-key-stack_from_data input[type=file]").set_input_files(path)
    idle(page)
    expect(page.get_by_role("group", name=re.compile("Parameters of the model"))).to_be_visible()
    expect(page.get_by_test_id("stMain")).to_contain_text("tank.csv")
    assert page.get_by_test_id("stFileUploaderFile").count() == 0
    assert fits(page)


def test_a_day_of_samples_is_drawn_with_few_points(server, open_page):
    page = open_page(f"{server}/from_data?example=day")
    page.locator(".st-key-figure_trend .js-plotly-plot .scatterlayer").first.wait_for()
    drawn = page.locator(".st-key-figure_trend .js-plotly-plot")
    points = drawn.evaluate("figure => Math.max(...figure.calcdata.map(trace => trace.length))")
    assert 1000 < points <= 2000
    drawn_over(page, 0.5, 0.52)  # zooms: 2 % of 86 400 samples, every one of them
    page.get_by_role("button", name="Whole record").wait_for()
    idle(page)
    x = drawn.evaluate("figure => figure.calcdata.find(each => each[0].trace.name === 'PV').map(point => point.x)")
    assert 1400 < len(x) < 2000
    assert {round(b - a, 9) for a, b in pairwise(x)} == {1.0}
    page.get_by_role("button", name="Whole record").click()
    expect(page.get_by_role("button", name="Whole record")).to_have_count(0)


def drawn_over(page, begin: float, end: float):
    """Drag over the record, from one share of its width to another."""
    plot = page.locator(".st-key-figure_trend .nsewdrag").first
    plot.wait_for()
    box = plot.bounding_box()
    assert box
    y = box["y"] + 0.4 * box["height"]
    page.mouse.move(box["x"] + begin * box["width"], y)
    page.mouse.down()
    page.mouse.move(box["x"] + (begin + end) / 2 * box["width"], y + 5)
    page.mouse.move(box["x"] + end * box["width"], y + 5)
    page.mouse.up()


def test_a_range_is_drawn_on_the_record_to_cut_it_or_to_leave_it_out(server, open_page):
    page = open_page(f"{server}/from_data?example=step")
    page.locator(".st-key-drag_does").get_by_text("cuts to the range").click()
    idle(page)
    drawn_over(page, 0.02, 0.52)
    page.wait_for_url(re.compile("end="))
    idle(page)
    end = float(re.search(r"[?&]end=([\d.]+)", page.url)[1])
    assert abs(end - 0.52 * 699) < 40
    expect(page.get_by_test_id("stMain")).to_contain_text(re.compile(r"3\d\d samples, noise"))
    page.locator(".st-key-drag_does").get_by_text("leaves the range out").click()
    idle(page)
    drawn_over(page, 0.3, 0.4)
    page.wait_for_url(re.compile("bad="))
    low, high = (float(each) for each in re.search(r"bad=([\d.]+)~([\d.]+)", page.url.replace("%7E", "~")).groups())
    assert 20 < high - low < 120
