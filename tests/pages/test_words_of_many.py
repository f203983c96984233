"""Many loops in a language of brackets: lists and what is wrong with them, a job on its way, results."""

from types import SimpleNamespace

import pytest
from streamlit.testing.v1 import AppTest

from pages.common.many_loops import source
from simc_core import InvalidParameter, read_list, tune_row
from simc_core.many.columns import COLUMNS
from simc_core.wording import Text
from tests.pages.tools import run_page
from tests.pages.wrapped import left_in_english, speak_brackets

LIST = "tag,k,theta,tau1,Kc,tau_I,box,other\n,1.5,2,8.25,1,9,honeywell_udc,x\nT1,1,1,8,,,,\nT2,1,,8,,,,\nT3,,,,,,,\n"


def page(**job):
    """The page on a list, with a job that is as far as it is told."""
    loops = read_list(LIST.encode())
    results = [tune_row(row) for row in loops.rows]
    known = {"results": results, "rows": loops.rows, "files": ("", ""), "state": "done", "going": False} | job
    app = run_page("many")
    work = source.Work("1.csv", loops, SimpleNamespace(**known, stop=lambda: None) if job else None)
    app.session_state["lasting_many"] = work
    app.run()
    assert not app.exception
    return app


@pytest.mark.parametrize(
    "job",
    [
        {},
        {"state": "done"},
        {"state": "stopped"},
        {"state": "failed"},
        {"state": "waiting", "going": True, "results": []},
        {"state": "running", "going": True},
    ],
)
def test_no_list_and_no_job_on_it_mixes(job, monkeypatch):
    speak_brackets(monkeypatch)
    assert left_in_english(page(**job)) == []


def test_no_choice_of_loops_mixes(monkeypatch):
    speak_brackets(monkeypatch)
    app = page(state="done")
    app.selectbox(key="loops_show").set_value("refused").run()
    assert left_in_english(app) == []
    app.text_input(key="loops_tag").set_value("nowhere").run()
    assert left_in_english(app) == []


@pytest.mark.parametrize(
    "content", ["", "a,b\n1,2\n", "k,theta,tau1\n", "k,theta [s],tau1 [h]\n1,2,3\n", "k," * 300 + "\n1\n"]
)
def test_what_is_no_list_is_refused_with_what_can_be_translated(content):
    with pytest.raises(InvalidParameter) as refused:
        read_list(content.encode())
    assert isinstance(refused.value.args[0], Text)


@pytest.mark.parametrize(
    "row",
    [
        {},
        {"k": "x", "theta": 1, "tau1": 1},
        {"k": 1, "theta": 1},
        {"plant": "1/(s+1)", "k": 1},
        {"k": 1, "theta": 1, "tau1": 8, "kind": "PD"},
        {"k": 1, "theta": 1, "tau1": 8, "Ms": 1.01, "tau_c": 3},
        {"k": 1, "theta": 1, "tau1": 8, "Ms": 1.01},
        {"k": 1, "theta": 1, "tau1": 8, "rule": "zn"},
        {"k_prime": 1, "k": 1, "theta": 1},
    ],
)
def test_a_row_that_is_refused_can_be_told_in_other_languages(row):
    assert isinstance(tune_row(row).refusal, Text)


def test_columns_have_meanings_that_can_be_translated():
    assert [column.name for column in COLUMNS if not isinstance(column.meaning, Text)] == []


def opened():
    """One loop that is opened, as a script."""
    from pages.common.many_loops.results import _sheet
    from simc_core import tune_row
    from simc_core.many.results_csv import cells

    found = tune_row({"row": 2, "k": 1.5, "theta": 2, "tau1": 8.25, "Kc": 1, "tau_I": 9, "box": "honeywell_udc"})
    _sheet(cells(found), found)


def test_no_loop_that_is_opened_mixes(monkeypatch):
    speak_brackets(monkeypatch)
    app = AppTest.from_function(opened).run()
    assert not app.exception
    assert len(app.markdown) == 5
    assert left_in_english(app) == []
