"""What is exported, read whole by parsers of their languages that others have written."""

import pymoca.parser
import pytest
import tree_sitter
import tree_sitter_iec61131_3_st

from simc_core import GainSchedule, Plant, ScheduleTable, SecondOrderDelay, SeriesPid, export, export_schedule, simc

PID, PLANT = SeriesPid(5, 8, 3, 0.375, b=0.6), Plant(1, 1, (10, 3))
LAWS = ["backward", "tustin"]
ST = tree_sitter.Parser(tree_sitter.Language(tree_sitter_iec61131_3_st.language()))


def table() -> ScheduleTable:
    models = (SecondOrderDelay(1, 4, 20, 3), SecondOrderDelay(2, 3, 15, 2), SecondOrderDelay(5, 2, 8, 1))
    return ScheduleTable(GainSchedule((20, 50, 80), models, lambda model: simc(model).with_filter(0.1)))


def written(language: str) -> dict[str, str]:
    about = {"plant": PLANT, "u_max": 10.0, "date": "2026-11-27", "about": "loop TIC-101, PV in °C, output in %"}
    found = {law: export(PID, language, 0.2, law, **about) for law in LAWS}
    return found | {"schedule": export_schedule(table(), language)}


@pytest.mark.parametrize("single", [False, True])
def test_structured_text_is_that_of_the_standard(single):
    texts = written("st") | {
        "single": export(PID, "st", 0.2, single=True),
        "32": export_schedule(table(), "st", single=single),
    }
    for name, text in texts.items():
        assert not ST.parse(text.encode()).root_node.has_error, name
    for lost in ("END_IF;", "THEN", " : LREAL", "END_VAR", "END_FUNCTION_BLOCK"):
        assert ST.parse(texts["backward"].replace(lost, "", 1).encode()).root_node.has_error, lost


def test_modelica_is_that_of_its_grammar():
    for name, text in written("modelica").items():
        found = pymoca.parser.parse(text).classes
        blocks = {"SimcSchedule"} if name == "schedule" else {"SimcPid", "SimcLoop"}
        assert blocks <= set(found)
    block = found["SimcSchedule"]
    assert {name for name, symbol in block.symbols.items() if "output" in symbol.prefixes} == {"Kp", "Ki", "Kd"}
