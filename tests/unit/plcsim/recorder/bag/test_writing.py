from dataclasses import replace
from pathlib import Path

import pytest

from plcsim.core.control import Step
from plcsim.core.controller import Controller
from plcsim.core.errors import TagError
from plcsim.core.logbook import Severity
from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.bag.types import LOGBOOK
from plcsim.recorder.bag.writing import Limits, Writing
from plcsim.recorder.errors import RecordingError

from ..conftest import Fast, Recordings, Slow, application_of


def files(folder: Path) -> list[str]:
    return sorted(each.name for each in folder.glob("*"))


def test_chosen_tags_are_messages_whenever_they_change(recordings: Recordings) -> None:
    bag = recordings("a.bag", application_of(Fast, Slow), tags=("Fast.count", "Fast.name", "Slow"))

    with open_bag(bag) as reader:
        topics = {t.name: (t.type_name, t.messages) for t in reader.topics}
        counts = [m.data for m in reader.messages(["/Fast/count"])]
        names = [m.data for m in reader.messages(["/Fast/name"])]
    assert topics["/Fast/count"] == ("std_msgs/msg/UInt32", 40)
    assert topics["/Slow/level"][0] == "std_msgs/msg/Float32"
    assert "/Fast/told" not in topics
    assert counts[:2] == [b"\1\0\0\0", b"\2\0\0\0"]
    assert names == [b"\4\0\0\0fast"]


def test_a_tag_that_is_not_there_is_told(recordings: Recordings) -> None:
    with pytest.raises(TagError, match=r"Fast\.cuont"):
        recordings("a.bag", application_of(Fast), tags=("Fast.cuont",))


def test_the_next_file_begins_after_a_time_and_the_oldest_goes(recordings: Recordings) -> None:
    application = application_of(Fast)
    recordings("a.bag", application, duration_ns=100_000_000, files=2)

    left = files(recordings.folder)
    assert len(left) == 2
    assert left[0].startswith("a_")
    with open_bag(recordings.folder / left[0]) as reader:
        assert reader.head().project == recordings.folder.name
        first = next(record for _, record in reader.records() if record.step == 0)
    assert first.cycle > 1
    assert int.from_bytes(first.variables[:4], "little") == first.cycle  # whole again


def test_the_next_file_begins_at_a_size(recordings: Recordings) -> None:
    recordings("a.bag", application_of(Fast), size=6_000)

    assert len(files(recordings.folder)) > 1


def test_the_end_of_the_controller_is_the_last_record(recordings: Recordings) -> None:
    with open_bag(recordings("a.bag", application_of(Fast))) as bag:
        *_, (_, last) = bag.records()

    assert last.step == Step.CLOSE.value


def test_the_logbook_is_in_the_bag(recordings: Recordings) -> None:
    def log(controller: Controller) -> None:
        controller.log(Severity.WARNING, "test", "look here")

    with open_bag(recordings("a.bag", application_of(Fast), act=log)) as reader:
        texts = [message.data for message in reader.messages([LOGBOOK])]
    assert any(b"look here" in text for text in texts)


def test_a_file_that_is_there_is_left_alone(recordings: Recordings) -> None:
    recordings("a.bag", application_of(Fast))
    before = (recordings.folder / "a.bag").read_bytes()

    with pytest.raises(RecordingError, match="exists already"):
        recordings("a.bag", application_of(Fast))
    assert (recordings.folder / "a.bag").read_bytes() == before


def test_tags_can_be_left_out_of_a_cycle_and_its_variables_not(recordings: Recordings) -> None:
    with open_bag(recordings("a.bag", application_of(Fast))) as reader:
        head, records = reader.head(), list(reader.records())
    writing = Writing(recordings.folder / "b.bag", replace(head, tags=("Fast.count",)), Limits())
    for number, record in records:
        writing.record(number, record, with_tags=record.cycle == 40)
    writing.close()

    with open_bag(recordings.folder / "b.bag") as reader:
        assert [m.data for m in reader.messages(["/Fast/count"])] == [b"\x28\0\0\0"]
        assert [r.variables for _, r in reader.records()] == [r.variables for _, r in records]
