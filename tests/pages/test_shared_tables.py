"""Tables shared between sessions: made once, whoever comes meanwhile; bounded; a maker that gives up harms nobody."""

import random
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier, Event

import pytest

from pages.common.live.kit import shared_tables
from pages.common.live.kit.shared_tables import SharedTables

from .tools import run_page

PATIENCE = 30  # s


def test_thirty_who_come_together_wait_for_one():
    tables, made, together = SharedTables(1000), [], Barrier(30)
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
    tables, both = SharedTables(1000), Barrier(2)

    def make() -> bytes:
        both.wait(PATIENCE)  # passes only if the other is being made too
        return b"table"

    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(lambda name: tables.get(name, make), ("a", "b"))) == [b"table"] * 2


def test_one_who_gives_up_leaves_the_work_to_the_next():
    tables, begun, waiting = SharedTables(1000), Event(), Event()

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
    tables, made = SharedTables(300), []

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
    tables = SharedTables(2_000)

    def visit(seed: int) -> None:
        rng = random.Random(seed)
        for _ in range(200):
            size = rng.randrange(1, 60)
            assert tables.get(str(size), lambda size=size: bytes(10 * size)) == bytes(10 * size)

    with ThreadPoolExecutor(8) as pool:
        list(pool.map(visit, range(8)))
    assert sum(map(len, tables._kept.values())) == tables._bytes <= 2_000
    assert not tables._making


@pytest.mark.parametrize(("place", "tables"), [("tuning", 1), ("cascade", 3)])
def test_a_second_session_takes_the_tables_of_the_first(monkeypatch, place, tables):
    asked, made = [], []

    class Watched(SharedTables):
        def get(self, name, make):
            asked.append(name)
            return super().get(name, lambda: made.append(name) or make())

    monkeypatch.setattr(shared_tables.TABLES, "__class__", Watched)
    shared_tables.TABLES._kept.clear()
    shared_tables.TABLES._bytes = 0
    for _ in range(2):
        run_page(place, "Live", plant="2 exp(-s)/(9s+1)", Ga="2 exp(-s)/(9s+1)")
    assert len(made) == tables
    assert asked == made * 2
