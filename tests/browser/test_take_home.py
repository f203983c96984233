"""Taking a loop home in a browser: what only the browser makes."""

from PIL import Image

from tests.browser.tools import idle

DESIGN = "plant=exp(-s)/((10s%2B1)(3s%2B1))&order=2&filter=0.125&unit=s&box=deltav_series&tag=TIC-101"
WHITE = (255, 255, 255)


def test_the_figures_are_saved_as_a_picture_with_its_letters(server, open_page):
    """Three times the size of the SVG, letters in its head, and curves in the colours of y and u."""
    page = open_page(f"{server}/take_home?{DESIGN}")
    page.get_by_role("tab", name="Report").click()
    idle(page)
    with page.expect_download() as download:
        page.get_by_role("button", name="Figures as PNG").click()
    assert download.value.suggested_filename == "TIC_101.png"
    picture = Image.open(download.value.path()).convert("RGB")
    assert picture.width == 2040
    head = picture.crop((0, 0, 2040, 3 * 14))
    assert len(head.getcolors(1 << 20)) > 20  # letters have soft edges
    colours = {colour for _, colour in picture.getcolors(1 << 20)}
    assert WHITE in colours
    assert any(b > r + 80 for r, _, b in colours)
    assert any(r > b + 80 for r, _, b in colours)
