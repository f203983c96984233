"""What sessions share: made once, whoever comes meanwhile; bounded; a maker that gives up harms nobody."""

import random
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier, Event

import pytest

from pages.common.live.kit.held import TABLES
from pages.common.session.tuning import Tuning
from pages.common.shared import Shared, shared
from pages.common.studies.single import study
from simc_core import Plant

from .tools import run_page

PATIENCE = 30  # s


def test_thirty_who_come_together_wait_for_one():
    tables, made, together = Shared(1000, len), [], Barrier(30)
    inside = Event()

    def make() -> bytes:
        made.append(1)
        inside.wait(0.1)  # long enough for the others to come
        return b"table"

    def visit(_) -> bytes:
        together.wait(PATIENCE)
        return tables.get("one", make)

    with ThreadPoolExecutor(30) as pool:
        found = list(pool.map(visit, range(30)))
    assert found == [b"table"] * 30
    assert len(made) == 1


def test_two_tables_are_made_side_by_side():
    tables, both = Shared(1000, len), Barrier(2)

    def make() -> bytes:
        both.wait(PATIENCE)  # passes only if the other is being made too
        return b"table"

    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(lambda name: tables.get(name, make), ("a", "b"))) == [b"table"] * 2


def test_one_who_gives_up_leaves_the_work_to_the_next():
    tables, begun, waiting = Shared(1000, len), Event(), Event()

    def give_up() -> bytes:
        begun.set()
        waiting.wait(PATIENCE)
        raise KeyboardInterrupt  # as Streamlit ends a run: not an Exception

    with ThreadPoolExecutor(2) as pool:
        first = pool.submit(tables.get, "one", give_up)
        begun.wait(PATIENCE)
        second = pool.submit(tables.get, "one", lambda: b"table")
        waiting.set()
        assert second.result(PATIENCE) == b"table"
        with pytest.raises(KeyboardInterrupt):
            first.result(PATIENCE)
    assert tables.get("one", pytest.fail) == b"table"


def test_what_was_asked_for_longest_ago_goes_first():
    tables, made = Shared(300, len), []

    def get(name: str, size: int = 100) -> None:
        tables.get(name, lambda: made.append(name) or bytes(size))

    for name in ("a", "b", "c", "a", "d", "a", "c", "b"):  # d sends b away: a was asked for again
        get(name)
    assert made == ["a", "b", "c", "d", "b"]
    get("large", 1000)
    get("large", 1000)  # larger than all room: kept, alone
    get("a")
    assert made == ["a", "b", "c", "d", "b", "large", "a"]


def test_many_threads_get_what_they_ask_for_within_the_bound():
    tables = Shared(2_000, len)

    def visit(seed: int) -> None:
        rng = random.Random(seed)
        for _ in range(200):
            size = rng.randrange(1, 60)
            assert tables.get(str(size), lambda size=size: bytes(10 * size)) == bytes(10 * size)

    with ThreadPoolExecutor(8) as pool:
        list(pool.map(visit, range(8)))
    assert sum(map(len, tables._kept.values())) == tables._sum <= 2_000
    assert not tables._making


def test_a_function_is_shared_by_arguments_and_bounded():
    made = []

    @shared(2)
    def square(x: float, power: int = 2) -> float:
        made.append(x)
        return x**power

    assert [square(3), square(3), square(3, power=3), square(3)] == [9, 9, 27, 9]
    assert made == [3, 3]
    square(4)
    square(5)
    square(3)
    assert made == [3, 3, 4, 5, 3]


def test_who_looks_at_one_design_looks_at_one_study():
    plant = Plant(1, 1, (8,))
    assert study(plant, Tuning(tau_c=2)) is study(Plant(1.0, 1.0, (8.0,)), Tuning(tau_c=2.0))
    assert study(plant, Tuning(tau_c=2)) is not study(plant, Tuning(tau_c=3))


@pytest.mark.parametrize(("place", "tables"), [("tuning", 1), ("cascade", 3)])
def test_a_second_session_takes_the_tables_of_the_first(monkeypatch, place, tables):
    asked, made = [], []

    class Watched(Shared):
        def get(self, name, make):
            asked.append(name)
            return super().get(name, lambda: made.append(name) or make())

    monkeypatch.setattr(TABLES, "__class__", Watched)
    TABLES._kept.clear()
    TABLES._sum = 0
    for _ in range(2):
        run_page(place, "Live", plant="2 exp(-s)/(9s+1)", Ga="2 exp(-s)/(9s+1)")
    assert len(made) == tables
    assert asked == made * 2
