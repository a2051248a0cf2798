"""Records make room for one another; events are numbers."""

from plcsim.library.areventlog.logs import RECORD_SIZE, EventLog, EventRecord, event_id, severity_of


def record(data=b""):
    return EventRecord(0, 0, "", 0, data, 0)


def test_the_oldest_records_make_room():
    log = EventLog("mine", 3 * RECORD_SIZE)
    assert [log.write(record()) for _ in range(5)] == [1, 2, 3, 4, 5]
    assert [*log.records] == [3, 4, 5]
    log.write(record(b"x" * RECORD_SIZE))
    assert [*log.records] == [5, 6]


def test_a_record_that_fills_the_log_alone():
    log = EventLog("mine", RECORD_SIZE)
    log.write(record())
    log.write(record(b"x" * 10))
    assert [*log.records] == [2]
    log.write(record())
    assert [*log.records] == [3]


def test_severity_is_in_the_event():
    for severity in range(4):
        assert severity_of(event_id(severity, 0xFFF, 0xFFFF, is_customer=True)) == severity
