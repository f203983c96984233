"""Lessons as data: every design opens, every printed number is met or explained, every claim is computed."""

import math
import re

import pytest

from pages.common.lessons.claims import checked, half_digit, value_of
from pages.common.lessons.lesson import SUBJECTS, Lesson
from pages.common.lessons.opened import Cases, check_designs
from pages.common.lessons.quantities import QUANTITIES
from pages.common.lessons.read import LARGEST, read_lesson
from pages.common.lessons.shelf import DATA, by_paper, by_subject, lessons
from pages.common.parts.quantities import QUANTITIES as CELLS
from simc_core.errors import InvalidParameter
from simc_core.published.sources import SOURCES

from .tools import ROOT

ALL = lessons()
NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d+)?(?![\w]|\.\d| degrees)")
WITHIN = re.compile(r"\d+(?:\.\d+)?")
ABOUT = 0.05  # relative: "about 7" for 6.9, in questions and answers
PLANNED = {
    *("V1", "V2", "S1", "S2", "S3", "S4", "S51", "S52", "S53", "S61", "S62", "S7", "S8", "S9"),
    *("I3", "I4", "I5", "R1", "Q1", "M1"),
    *("P01a", "P01b", "P01c", "P02", "P03", "P04", "P05", "P06", "P07", "P08", "P09", "P10"),
    *("N1", "N2", "N3", "N4", "N5"),
}
every = pytest.mark.parametrize("lesson", ALL.values(), ids=list(ALL))


def test_all_that_were_planned_are_there_and_each_file_is_named_as_its_lesson():
    assert set(ALL) == PLANNED
    assert {file.stem for file in DATA.glob("*.toml")} == PLANNED
    assert {lesson.source for lesson in ALL.values()} - {""} <= set(SOURCES)


def test_each_is_found_once_by_subject_and_once_by_paper():
    for groups in (by_subject(), by_paper()):
        assert sorted(each.id for group in groups.values() for each in group) == sorted(ALL)
    assert list(by_subject()) == list(SUBJECTS.values())


@every
def test_every_design_opens_and_every_claim_is_true(lesson):
    cases = Cases(lesson)
    check_designs(lesson)
    assert lesson.claims
    for claim in lesson.claims:
        for check in claim.checks:
            found = checked(check, cases)
            assert found.met, f"{claim.says}: {check}: {found.left} and {found.right}. {found.fault}"


@every
def test_every_printed_number_is_met_to_half_its_last_digit_or_the_difference_is_explained(lesson):
    cases = Cases(lesson)
    for row in lesson.printed:
        met = abs(value_of(row.of, cases) - float(row.value)) <= half_digit(row.value) * (1 + 1e-9)
        assert met or row.differs, f"{row.name}: {row.value}, ours {value_of(row.of, cases)}"


def numbers(text: str) -> set[float]:
    return {float(each) for each in NUMBER.findall(text)}


def computed(lesson: Lesson) -> set[float]:
    """What is in the designs, in checks and in printed numbers."""
    fields = [text for case in (lesson.design, *lesson.cases.values()) for text in case.values()]
    checks = [check for claim in lesson.claims for check in claim.checks]
    printed = [text for row in lesson.printed for text in (row.of, row.value)]
    return {float(each) for text in (*fields, *checks, *printed) for each in WITHIN.findall(text)}


@every
def test_every_number_of_the_text_is_one_that_is_computed_or_set(lesson):
    known = computed(lesson)
    told = [*(claim.says for claim in lesson.claims), *(row.differs for row in lesson.printed)]
    told += [move.text for move in (lesson.play, *lesson.moves)]
    for text in told:
        assert numbers(text) <= known, text
    for text in (lesson.question, lesson.choices[lesson.right - 1], lesson.answer):
        strange = {n for n in numbers(text) if not any(abs(n - k) <= ABOUT * n for k in known)}
        assert not strange, text


@every
def test_no_more_than_four_numbers_are_shown_and_all_of_them_are_cells_of_the_instrument(lesson):
    assert len(lesson.numbers) <= 4
    assert set(lesson.numbers) <= set(CELLS)


def test_subjects_are_taught_by_at_least_one_lesson_each():
    assert {lesson.subject for lesson in ALL.values()} == set(SUBJECTS)


