"""The command: results as they come, a run that goes on, one report."""

import csv
import math
import re

import numpy as np
import pytest

from simc_core import Plant, SeriesPid, read_list, stability, tune_chunk
from simc_core.__main__ import main
from simc_core.errors import InvalidParameter
from simc_core.loops.loop import Loop
from simc_core.many.drawn import drawn
from simc_core.many.read_list import template
from simc_core.many.report import report, worth
from simc_core.many.results_csv import ResultsFile, as_csv, cells
from simc_core.many.variants import TuneWithVariants, robust, varied

EVIL = '<script>alert("1")</script>'


@pytest.fixture
def loops(tmp_path):
    path = tmp_path / "loops.csv"
    path.write_text(template() + f'{EVIL},,x,1,1\n"=1+1",,1,1,8\n,,1,1,8\n,,1,1,4\n', encoding="utf-8")
    return path


def lines(path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_a_list_in_results_and_a_report_out(loops, tmp_path, capsys):
    assert main(["many", str(loops), "-o", str(tmp_path / "out")]) == 0
    found = lines(tmp_path / "out" / "results.csv")
    assert [line["tag"] for line in found[:2]] == ["FC-101", "TC-205"]
    assert len(found) == 9
    assert float(found[0]["Kc"]) == pytest.approx(4 / (1.2 * 2))  # tau1/(k 2 theta)
    assert found[5]["refusal"].startswith("k must be one number, found 'x'")
    assert found[6]["tag"] == "'=1+1"
    said = capsys.readouterr()
    assert "9 loops, 8 tuned, 1 refused" in said.out
    assert "9 of 9" in said.err


def test_the_report_is_escaped_and_needs_nothing_else(loops, tmp_path):
    main(["many", str(loops), "-o", str(tmp_path)])
    html = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert EVIL not in html
    assert "&lt;script&gt;" in html
    for outside in ("<script", "http:", "https:", "src=", "@import"):
        assert outside not in html
    assert html.index("PC-412") < html.index("TC-205") < html.index("FC-101")  # unstable, fragile, sluggish


def test_a_run_that_was_stopped_goes_on(loops, tmp_path):
    """Half of the results and a broken line are there; at the end every loop is there once."""
    main(["many", str(loops), "-o", str(tmp_path / "whole")])
    whole = (tmp_path / "whole" / "results.csv").read_bytes()
    some = whole.split(b"\n")
    (tmp_path / "again").mkdir()
    (tmp_path / "again" / "results.csv").write_bytes(b"\n".join(some[:4]) + b"\n" + some[4][:30])
    main(["many", str(loops), "-o", str(tmp_path / "again")])
    assert (tmp_path / "again" / "results.csv").read_bytes() == whole
    main(["many", str(loops), "-o", str(tmp_path / "again")])
    assert (tmp_path / "again" / "results.csv").read_bytes() == whole


def test_a_tag_that_is_there_twice_is_done_twice(tmp_path):
    rows = [{"tag": "A", "k": k, "theta": 1, "tau1": 8} for k in (1, 2)]
    path = tmp_path / "results.csv"
    with ResultsFile(path, rows) as file:
        file.write(tune_chunk(rows)[0])
    assert ResultsFile(path, rows).left == rows[1:]
    with ResultsFile(path, rows) as file:
        file.write(tune_chunk(rows)[1])
    assert ResultsFile(path, rows).left == []


def test_a_row_that_was_mended_is_done_again(loops, tmp_path, capsys):
    """As its refusal asks for; what stays as it was is kept, and so are loops of another list."""
    out = tmp_path / "out"
    main(["many", str(loops), "-o", str(out)])
    before = lines(out / "results.csv")
    loops.write_text(loops.read_text(encoding="utf-8").replace(",,x,1,1", ",,3,1,1"), encoding="utf-8")
    capsys.readouterr()
    assert main(["many", str(loops), "-o", str(out)]) == 0
    said = capsys.readouterr().out
    assert "8 are in" in said
    assert "1 have changed" in said
    assert "9 loops, 9 tuned" in said
    after = lines(out / "results.csv")
    assert after[:-1] == [line for line in before if line["tag"] != EVIL]
    assert float(after[-1]["Kc"]) == pytest.approx(1 / (3 * 2))  # tau1/(k 2 theta)
    other = tmp_path / "other.csv"
    other.write_text("tag,k,theta,tau1\nnew,1,1,8\n")
    main(["many", str(other), "-o", str(out)])
    assert [line["tag"] for line in lines(out / "results.csv")] == [*(line["tag"] for line in after), "new"]


def test_variants_that_are_asked_for_later_come(loops, tmp_path):
    main(["many", str(loops), "-o", str(tmp_path)])
    assert not any(line["variants_stable"] for line in lines(tmp_path / "results.csv"))
    main(["many", str(loops), "-o", str(tmp_path), "--variants", "3"])
    assert sum(bool(line["variants_stable"]) for line in lines(tmp_path / "results.csv")) == 8


@pytest.mark.parametrize("number", ["-1", "100000"])
def test_bounds_of_the_options(number, loops, tmp_path, capsys):
    assert main(["many", str(loops), "-o", str(tmp_path), "--jobs", number]) == 1
    assert "jobs must be" in capsys.readouterr().err
    assert main(["many", str(loops), "-o", str(tmp_path), "--variants", number]) == 1
    assert "variants must be" in capsys.readouterr().err


def test_another_file_is_not_written_to(tmp_path):
    path = tmp_path / "results.csv"
    path.write_text("mine\n1\n")
    with pytest.raises(InvalidParameter, match="file of results"):
        ResultsFile(path, [])
    assert path.read_text() == "mine\n1\n"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [(["many"], "needs a list"), (["many", "no such file.csv"], "No such file")],
)
def test_what_goes_wrong_is_said(arguments, words, capsys):
    assert main(arguments) != 0
    assert words in capsys.readouterr().err


