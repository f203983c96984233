"""The report of a loop, read back: every number, every curve, and nothing in it that was typed to do harm."""

import csv
import io
import math
import re
from html.parser import HTMLParser
from xml.etree import ElementTree

import numpy as np
import pytest

from pages.common.session import links
from pages.common.studies.single import present_study
from pages.common.take_home.report.html import document, figures, picture
from pages.common.take_home.report.record import report
from pages.common.take_home.report.texts import curves_csv, markdown, settings_csv
from simc_core import BOXES, from_box
from simc_core.figures.svg import BOTTOM, HEIGHT, LEFT, RIGHT, TOP, WIDTH
from tests.pages.tools import run_page

P0 = {"plant": "exp(-s)/((10s+1)(3s+1))", "order": "2", "filter": "0.125", "unit": "s"}
FULL = P0 | {
    **{"box": "deltav_series", "sampling": "0.2", "now": "ideal~6~11~0~0~1~0", "tag": "TIC-101", "PV_unit": "°C"},
    **{"PV_low": "0", "PV_high": "200", "OP_low": "0", "OP_high": "100", "OP_unit": "%", "OP_now": "40"},
    **{"u_min": "-40", "u_max": "60", "r": "2"},
}
EVIL = "</article><script>alert(1)</script>|`[x](javascript:1)"


def made(**given):
    design, ignored = links.decode(given)
    assert not ignored
    return design, report(design, present_study(design), f"http://localhost:8501/take_home?{links.query(design)}")


class Read(HTMLParser):
    """Texts by tag and order, and all elements with their attributes."""

    def __init__(self, text):
        super().__init__()
        self.open, self.texts, self.elements = [], {}, []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        self.open.append(tag)
        if tag in ("dt", "dd", "td", "th", "li", "h1"):
            self.texts.setdefault(tag, []).append("")

    def handle_endtag(self, tag):
        while self.open and self.open.pop() != tag:
            pass

    def handle_data(self, data):
        for tag in reversed(self.open):
            if tag in self.texts:
                self.texts[tag][-1] += data
                return


def test_the_numbers_that_are_printed_make_the_controller_that_was_judged():
    """Read off the paper and typed, the box's own law gives the design: Ms 1.914, sampled 2.184 [measured apart]."""
    design, found = made(**FULL)
    read = Read(document(found))
    pairs = dict(zip(read.texts["dt"], read.texts["dd"], strict=True))
    values = {field.name: float(pairs[field.name].split()[0]) for field in BOXES["deltav_series"].fields}
    controller = from_box("deltav_series", values, pairs["action"].strip(), 200, 100)
    assert controller.Kc == pytest.approx(5, rel=1e-9)
    assert (controller.tau_I, controller.tau_D, controller.tau_F) == pytest.approx((8, 3, 0.375), rel=1e-9)
    assert float(pairs["GAIN"].split()[0]) == pytest.approx(10)  # 5 %/°C over 200 °C
    assert pairs["plant"].strip() == f"G(s) = {links.encode(design)['plant']}"
    rows = [read.texts["td"][i : i + 5] for i in range(0, len(read.texts["td"]), 5)]
    assert read.texts["th"] == ["quantity", "now", "design", "as typed", "sampled every 0.2 s"]
    assert [float(cell) for cell in rows[0][2:]] == [1.914, 1.914, 2.184]
    for row, field in zip(rows, ("Ms", "Mt", "GM", "PM_deg", "delay_margin"), strict=True):
        expected = [getattr(judged, field) for judged in found.margins.values()]
        assert [float(cell) for cell in row[1:]] == pytest.approx(expected, rel=6e-4)
    assert any("Sampling is slow" in item and "0.0766 s" in item for item in read.texts["li"])
    assert "set point 2 °C, then load 1 %, OP from 0 to 100 %" in document(found)


def test_every_curve_is_in_both_figures_within_its_frame_and_to_scale():
    _, found = made(**FULL)
    assert list(found.curves) == ["as built", "design", "now"]
    for svg, signal, names in zip(figures(found), "yu", ({"r"}, set()), strict=True):
        lines = [attrs for tag, attrs in Read(svg).elements if tag == "polyline"]
        assert {line["data-name"] for line in lines} == names | set(found.curves)
        assert len({line["stroke-dasharray"] for line in lines}) >= 3
        assert f"{signal} [" in svg
        assert "t [s]" in svg
        spans = {}
        for line in lines:
            points = np.array([list(map(float, pair.split(","))) for pair in line["points"].split()])
            assert np.all((points[:, 0] >= LEFT - 0.1) & (points[:, 0] <= WIDTH - RIGHT + 0.1))
            assert np.all((points[:, 1] >= TOP - 0.1) & (points[:, 1] <= HEIGHT - BOTTOM + 0.1))
            spans[line["data-name"]] = np.ptp(points[:, 1])
        sizes = {name: np.ptp(getattr(curve, signal)) for name, curve in found.curves.items()}
        scale = spans["now"] / sizes["now"]
        for name, size in sizes.items():
            assert spans[name] == pytest.approx(scale * size, abs=0.3)


def test_the_picture_holds_plant_settings_and_both_figures():
    _, found = made(**FULL)
    root = ElementTree.fromstring(picture(found))
    texts_ = [element.text for element in root.iter("{http://www.w3.org/2000/svg}text")]
    assert texts_[:2] == ["TIC-101: controller settings", found.plant]
    assert "GAIN 10 %/%, RESET 8 s, RATE 3 s" in texts_[2]
    assert len(root.findall("{http://www.w3.org/2000/svg}svg")) == 2
    assert {"t [s]", "y [°C]", "u [%]", "as built", "now"} <= set(texts_)


