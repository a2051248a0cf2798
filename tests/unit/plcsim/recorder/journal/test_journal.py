from plcsim.core.traffic import Topic
from plcsim.recorder.journal.journal import TOPICS_EVERY, Journal
from plcsim.recorder.journal.record import JournalStore, entries, numbers_of, record_of

TOPIC = Topic("/chatter", "std_msgs/String", "0" * 32, "string data", "/plc", True, False)


def test_a_record_has_what_came_since_the_last_one() -> None:
    journal = Journal()
    journal.clock += [5, 6]
    journal.network += b"net"
    journal.wrote(100, b"x")
    journal.latched()
    journal.wrote(200, b"y")

    record = record_of(journal.take(0, 1, 7, 99, [b"a", b"ll"]))
    again = record_of(journal.take(0, 1, 8, 100, [b"all"]))

    assert (numbers_of(record.clock), record.network) == ((5, 6), b"net")
    assert record.variables == b"all"
    assert list(entries(record.writes)) == [JournalStore(0, 100, b"x"), JournalStore(1, 200, b"y")]
    assert (again.clock, again.network, again.writes, again.messages) == (b"", b"", b"", [])


def test_topics_are_described_once_and_now_and_then() -> None:
    journal, other = Journal(), TOPIC._replace(name="/other")
    journal.topics = [TOPIC]
    described = {}
    for number in range(TOPICS_EVERY + 1):
        if number == 5:
            journal.topics.append(other)
        if topics := record_of(journal.take(0, 1, 1, 1, [])).topics:
            described[number] = topics

    assert described == {
        0: [(0, TOPIC)],
        5: [(1, other)],
        TOPICS_EVERY - 1: [(0, TOPIC), (1, other)],
    }


def test_messages_keep_their_order() -> None:
    journal = Journal()
    journal.messages += [(0, b"a"), (1, memoryview(b"b")), (0, b"c")]

    assert record_of(journal.take(0, 1, 1, 1, [])).messages == [(0, b"a"), (1, b"b"), (0, b"c")]
