from hypothesis import given
from hypothesis import strategies as st

from plcsim.recorder.journal.record import (
    JournalMessage,
    JournalRecord,
    JournalStore,
    entries,
    packet_head,
    packets,
    record_head,
    record_of,
)

I64 = st.integers(-(1 << 63), (1 << 63) - 1)
U32 = st.integers(0, (1 << 32) - 1)


@given(
    st.builds(
        JournalRecord,
        st.integers(0, 255),
        st.integers(0, 255),
        I64,
        I64,
        *[st.binary(max_size=50)] * 5,
    )
)
def test_a_record_is_what_its_bytes_say(record: JournalRecord) -> None:
    step, task_class, cycle, time_ns, *parts = record
    clock, network, writes, messages, _ = map(len, parts)
    head = record_head(step, task_class, (clock, network, writes, messages), cycle, time_ns)
    assert record_of(b"".join((head, *parts))) == record


@given(st.lists(st.builds(JournalStore, U32, U32, st.binary(max_size=20)), max_size=5))
def test_entries_are_read_one_after_another(written: list[JournalStore]) -> None:
    assert list(entries(b"".join(each.to_bytes() for each in written))) == written


@given(
    st.lists(
        st.builds(JournalMessage, st.integers(0, 65535), st.booleans(), st.binary()), max_size=5
    )
)
def test_packets_are_read_one_after_another(sent: list[JournalMessage]) -> None:
    data = b"".join(
        packet_head(each.topic, len(each.data), is_topic=each.is_topic) + each.data for each in sent
    )

    assert list(packets(data)) == sent