@pytest.mark.parametrize("sampling", [{}, {"sampling": "0.2"}])
def test_a_box_that_kicks_without_a_filter_has_all_but_that_response(sampling):
    """OSCAT: D on e, no filter; Ms of the unfiltered design is 1.6089 [measured apart], sampled the kick is finite."""
    _, found = made(plant=P0["plant"], order="2", unit="s", box="oscat_ctrl_pid", **sampling)
    assert found.margins["as typed"].Ms == pytest.approx(1.6089, abs=5e-4)
    assert [row.name for row in found.typed][:3] == ["KP", "TN", "TV"]
    told = any("a set-point step makes u infinite" in text for text in found.watch)
    assert told == (not sampling)
    assert list(found.curves) == (["as built", "design"] if sampling else ["design"])
    assert "<svg" in picture(found)


def test_a_box_that_does_not_take_the_design_costs_the_box_alone():
    _, found = made(plant=P0["plant"], order="2", unit="min", box="abb_acs880")
    assert found.typed == ()
    assert "derivation time of ACS880, ACQ580 process PID must be from 0 to 10 s, found 130.909" in found.watch[0]
    assert list(found.curves) == ["design"]


def test_settings_now_that_kick_have_their_margins():
    _, found = made(**P0, now="ideal~6~11~2~0~1~1")
    assert "now" in found.margins
    assert "now" not in found.curves
    assert any("The response now is not drawn" in text for text in found.watch)


def test_curves_as_csv_hold_every_point():
    _, found = made(**FULL)
    head, *rows = csv.reader(io.StringIO(curves_csv(found)))
    assert head == ["curve", "t [s]", "r [°C]", "d [%]", "y [°C]", "u [%]"]
    for name, curve in found.curves.items():
        own = np.array([list(map(float, row[1:])) for row in rows if row[0] == name])
        assert np.array_equal(own, np.column_stack([curve.t, curve.r, curve.d, curve.y, curve.u]))


def test_markdown_and_csv_tell_the_same_numbers():
    _, found = made(**FULL)
    table = {tuple(row[:2]): row[2] for row in csv.reader(io.StringIO(settings_csv(found)))}
    assert table["typed", "GAIN"] == "10"
    assert table["margins", "Ms, sampled every 0.2 s"] == "2.184"
    lines = markdown(found).splitlines()
    assert "| `GAIN` | `10` | `%/%` |" in lines
    assert "| `Ms` | `" in "\n".join(lines)
    assert lines[-1] == f"<{found.link}>"


def test_what_people_typed_stays_text():
    _, found = made(**FULL | {"tag": EVIL[:40], "note": EVIL, "PV_unit": "<b>", "PV": "=1+1"})
    text = document(found)
    read = Read(text)
    assert "script" not in {tag for tag, _ in read.elements}
    assert text.count("</article>") == 1
    assert EVIL[:40] in "".join(read.texts["h1"])
    for tag, attrs in read.elements:
        assert not [name for name in attrs if name.startswith("on")]
        assert tag != "img" or attrs["src"].startswith("data:image/svg+xml;base64,")
    assert "'=1+1" in settings_csv(found)
    (line,) = (line for line in markdown(found).splitlines() if line.startswith("| `note`"))
    assert line == f"| `note` | ``{EVIL}`` |  |".replace(EVIL, EVIL.replace("|", r"\|"))


KINDS = {
    "integrating": "0.5 exp(-2s)/s",
    "unstable": "2 exp(-s)/(10s-1)",
    "oscillating": "exp(-s)/(4s^2+0.8s+1)",
    "pure dead time": "exp(-2s)",
    "no dead time": "3/(5s+1)",
    "huge": "1e6 exp(-3600s)/(1e5s+1)",
}


@pytest.mark.parametrize("plant", KINDS.values(), ids=KINDS.keys())
def test_every_kind_of_plant_has_a_whole_report(plant):
    given = {"plant": plant} | ({"tau_c": "1"} if plant == KINDS["no dead time"] else {})
    _, found = made(**given)
    text = document(found)
    read = Read(text)
    assert [tag for tag, _ in read.elements].count("img") == 3
    assert not re.search(r"\b(nan|inf)\b", text, re.IGNORECASE)
    for curve in found.curves.values():
        assert math.isfinite(float(np.abs(curve.y).max()))


def test_settings_now_that_make_the_loop_unstable_leave_the_new_one_readable():
    _, found = made(**P0 | {"now": "ideal~60~3~0~0~1~0"})
    assert not found.margins["now"].stable
    assert "not stable" in document(found)
    y, _ = figures(found)
    (line,) = (attrs for tag, attrs in Read(y).elements if attrs.get("data-name") == "design")
    heights = [float(pair.split(",")[1]) for pair in line["points"].split()]
    assert max(heights) - min(heights) > 10  # px


def test_a_link_too_long_for_a_code_is_text_alone():
    _, found = made(**P0 | {"note": "ö" * 400})
    assert len(found.link) > 1000
    assert [tag for tag, _ in Read(document(found)).elements].count("img") == 2


def test_the_page_shows_the_report_and_offers_its_files():
    app = run_page("take_home", "Report", "home_views", **FULL)
    assert not app.exception
    labels = [each.proto.label for each in app.get("download_button")]
    assert {"HTML, to print", "Markdown", "Settings as CSV", "Curves as CSV", "Figures as SVG"} <= set(labels)
    assert any('<article class="report">' in str(each.proto.body) for each in app.get("html"))


def test_a_box_that_refuses_is_told_in_place_of_the_report():
    app = run_page("take_home", "Report", "home_views", **P0 | {"box": "eurotherm_3116", "PV_high": "1", "PV_low": "0"})
    assert not app.exception
    assert app.error or any('class="report"' in str(each.proto.body) for each in app.get("html"))
