import json

from plcsim.core.traffic import Topic
from plcsim.recorder.journal.journal import TOPIC_EVERY, Journal
from plcsim.recorder.journal.record import JournalStore, entries, numbers_of, packets, record_of

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
    assert (again.clock, again.network, again.writes, again.messages) == (b"", b"", b"", b"")


def test_a_topic_is_described_before_its_first_message_and_now_and_then() -> None:
    journal = Journal()
    for _ in range(TOPIC_EVERY + 1):
        journal.crossed(TOPIC, b"hello")

    sent = list(packets(record_of(journal.take(0, 1, 1, 1, [])).messages))

    described = [number for number, each in enumerate(sent) if each.is_topic]
    assert described == [0, TOPIC_EVERY + 1]
    assert Topic(**json.loads(sent[0].data)) == TOPIC
    assert {each.data for each in sent if not each.is_topic} == {b"hello"}


def test_topics_have_numbers_of_their_own() -> None:
    journal = Journal()
    journal.crossed(TOPIC, b"a")
    journal.crossed(TOPIC._replace(name="/other"), b"b")

    assert {p.topic for p in packets(record_of(journal.take(0, 1, 1, 1, [])).messages)} == {0, 1}
