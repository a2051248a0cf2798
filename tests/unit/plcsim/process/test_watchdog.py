"""The watchdog: what it makes of a scan process that does not go on."""

import pytest

from plcsim.process.watchdog import (
    BLIND_NS,
    PATIENCE_NS,
    TRANSITIONS,
    Sight,
    Sign,
    Watch,
    Watchdog,
)

MS = 1_000_000
LIMIT_NS = 500 * MS
LOOK_NS = 20 * MS


class Scan:
    """A scan process that is looked at every 20 ms."""

    def __init__(self):
        self.watchdog = Watchdog()
        self.now_ns = 10_000 * MS
        self.heartbeat = 0

    def look(self, step_ns=LOOK_NS, *, beats=0, limit_ns=LIMIT_NS, has_started=True, **sight):
        self.now_ns += step_ns
        self.heartbeat += beats
        return self.watchdog.look(
            Sight(self.now_ns, self.heartbeat, limit_ns, has_started, **sight)
        )

    def silent_until(self, sign, **sight):
        """Look until the watchdog gives a sign; return the silence in ms."""
        begin_ns = self.now_ns
        for _ in range(1000):
            found = self.look(**sight)
            if found is not None:
                assert found is sign
                return (self.now_ns - begin_ns) // MS
        raise AssertionError(f"no {sign}")


@pytest.fixture
def scan():
    return Scan()


@pytest.fixture
def running(scan):
    assert scan.look() is Sign.LOADS
    assert scan.watchdog.watch is Watch.LOADING
    assert scan.look(beats=1) is Sign.BEAT
    assert scan.watchdog.watch is Watch.RUNNING
    return scan


def test_a_process_that_never_starts(scan):
    overdue_ms = scan.silent_until(Sign.OVERDUE, has_started=False)
    assert overdue_ms == 540  # the first look only begins to count
    assert scan.watchdog.watch is Watch.KILLED


def test_programs_that_are_never_loaded_have_the_limit_since_loading_began(scan):
    for _ in range(100):
        assert scan.look(limit_ns=10_000 * MS, has_started=False) is None
    assert scan.look() is Sign.LOADS
    assert scan.silent_until(Sign.OVERDUE) == 520
    assert scan.watchdog.watch is Watch.KILLED
    assert scan.watchdog.limit_ns == LIMIT_NS


def test_as_long_as_the_heart_beats_all_is_well(running):
    assert [running.look(beats=1) for _ in range(100)] == [None] * 100


def test_a_program_that_does_not_return_is_interrupted_and_then_killed(running):
    assert running.silent_until(Sign.OVERDUE) == 520
    assert running.watchdog.watch is Watch.STALLED
    assert running.silent_until(Sign.DEAF, limit_ns=7) == 1020
    assert running.watchdog.watch is Watch.KILLED
    assert running.watchdog.limit_ns == LIMIT_NS  # that of what was interrupted
    assert running.look(beats=1) is running.watchdog.give_up() is None


def test_a_program_that_was_interrupted_may_go_on(running):
    running.silent_until(Sign.OVERDUE)
    assert running.look(beats=1) is Sign.BEAT
    assert running.watchdog.watch is Watch.RUNNING
    assert running.silent_until(Sign.OVERDUE) == 520


def test_the_limit_is_that_of_what_is_going_on_now(running):
    for _ in range(100):
        assert running.look(limit_ns=10_000 * MS) is None
    assert running.look(limit_ns=LIMIT_NS) is Sign.OVERDUE


def test_a_process_that_has_left_its_result_has_little_time_to_end(running):
    assert running.look(has_result=True) is Sign.RESULT
    assert running.silent_until(Sign.LINGERS, has_result=True) == 1020


def test_a_result_is_more_than_silence(scan):
    for _ in range(26):
        scan.look()
    assert scan.look(LOOK_NS, has_result=True) is Sign.RESULT
    assert scan.watchdog.watch is Watch.ENDING


@pytest.mark.parametrize("watch", [Watch.STARTING, Watch.LOADING, Watch.RUNNING, Watch.STALLED])
def test_somebody_who_gives_up_has_it_killed(scan, watch):
    scan.watchdog.watch = watch
    assert scan.watchdog.give_up() is Sign.GIVEN_UP
    assert scan.watchdog.watch is Watch.KILLED


def test_who_waits_for_a_reader_is_not_blamed(running):
    for _ in range(1000):
        assert running.look(waits_for_reader=True) is None
    assert running.silent_until(Sign.OVERDUE) == 520


def test_a_time_in_which_the_watchdog_did_not_look_counts_little(running):
    assert running.look(3_600_000 * MS) is None  # a container that was frozen
    assert running.silent_until(Sign.OVERDUE) == 520 - BLIND_NS // MS


def test_a_program_that_gets_no_processor_is_not_blamed(running):
    for _ in range(1000):
        assert running.look(processor_ns=7 * MS) is None


def test_a_program_has_its_limit_of_processor_time_on_a_busy_host(running):
    begin_ns = running.now_ns
    used_ns = 0
    while running.look(processor_ns=used_ns) is None:
        used_ns += LOOK_NS // 4
    # the first look knows nothing of the time before it
    assert running.now_ns - begin_ns == 4 * LIMIT_NS - 2 * LOOK_NS
    assert running.watchdog.watch is Watch.STALLED


def test_a_program_that_waits_for_something_else_has_its_limit_of_time(running):
    assert running.look(processor_ns=3) is None
    assert running.silent_until(Sign.OVERDUE, processor_ns=None) == 500


def test_every_state_has_a_row_and_leads_to_the_end():
    assert set(TRANSITIONS) == set(Watch)
    for watch, row in TRANSITIONS.items():
        assert watch is Watch.KILLED or Watch.KILLED in row.values() or Watch.ENDING in row.values()
    assert PATIENCE_NS == 1_000 * MS
