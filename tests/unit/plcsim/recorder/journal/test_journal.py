from plcsim.recorder.journal.journal import Journal
from plcsim.recorder.journal.record import JournalStore, entries


def test_a_write_is_noted_with_the_latch_that_brought_it() -> None:
    journal = Journal()
    journal.wrote(100, b"x")
    journal.latches.append(None)
    journal.wrote(200, b"y")
    journal.handed_in("/plc", "/chatter", b"z")

    assert list(entries(journal.writes)) == [
        JournalStore(0, 100, b"x"),
        JournalStore(1, 200, b"y"),
        JournalStore(1, 16, b"/plc\0/chatter\0z"),
    ]
