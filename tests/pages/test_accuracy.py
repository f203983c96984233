"""Accuracy page without a browser."""

from dataclasses import replace

from pages.common.accuracy.view import summary_html, table
from simc_core.published.checks import GROUPS, check_all

from .tools import run_page, texts


def test_every_group_is_shown_with_all_of_its_rows_met():
    app = run_page("accuracy")
    checks = check_all()
    (strip,) = [item.proto.body for item in app.get("html") if "strip accuracy" in item.proto.body]
    assert f"<b>{len(checks)} of {len(checks)}</b>" in strip
    assert "calm" in strip
    assert not app.error
    assert len(app.table) == len(GROUPS)
    assert sum(len(each.value) for each in app.table) == len(checks)
    for group in GROUPS:
        assert f"**{group}**" in texts(app)
    assert all((each.value.iloc[:, 0] == "✓").all() for each in app.table)


def test_a_row_that_is_not_met_says_so():
    checks = check_all()
    wrong = replace(checks[0], ours=7.0)
    html = summary_html([wrong, *checks[1:]])
    assert f"<b>{len(checks) - 1} of {len(checks)}</b>" in html
    assert "alarm" in html
    assert table([wrong])["met"] == ["✗ differs"]
