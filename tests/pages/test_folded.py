"""What stands folded is made when it is opened, and nothing that was typed there is lost when it is closed."""

import pytest

from pages.common.from_data import graphical_view, tuning_view

from .tools import address, fold, run_page, unfold

PLANT = "2 exp(-3 s)/(20 s + 1)"
# what is opened, a field in it, a text that is taken, its name in the address, and a text that is refused
TYPED = {
    "sheet": ("widget_PV_low", "−20,5", "PV_low", "1,234"),
    "excitation": ("widget_r", "1,5", "r", "abc"),
    "now": ("now_IdealPid_Kc", "0,5", "now", "abc"),
    "change_plant": ("plant_text_text", "3 exp(-3 s)/(20 s + 1)", "plant", "3 exp(-3 s)/("),
    "enter_Ga": ("Ga_text_text", "3 exp(-3 s)/(20 s + 1)", "Ga", "3 exp(-3 s)/("),
}


def opened(key: str):
    return run_page("cascade" if key == "enter_Ga" else "tuning", plant=PLANT, now="ideal~1.0~10.0~0.0~0.0~1.0~0.0")


@pytest.mark.parametrize("key", TYPED)
def test_folded_fields_are_not_made_and_keep_what_was_typed(key):
    field, good, name, bad = TYPED[key]
    app = opened(key)
    here = address(app)
    assert field not in [each.key for each in app.text_input]
    unfold(app, key).text_input(key=field).set_value(good).run()
    kept = address(app)
    assert kept[name] != here.get(name)
    fold(app, key)
    assert field not in [each.key for each in app.text_input]
    assert address(app) == kept
    unfold(app, key)
    assert app.text_input(key=field).value == good
    app.text_input(key=field).set_value(bad).run()
    assert app.error
    fold(app, key)
    assert address(app) == kept  # the last good one
    unfold(app, key)
    assert app.text_input(key=field).value == bad
    assert app.error  # with the reason


def test_a_link_fills_a_sheet_that_was_never_opened():
    app = run_page("tuning", plant=PLANT, tag="TIC 7", unit="min", PV_low="0", PV_high="200")
    assert (address(app)["tag"], address(app)["PV_high"]) == ("TIC 7", "200")
    unfold(app, "sheet")
    assert app.text_input(key="widget_tag").value == "TIC 7"
    assert app.text_input(key="widget_PV_high").value == "200"


def test_what_costs_on_a_record_is_computed_when_it_is_opened(monkeypatch):
    """The curve of Ms over tau_c, and what is read off by hand, with the margins of its settings."""
    asked = []
    for room, name in ((tuning_view, "ms_of_cloud"), (graphical_view, "by_hand")):
        made = getattr(room, name)
        monkeypatch.setattr(room, name, lambda *given, made=made, name=name: (asked.append(name), made(*given))[1])
    app = run_page("from_data", example="step")
    assert not asked
    assert len(app.get("plotly_chart")) == 1
    unfold(app, "Ms_against_tau_c", "by_hand")
    assert set(asked) == {"ms_of_cloud", "by_hand"}
    assert len(app.get("plotly_chart")) == 2
    assert any("two-point" in str(table.value) for table in app.dataframe)
