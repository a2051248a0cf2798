import struct

import pytest

from plcsim.core.control import Ending, Step
from plcsim.recorder.journal.feed import Diverged, EndOfRecord, Feed
from plcsim.recorder.journal.record import CYCLE, JournalRecord, JournalStore


def record(step: int = CYCLE, clock: tuple[int, ...] = (), network: bytes = b"") -> JournalRecord:
    writes = JournalStore(0, 100, b"a").to_bytes() + JournalStore(1, 200, b"b").to_bytes()
    numbers = struct.pack(f"<{len(clock)}q", *clock)
    return JournalRecord(step, 1, 1, 1, numbers, network, writes, b"", b"")


def test_answers_come_in_their_order() -> None:
    feed = Feed([record(clock=(3, 4), network=b"r\x02s\x00")])

    assert [feed.number(), feed.number()] == [3, 4]
    assert [feed.answer(b"r"), feed.answer(b"s")] == [2, 0]
    assert feed.left == ""


def test_a_cycle_that_asks_the_clock_too_often_differs() -> None:
    feed = Feed([record(clock=(3,))])
    feed.number()

    with pytest.raises(Diverged):
        feed.number()
    assert feed.reason == "the clock was asked less often"


def test_where_the_run_had_ended_it_ends_again() -> None:
    feed = Feed([record(Step.SHUTDOWN.value)])

    with pytest.raises(EndOfRecord):
        feed.number()
    assert feed.reason == ""


def test_another_call_of_the_network_differs() -> None:
    feed = Feed([record(network=b"r\x02")])

    with pytest.raises(Diverged, match="asked for 'r', now for 's'"):
        feed.answer(b"s")


def test_what_is_left_of_a_cycle_is_told() -> None:
    assert "clock was asked more often" in Feed([record(clock=(1,))]).left
    assert "network was asked more often" in Feed([record(network=b"r\x02")]).left


def test_writes_come_in_their_latch() -> None:
    feed = Feed([record()])

    assert feed.written(0) == [JournalStore(0, 100, b"a")]
    assert feed.latch() == [JournalStore(1, 200, b"b")]
    assert feed.latch() == []


def test_programs_cannot_catch_a_difference() -> None:
    assert not issubclass(Diverged, Exception)
    assert not issubclass(EndOfRecord, Exception)


def test_a_run_is_asked_to_end_after_as_many_answers_as_then() -> None:
    writes = JournalStore(2, Ending.PAUSE.value, b"").to_bytes()
    feed = Feed([JournalRecord(CYCLE, 1, 1, 1, struct.pack("<3q", 7, 8, 9), b"", writes, b"", b"")])
    asked: list[tuple[Ending, int]] = []
    answers: list[int] = []
    feed.end_run = lambda ending: asked.append((ending, len(answers)))

    for _ in range(3):
        answers.append(feed.number())

    assert asked == [(Ending.PAUSE, 1)]  # while the second answer was on its way
    assert feed.written(2) == []
