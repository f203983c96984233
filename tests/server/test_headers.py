"""The headers of every answer; that browsers obey and pages still work is tests/browser/test_headers.py."""

import base64
import hashlib
import re
from pathlib import Path

import pytest
import streamlit

from server.headers import policy

INDEX = Path(streamlit.__file__).parent / "static" / "index.html"


def directives(value: str) -> dict[str, list[str]]:
    """The grammar of [CSP3 2.2]: directives between semicolons, a name and its sources between blanks."""
    return {name: sources for name, *sources in (part.split() for part in value.split(";"))}


def test_the_inline_script_of_streamlit_is_the_one_we_know():
    scripts = re.findall(r"<script>(.*?)</script>", INDEX.read_text(), re.DOTALL)
    hashes = [base64.b64encode(hashlib.sha256(script.encode()).digest()).decode() for script in scripts]
    assert [f"'sha256-{each}'" for each in hashes] == directives(policy())["script-src"][3:]


def test_nothing_comes_from_another_host_and_nothing_is_evaluated():
    found = directives(policy())
    sources = {source for each in found.values() for source in each}
    assert {source for source in sources if ":" in source} == {"data:", "blob:"}
    assert "'unsafe-eval'" not in sources
    assert "'unsafe-inline'" not in found["script-src"]
    assert found["default-src"] == ["'self'"]


def test_a_course_page_may_frame_ours_when_it_is_named():
    assert directives(policy())["frame-ancestors"] == ["'self'"]
    named = "https://course.example.org http://localhost:8080"
    assert directives(policy(named))["frame-ancestors"] == ["'self'", *named.split()]


@pytest.mark.parametrize("wrong", ["course.example.org", "https://a.org;", "*", "https://a.org/page", "'none'"])
def test_what_is_no_origin_is_refused(wrong):
    with pytest.raises(ValueError, match="SIMC_FRAMED_BY must hold origins"):
        policy(wrong)
