"""What a link asks an instrument for stands in the next run too: one run may take away what the one before has said."""

import json
import struct

import pytest

from tests.pages.tools import run_page


def lectures(app):
    """What is said of lectures to the instrument of the page."""
    found = []
    for part in app.get("bidi_component"):
        if part.proto.HasField("bytes"):
            (length,) = struct.unpack_from("<I", part.proto.bytes)
            found.append(json.loads(part.proto.bytes[4 : 4 + length]))
    return [each for each in found if each.get("kind") == "lecture"]


@pytest.mark.parametrize("name", ["tuning", "cascade"])
def test_a_lecture_that_a_link_asks_for_is_said_until_it_is_heard(name):
    app = run_page(name, plant="exp(-s)/(8s+1)", lecture="1", panel="y")
    (first,) = lectures(app)
    assert first["panel"] == "y"
    (again,) = lectures(app.run())
    assert again == first
    app.query_params["lecture"] = "1"
    (other,) = lectures(app.run())
    assert other["once"] != first["once"]


def test_nothing_is_said_where_nobody_asks():
    assert lectures(run_page("tuning", plant="exp(-s)/(8s+1)")) == []
