"""MCAP files are read by the format's own library, as Foxglove and PlotJuggler use it."""

from pathlib import Path

import pytest

from plcsim.recorder.bag.reading import open_bag

from ..conftest import Fast, Recordings, application_of

mcap = pytest.importorskip("mcap.reader")


@pytest.fixture
def file(recordings: Recordings) -> Path:
    return recordings("a.mcap", application_of(Fast), tags=["Fast.count", "Fast.name"])


def test_topics_types_and_counts_are_there(file: Path) -> None:
    with file.open("rb") as stream:
        summary = mcap.make_reader(stream, validate_crcs=True).get_summary()
    schemas = {each.id: each for each in summary.schemas.values()}
    counts = summary.statistics.channel_message_counts
    found = {
        each.topic: (schemas[each.schema_id].name, each.message_encoding, counts.get(each.id, 0))
        for each in summary.channels.values()
    }
    assert found["/Fast/count"] == ("std_msgs/msg/UInt32", "cdr", 40)
    assert found["/Fast/name"] == ("std_msgs/msg/String", "cdr", 1)
    assert found["/plcsim/cycles"] == ("plcsim_msgs/msg/Cycle", "cdr", 46)
    assert {each.encoding for each in schemas.values()} == {"ros2msg"}


def test_its_messages_are_ours(file: Path) -> None:
    with file.open("rb") as stream:
        theirs = [
            (channel.topic, message.log_time, message.data)
            for _, channel, message in mcap.make_reader(stream, validate_crcs=True).iter_messages()
        ]
    with open_bag(file) as bag:
        ours = [(each.topic, each.time_ns, each.data) for each in bag.messages()]
    assert sorted(theirs) == sorted(ours)
