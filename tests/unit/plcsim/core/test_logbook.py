"""The logbook: a ring of fixed length."""

from hypothesis import given
from hypothesis import strategies as st

from plcsim.core.logbook import LENGTH, Entry, Logbook, Severity


@given(st.integers(1, 20), st.integers(0, 60))
def test_the_latest_entries_are_kept_and_the_others_counted(length, written):
    logbook = Logbook(length)
    for number in range(written):
        logbook.write(number, Severity.INFORMATION, "test", str(number))
    kept = range(max(0, written - length), written)
    assert [entry.time_ns for entry in logbook] == list(kept)
    assert len(logbook) == len(kept)
    assert logbook.dropped == written - len(kept)


def test_the_default_length():
    logbook = Logbook()
    for number in range(LENGTH + 5):
        logbook.write(number, Severity.ERROR, "test", "text")
    assert (len(logbook), logbook.dropped) == (LENGTH, 5)


def test_it_may_be_written_while_it_is_read():
    logbook = Logbook(3)
    for number in range(3):
        logbook.write(number, Severity.WARNING, "test", "text")
    for entry in logbook:
        logbook.write(entry.time_ns + 10, Severity.WARNING, "test", "text")
    assert [entry.time_ns for entry in logbook] == [10, 11, 12]


def test_an_entry_is_one_line():
    entry = Entry(12_345_678_901, Severity.ERROR, "conveyor", "division by zero")
    assert str(entry) == "    12.345678 error       conveyor: division by zero"
