"""Figures of the loop as built."""

import numpy as np

from simc_core import Actuation, Loop, Plant, Scenario, SeriesPid
from simc_core.figures import built_input_figure
from simc_core.studies.with_actuator import as_built

LOOP = Loop(Plant(1.0, 1.0, (8.0,)), SeriesPid(4.0, 8.0))


def names(figure):
    return [trace["name"] for trace in figure["data"]]


def test_limits_are_lines_where_they_are_near_and_left_out_where_they_would_flatten_the_curves():
    figure = built_input_figure(as_built(LOOP, Scenario(actuation=Actuation(u_min=-100.0, u_max=2.0))))
    assert names(figure) == ["u max", "linear", "no anti-windup", "as built"]
    line = figure["data"][0]
    assert np.all(line["y"] == 2.0)
    assert [note["text"] for note in figure["layout"]["annotations"]] == ["u max"]


def test_curves_differ_by_their_dashes():
    figure = built_input_figure(as_built(LOOP, Scenario(actuation=Actuation(u_max=2.0))))
    assert len({trace["line"]["dash"] for trace in figure["data"] if trace["name"] != "u max"}) == 3