GOOD = (DATA / "V1.toml").read_bytes()


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (b'id = "V1"', b'id = "V 1"', "id must be 1 to 12 letters and digits"),
        (b'title = "Three lags and a dead time"\n', b"", "title is missing"),
        (b"right = 2", b"right = 4", "right must be one of 1 to 3, found 4"),
        (b"right = 2", b'right = "2"', "right must be a whole number"),
        (b"right = 2", b"right = 2\nlevel = 3", "level is no field"),
        (b'subject = "derivative"', b'subject = "D"', "subject must be one of reduction"),
        (b'order = "1"\nform', b"order = 1\nform", "design: order must be a text in quotes"),
        (b'plant = "exp(-3s)/', b'plant = "exp(+3s)/', "design: plant:"),
        (b'[cases.PI]\norder = "1"', b'[cases.PI]\norder = "3"', "cases.PI: order: order must be"),
        (b'case = "PID"', b'case = "PDI"', "case must be one of base, PI"),
        (b'panels = ["y", "u"]', b'panels = ["y", "v"]', "play: panels must be one of y, u"),
        (b'value = "0.57"', b'value = "about"', "printed 1: value must be a number"),
        (b'value = "0.57"', b"value = 0.57", "printed 1: value must be a text in quotes"),
        (b"[[claims]]", b"[claims]", "TOML"),
        (b"[play]", b"[play", "the file is no TOML"),
        (b'question = "A', b'question = "' + 700 * b"a", "question must have 1 to 700 characters"),
        (
            b'numbers = ["Ms", "IAE_disturbance"]',
            b'numbers = ["Ms", "Mt", "GM", "PM_deg", "overshoot"]',
            "numbers must be at most 4",
        ),
        (b'id = "V1"', b'own = true\nid = "V1"', "own is no field"),
    ],
)
def test_what_is_wrong_with_a_file_is_named_with_its_field(old, new, said):
    assert old in GOOD
    with pytest.raises(InvalidParameter, match=re.escape(said)):
        check_designs(read_lesson(GOOD.replace(old, new, 1)))


@pytest.mark.parametrize(
    "data",
    [b"\xff\xfe", b"a" * (LARGEST + 1), b"", b"[" * 5000, b"x = 1", b"x = " + 5000 * b"1", b"id = 0x" + 9000 * b"f"],
)
def test_what_is_no_lesson_is_refused_in_words(data):
    with pytest.raises(InvalidParameter):
        read_lesson(data)


def test_a_lesson_of_a_file_is_not_one_of_the_program():
    assert not read_lesson(GOOD).own
    assert ALL["V1"].own


CASES = Cases(ALL["V1"])


@pytest.mark.parametrize(
    ("check", "met"),
    [
        ("Kc(PI) = 0.571", True),  # 4/7 = 0.5714...
        ("Kc(PI) = 0.5714", True),
        ("Kc(PI) = 0.57143 ~ 0.000001", False),
        ("7*Kc(PI) = 4.000000", True),
        ("7*Kc(PI) - 4 = 0 ~ 1e-12", True),
        ("Ms(PID) > Ms(PI)", True),
        ("Ms(PID) < Ms(PI)", False),
        ("Ms(PI) = Ms(PID) ~ 0.1", True),
        ("1 + 2*3 = 7", True),
        ("8/4/2 = 1", True),
        ("2 - 3 = -1", True),
        ("noise_gain(PID) = inf", True),
        ("Kc = Kc(PI) ~ 1e-12", True),  # without brackets: the design alone
    ],
)
def test_checks_are_computed(check, met):
    found = checked(check, CASES)
    assert found.met is met, found
    assert not found.fault


@pytest.mark.parametrize(
    ("check", "said"),
    [
        ("Ms(PI) = Ms(PID)", "needs ~"),
        ("Ms(PI)", "one of < > ="),
        ("Ms(other) > 1", "no case other"),
        ("secret(PI) > 1", "no quantity secret"),
        ("Ms(PI) > 1 2", "a check ends"),
        ("Ms(PI) > 1/0", "zero"),
        ("Ms(PI) = 1.6 ~ Ms", "a check ends"),
        ("Ms(PI) = 1e400", "a check ends"),
        ("behind_FOPDT(PI) < 1", "example must be one of"),
        ("__import__('os') = 1", "not understood"),
        ("Ms(PI) =", "missing at the end"),
        ("tau2(PI) > 1", "the model has no tau2"),
        ("IAE_d1(PI)*wound_up_IAE(PI) > 1", "no limits"),
    ],
)
def test_a_check_that_cannot_be_computed_says_why(check, said):
    found = checked(check, CASES)
    assert not found.met
    assert said in found.fault


@pytest.mark.parametrize(
    ("number", "half"), [("8", 0.5), ("0.57", 0.005), ("1.30", 0.005), ("-2", 0.5), ("2e-3", 5e-4)]
)
def test_half_of_the_last_digit(number, half):
    assert math.isclose(half_digit(number), half)


def test_quantities_have_a_meaning_each_and_the_documentation_lists_them():
    listed = (ROOT / "docs" / "lessons.md").read_text()
    for name, quantity in QUANTITIES.items():
        assert f"| `{name}` | {quantity.meaning} |" in listed
    for subject, title in SUBJECTS.items():
        assert f"| `{subject}` | {title} |" in listed
