"""Reads recordings, and bags of others."""

from __future__ import annotations

import json
import struct
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple

from plcsim.recorder.bag.changes import changed
from plcsim.recorder.bag.head import head_from
from plcsim.recorder.bag.names import ACTIVE, active
from plcsim.recorder.bag.types import CYCLES, HEAD, cycle_from, typestore
from plcsim.recorder.errors import RecordingError
from plcsim.recorder.journal.record import CYCLE, JournalRecord

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator
    from pathlib import Path

    from plcsim.recorder.bag.head import Head


class BagMessage(NamedTuple):
    """A message of a bag.

    Attributes:
        topic: its topic.
        type_name: such as ``std_msgs/msg/Bool``.
        time_ns: when it was recorded.
        data: as it lies in the bag.
        is_cdr: as ROS 2 serialises, not as ROS 1.
    """

    topic: str
    type_name: str
    time_ns: int
    data: bytes
    is_cdr: bool

    @property
    def as_ros1(self) -> bytes:
        """The message as ROS 1 serialises it; its type is one of `typestore`."""
        if not self.is_cdr:
            return self.data
        return bytes(typestore(ros2=True).cdr_to_ros1(self.data, self.type_name))


class BagTopic(NamedTuple):
    """A topic of a bag.

    Attributes:
        name: such as ``/chatter``.
        type_name: such as ``std_msgs/msg/String``.
        messages: how many there are.
        digest: of the type, as ROS 1 or ROS 2 computes it.
        definition: text of the type with all it contains.
        is_latching: who comes later gets the last message.
    """

    name: str
    type_name: str
    messages: int
    digest: str
    definition: str
    is_latching: bool


class BagReader:
    """A bag that is open.

    Attributes:
        path: of the file.
        topics: what it holds.
        start_ns: time of the first message.
        end_ns: time of the last one.
    """

    def __init__(self, path: Path, reader: Any, *, is_cdr: bool) -> None:
        self.path = path
        self._reader = reader
        self._is_cdr = is_cdr
        found: dict[tuple[str, str], BagTopic] = {}
        for each in reader.connections:
            topic = _topic_of(each)
            key = topic.name, topic.type_name
            before = found.get(key)
            count = topic.messages + (before.messages if before else 0)
            found[key] = topic._replace(messages=count)
        self.topics = [found[key] for key in sorted(found)]
        self.start_ns: int = reader.start_time if reader.message_count else 0
        self.end_ns: int = reader.end_time if reader.message_count else 0

    def messages(self, topics: Collection[str] = ()) -> Iterator[BagMessage]:
        """Return messages in the order of their times; of all topics where none are named.

        Raises:
            RecordingError: the bag is damaged.
        """
        chosen = [c for c in self._reader.connections if not topics or c.topic in topics]
        if not chosen:
            return
        with _told(self.path):
            if not self._is_cdr:
                named = {c.id: (c.topic, c.msgtype) for c in chosen}
                from plcsim.recorder.bag.chunks import messages  # noqa: PLC0415  # as below

                for number, time_ns, data in messages(self._reader, named):
                    yield BagMessage(*named[number], time_ns, data, is_cdr=False)
                return
            for connection, time_ns, data in self._reader.messages(connections=chosen):
                yield BagMessage(
                    connection.topic, connection.msgtype, time_ns, bytes(data), self._is_cdr
                )

    def head(self) -> Head:
        """Return what was recorded.

        Raises:
            RecordingError: plcsim has not recorded it.
        """
        for message in self.messages([HEAD]):
            (size,) = struct.unpack_from("<I", message.as_ros1)
            try:
                return head_from(json.loads(message.as_ros1[4 : 4 + size]))
            except (ValueError, KeyError, TypeError) as err:
                raise RecordingError(f"{self.path}: {HEAD} is no recording: {err}") from None
        raise RecordingError(
            f"{self.path}: was not recorded by plcsim: it has no topic {HEAD}; plcsim replay "
            "plays its messages to a project"
        )

    def records(self) -> Iterator[tuple[int, JournalRecord]]:
        """Return the records with their numbers, the variables of each whole.

        Raises:
            RecordingError: the bag is damaged.
        """
        before = b""
        for message in self.messages([CYCLES]):
            cycle = cycle_from(message.as_ros1)
            if cycle.step == CYCLE:
                before = cycle.variables if cycle.whole else changed(before, cycle.variables)
            yield (
                cycle.number,
                JournalRecord(
                    cycle.step,
                    cycle.task_class,
                    cycle.cycle,
                    cycle.time_ns,
                    cycle.clock,
                    cycle.network,
                    cycle.writes,
                    before if cycle.step == CYCLE else cycle.variables,
                ),
            )


def _topic_of(connection: Any) -> BagTopic:
    return BagTopic(
        connection.topic,
        connection.msgtype,
        connection.msgcount,
        connection.digest,
        connection.msgdef.data,
        bool(getattr(connection.ext, "latching", 0)),
    )


@contextmanager
def open_bag(path: Path) -> Iterator[BagReader]:
    """Open a bag of ROS 1 or ROS 2.

    Raises:
        RecordingError: it is none, it is damaged, or it was not closed.
    """
    typestore()
    from rosbags import rosbag2  # noqa: PLC0415

    from plcsim.recorder.bag.chunks import ChunkReader  # noqa: PLC0415  # needs rosbags

    if not path.exists():
        left = active(path)
        hint = f"; {left.name} was not closed: plcsim bag reindex {left}" if left.exists() else ""
        raise RecordingError(f"{path}: there is no such file{hint}")
    is_ros2 = path.is_dir() or path.suffix in (".mcap", ".db3")
    with _told(path):
        reader: Any = rosbag2.Reader(path) if is_ros2 else ChunkReader(path)
        reader.open()
    try:
        yield BagReader(path, reader, is_cdr=is_ros2)
    finally:
        reader.close()


@contextmanager
def _told(path: Path) -> Iterator[None]:
    """Turn what rosbags raises at a bag that is none, or a damaged one, into one error."""
    from rosbags.rosbag1 import ReaderError  # noqa: PLC0415
    from rosbags.rosbag2 import ReaderError as Reader2Error  # noqa: PLC0415

    try:
        yield
    except (ReaderError, Reader2Error) as err:
        text, *_ = str(err).split(": (")  # behind it an exception as Python shows it
        if "index" not in text:
            raise RecordingError(f"{path}: is damaged or no bag: {text}") from None
        output = "" if path.suffix == ACTIVE else f" --output {path.stem}_reindexed.bag"
        hint = f"plcsim bag reindex {path}{output} makes readable what is there"
        raise RecordingError(f"{path}: {text.removesuffix('.')}: {hint}") from None
    except (OSError, AssertionError, KeyError, ValueError, struct.error, IndexError) as err:
        raise RecordingError(f"{path}: is damaged or no bag: {err}") from None