def test_the_template_and_the_columns_are_printed(capsys):
    assert main(["many", "--template"]) == 0
    assert len(read_list(capsys.readouterr().out.encode()).rows) == 5
    with pytest.raises(SystemExit):
        main(["many", "--help"])
    assert "tau_D      present derivative time [time]" in capsys.readouterr().out


def test_results_keep_all_digits():
    (result,) = tune_chunk([{"k": 3, "theta": 1 / 3, "tau1": 7}])
    (line,) = csv.DictReader(as_csv([result]).splitlines())
    assert float(line["Kc"]) == result.controller.Kc
    assert float(line["IAE_load"]) == result.performance.disturbance.IAE


def test_order_of_worth():
    """Unstable, fragile, then by the load IAE, those without present settings, and the refused."""
    rows = [
        {"tag": "refused"},
        {"tag": "nothing known", "k": 1, "theta": 1, "tau1": 8},
        {"tag": "good", "k": 1, "theta": 1, "tau1": 8, "Kc": 4, "tau_I": 8},
        {"tag": "slow", "k": 1, "theta": 1, "tau1": 8, "Kc": 0.5, "tau_I": 8},
        {"tag": "fragile", "k": 1, "theta": 1, "tau1": 8, "Kc": 9, "tau_I": 8},
        {"tag": "unstable", "k": 1, "theta": 1, "tau1": 8, "Kc": 40, "tau_I": 8},
    ]
    found = sorted(map(cells, tune_chunk(rows)), key=worth)
    assert [line["tag"] for line in found] == ["unstable", "fragile", "slow", "good", "nothing known", "refused"]


def test_a_report_of_nothing():
    assert "0 loops" in report([])


def test_variants_are_the_same_in_every_chunk():
    rows = [{"tag": f"L{i}", "k": 1, "theta": 1, "tau1": 8} for i in range(4)]
    tune = TuneWithVariants(20, seed=5)
    together = [result.robust for result in tune(rows)]
    assert [tune([row])[0].robust for row in rows] == together
    assert len(set(together)) == 4  # each loop has variants of its own


def test_variants_are_judged_as_they_are():
    """Share of stable loops against the certificate one by one, where a fifth of the gain decides."""
    plant, controller = Plant(1, 1, integrators=1), SeriesPid(1.4, math.inf)  # stable below k theta = pi/2/1.4
    found = robust(plant, controller, 60, (1, 2))
    expected = [each.k * each.theta < math.pi / 2 / 1.4 for each in varied(plant, 60, (1, 2))]
    assert found.stable == sum(expected) / 60
    assert 0 < found.stable < 1
    assert found.Ms_95 == math.inf
    verdicts = [stability(Loop(each, controller)).verdict == "stable" for each in varied(plant, 60, (1, 2))]
    assert verdicts == expected


def test_variants_stay_within_their_spread():
    for each in varied(Plant(2, 3, (8, 4)), 50, (7,), 0.1):
        assert each.k == pytest.approx(2, rel=0.1 + 1e-12)
        assert each.theta == pytest.approx(3, rel=0.1 + 1e-12)
        assert each.lags[0] == pytest.approx(8, rel=0.1 + 1e-12)
        assert each.lags[1] == 4


def area(svg: str, name: str) -> float:
    """Between a curve and y = 0, where it begins, in pixels."""
    points = re.search(f'data-name="{name}" points="(.*?)"', svg)[1].split()
    x, y = np.array([list(map(float, point.split(","))) for point in points]).T
    return float(np.sum(np.diff(x) * (y[0] - (y[1:] + y[:-1]) / 2)))


def test_the_drawn_load_responses_have_the_areas_of_theory():
    """The integral of y after a load step is tau_I/Kc [SK03]: 8/2 now, 8/4 new; without settings now one curve."""
    row = {"k": "1", "theta": "1", "tau1": "8"}
    now, alone, bad = map(cells, tune_chunk([row | {"Kc": "2", "tau_I": "8"}, row, row | {"k": "x"}]))
    svg = drawn(now, "y0")
    assert area(svg, "now") / area(svg, "new") == pytest.approx(2, rel=0.02)
    assert 'data-name="now"' not in drawn(alone, "y1")
    assert 'data-name="new"' in drawn(alone, "y1")
    assert drawn(bad, "y2") == ""
    assert "<svg" in report([now])


def test_a_loop_that_is_not_stable_now_and_settings_of_every_form_are_drawn():
    row = {"plant": "-2 exp(-s)/((8s+1)(2s+1))", "kind": "PID"}
    for now in (
        {"Kc": "-30", "tau_I": "8"},
        {"Kp": "-1", "Ki": "-0.1", "Kd": "-1", "tau_F": "0.1", "form": "parallel"},
    ):
        (line,) = map(cells, tune_chunk([row | now]))
        assert {'data-name="new"', 'data-name="now"'} <= set(re.findall('data-name="[a-z]+"', drawn(line, "y")))
    (line,) = map(cells, tune_chunk([{"k": "2", "theta": "3", "tau1": "0"}]))  # pure dead time: an I controller
    assert 'data-name="new"' in drawn(line, "y")
