"""`make screenshots`: the picture in the README, made by the program itself."""

import shutil

from playwright.sync_api import sync_playwright

from tests.browser.tools import ARGS, CHROMIUM, ROOT, WIDTHS, Server, idle

PLACE = "/tuning?plant=exp(-3s)/((6s%2B1)(4s%2B1)(2s%2B1))&order=2"
WIDTH = 1280


def main() -> None:
    """Write docs/screenshot.png."""
    server = Server()
    try:
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=shutil.which(CHROMIUM), args=ARGS)
            page = browser.new_page(viewport={"width": WIDTH, "height": WIDTHS[WIDTH]})
            page.goto(server.url + PLACE)
            idle(page, settle=2.0)
            target = ROOT / "docs" / "screenshot.png"
            target.parent.mkdir(exist_ok=True)
            page.screenshot(path=target)
            print(target)
            browser.close()
    finally:
        server.stop()


if __name__ == "__main__":
    main()
