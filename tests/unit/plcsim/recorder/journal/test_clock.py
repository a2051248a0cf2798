from plcsim.core.clock import VirtualClock
from plcsim.recorder.journal.clock import RecordedClock, ReplayClock
from plcsim.recorder.journal.feed import Feed
from plcsim.recorder.journal.journal import Journal

from .conftest import taken


def ask(clock: RecordedClock | ReplayClock) -> list[int]:
    answers = [clock.now_ns(), clock.cpu_ns()]
    clock.sleep_until_ns(2_000_000_000)
    return [*answers, clock.waits(), clock.unix_ns(), clock.now_ns()]


def test_a_replay_tells_the_recorded_times() -> None:
    journal = Journal()
    recorded = ask(RecordedClock(VirtualClock(), journal))
    feed = Feed([taken(journal)])

    clock = ReplayClock(feed, is_virtual=True)

    assert ask(clock) == recorded
    assert recorded[-1] == 2_000_000_000
    assert clock.stamp_ns() == 2_000_000_000


def test_a_stamp_is_no_answer() -> None:
    journal = Journal()
    clock = RecordedClock(VirtualClock(), journal)

    assert clock.stamp_ns() == clock.recorded.now_ns()
    assert journal.clock == []
