"""Many loops in a browser: a file dropped, tuned beside the page, one loop opened in its tuning, files taken home."""

import csv
import re

from playwright.sync_api import expect

from tests.browser.tools import fits, idle, picture

EVIL = "<img src=x onerror=alert(1)>"
LIST = f"tag;k;theta [s];tau1;Kc;tau_I\n{EVIL};1,5;2;8,5;4;8\nFC-102;1;1;8;1;8\nFC-103;eins;1;8;1;8\n"


def test_a_list_becomes_results_becomes_a_tuning(server, open_page, tmp_path):
    path = tmp_path / "loops.csv"
    path.write_text(LIST, encoding="utf-8")
    page = open_page(f"{server}/many")
    page.locator(".st-key-stack_many input[type=file]").set_input_files(path)
    idle(page)
    main = page.get_by_test_id("stMain")
    expect(main).to_contain_text("6 columns understood")
    page.get_by_role("button", name="Tune 3 loops").click()
    expect(main).to_contain_text("3 loops, 2 tuned, 1 refused", timeout=60_000)
    idle(page)
    with page.expect_download() as download:
        page.get_by_role("button", name="Results").click()
    with open(download.value.path(), encoding="utf-8", newline="") as file:
        lines = list(csv.DictReader(file))
    assert [line["tag"] for line in lines] == [EVIL, "FC-102", "FC-103"]
    with page.expect_download() as download:
        page.get_by_role("button", name="Report").click()
    assert EVIL not in download.value.path().read_text(encoding="utf-8")
    picture(page, "many-results")
    page.get_by_label("Tag contains").fill("102")
    page.get_by_label("Tag contains").press("Enter")
    idle(page)
    table = page.locator("[data-testid=stDataFrame]").last
    box = table.bounding_box()
    page.mouse.click(box["x"] + 15, box["y"] + 52)
    idle(page)
    page.get_by_role("button", name="Open on the tuning page").click()
    page.wait_for_url(re.compile("/tuning"))
    idle(page)
    expect(page).to_have_url(re.compile("tag=FC-102"))
    expect(page.get_by_role("group", name="Settings")).to_contain_text("4")
    page.go_back()
    idle(page)
    expect(main).to_contain_text("3 loops, 2 tuned, 1 refused")


def test_the_example_on_a_phone(server, open_page):
    page = open_page(f"{server}/many", 390)
    page.get_by_role("button", name="Try an example").click()
    expect(page.get_by_test_id("stMain")).to_contain_text("62 loops, 60 tuned", timeout=60_000)
    idle(page)
    picture(page, "many-example-390")
    assert fits(page)
