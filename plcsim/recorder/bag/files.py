"""The formats of bags: ROS 1, and ROS 2 in sqlite3 or MCAP, by the end of the file's name.

A file that is being written ends in ``.active``. What has been written is in the file within
`FLUSH_NS`, so that little is missing where the recorder is killed; ``rosbag reindex`` then makes a
ROS 1 bag readable.
"""

from __future__ import annotations

import shutil
import struct
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Final, Protocol

from plcsim.recorder.bag.types import (
    LOG_TYPE,
    LOG_TYPE_2,
    log_message_2,
    register,
    stored_name,
    typestore,
)
from plcsim.recorder.errors import RecordingError

if TYPE_CHECKING:
    from io import BytesIO
    from pathlib import Path

    from plcsim.core.traffic import Topic

ACTIVE: Final = ".active"
SUFFIXES: Final = (".bag", ".mcap", ".db3")

_MAGIC_SIZE: Final = 13
HEADER_SIZE: Final = 4096
"""Bytes that header and padding of the first record have in a bag of ROS 1 (rosbag's bag.cpp)."""

_MESSAGE: Final = struct.Struct("<II4sI5sII5sIII")
_FIELDS: Final = (38, 4, b"op=\x02", 9, b"conn=")
_TIME: Final = (13, b"time=")
"""A message's record: header with op, conn and time, then the length of its data (rosbag 2.0)."""


class Bag(Protocol):
    """A bag that is being written."""

    @property
    def size(self) -> int:
        """Bytes so far, roughly."""

    def add(self, topic: str, type_name: str, *, latching: bool = False) -> Any:
        """Return a connection for messages of a type such as ``std_msgs/msg/Bool``."""

    def add_foreign(self, topic: Topic) -> Any:
        """Return a connection for messages of a type that comes with its definition.

        Raises:
            RecordingError: the format has no such type.
        """

    def write(self, connection: Any, time_ns: int, data: bytes) -> None:
        """Write a message, as ROS 1 serialises it."""

    def flush(self) -> None:
        """Bring what was written into the file."""

    def close(self) -> None:
        """Write the index and end."""

    def abandon(self) -> None:
        """End without an index; what is in the file stays, under its ``.active`` name."""


def create(path: Path) -> Bag:
    """Create a bag; the format goes by the end of the name.

    Raises:
        RecordingError: there is such a file, or it cannot be made.
    """
    if path.suffix not in SUFFIXES:
        raise RecordingError(f"{path}: the name of a bag ends in {', '.join(SUFFIXES)}")
    typestore()
    for file in (path, active(path)):
        if file.exists():
            raise RecordingError(f"{file}: exists already, and is not written over")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        return Ros1Bag(path) if path.suffix == ".bag" else Ros2Bag(path)
    except OSError as err:
        _remove(active(path))
        raise RecordingError(f"{path}: cannot be made: {err}") from None


def _remove(path: Path) -> None:
    """Take away what could not be begun: nothing is in it."""
    with suppress(OSError):
        if path.is_dir():
            shutil.rmtree(path)
        else:
            path.unlink()


def active(path: Path) -> Path:
    """Return the name of a bag while it is being written."""
    return path.with_name(path.name + ACTIVE)


class Ros1Bag:
    """A bag of ROS 1.

    rosbags 0.11 gives the first record eight bytes less than ROS does; ``rosbag reindex`` would
    then write over the first chunk. And it keeps the place of every message until the end; here,
    only how many there are.
    """

    def __init__(self, path: Path) -> None:
        from rosbags.rosbag1 import Writer  # noqa: PLC0415

        self._path = path
        self._active = active(path)
        self._writer = Writer(self._active)
        self._writer.open()
        assert self._writer.bio is not None
        self._file = self._writer.bio
        self._file.write(b" " * 8)
        self._written = self._file.tell()
        self._file.flush()
        self._stretch()

    def _stretch(self) -> None:
        """Make the padding of the first record as long as it is with ROS."""
        with self._active.open("r+b", buffering=0) as file:
            file.seek(_MAGIC_SIZE)
            header = int.from_bytes(file.read(4), "little")
            file.seek(_MAGIC_SIZE + 4 + header)
            file.write((HEADER_SIZE - header).to_bytes(4, "little"))

    @property
    def size(self) -> int:
        """Bytes in the file, and in the chunk that is being filled."""
        chunk: BytesIO = self._writer.chunks[-1].data
        return self._written + chunk.tell()

    def add(self, topic: str, type_name: str, *, latching: bool = False) -> Any:
        """See `Bag`."""
        return self._writer.add_connection(
            topic, type_name, typestore=typestore(), callerid="/plcsim", latching=int(latching)
        )

    def add_foreign(self, topic: Topic) -> Any:
        """See `Bag`."""
        return self._writer.add_connection(
            topic.name,
            stored_name(topic.type_name),
            msgdef=topic.definition,
            md5sum=topic.md5sum,
            callerid=topic.node if topic.is_sent else f"{topic.node}/received",
            latching=int(topic.is_latching),
        )

    def write(self, connection: Any, time_ns: int, data: bytes) -> None:
        """See `Bag`."""
        # as Writer.write does, in a third of its time: its headers are made field by field
        chunk = self._writer.chunks[-1]
        out = chunk.data
        chunk.connections[connection.id].append((time_ns, out.tell()))
        chunk.start = min(chunk.start, time_ns)
        chunk.end = max(chunk.end, time_ns)
        seconds, nanoseconds = divmod(time_ns, 1_000_000_000)
        out.write(_MESSAGE.pack(*_FIELDS, connection.id, *_TIME, seconds, nanoseconds, len(data)))
        out.write(data)
        if out.tell() > self._writer.chunk_threshold:
            self._writer.write_chunk(chunk)
            self._shrink()

    def _shrink(self) -> None:
        """Keep of the places of messages in chunks that are written only how many there are."""
        written: dict[int, Any] = self._writer.chunks[-2].connections
        for number, places in written.items():
            written[number] = range(len(places))
        self._written = self._file.tell()

    def flush(self) -> None:
        """See `Bag`."""
        chunk = self._writer.chunks[-1]
        if chunk.connections:
            self._writer.write_chunk(chunk)
            self._shrink()
        self._file.flush()

    def close(self) -> None:
        """See `Bag`."""
        self.flush()
        self._writer.close()
        self._stretch()
        self._active.rename(self._path)

    def abandon(self) -> None:
        """See `Bag`."""
        with suppress(OSError):
            self._writer.abort()


class Ros2Bag:
    """A bag of ROS 2, one file: MCAP or sqlite3; messages are CDR."""

    def __init__(self, path: Path) -> None:
        from rosbags.rosbag2 import StoragePlugin, Writer  # noqa: PLC0415

        self._path = path
        self._folder = active(path)
        self._folder.mkdir()  # in it, for rosbags names the file by its folder, and notes that name
        plugin = StoragePlugin.MCAP if path.suffix == ".mcap" else StoragePlugin.SQLITE3
        self._writer = Writer(self._folder / path.stem, version=9, storage_plugin=plugin)
        self._writer.open()
        self._types: dict[int, str] = {}
        self._size = 0

    @property
    def size(self) -> int:
        """Bytes of the messages."""
        return self._size

    def add(self, topic: str, type_name: str, *, latching: bool = False) -> Any:
        """See `Bag`; what is latched is not told: ROS 2 has that in profiles."""
        if type_name == LOG_TYPE:
            type_name = LOG_TYPE_2
        store = typestore(ros2=True)
        connection = self._writer.add_connection(topic, type_name, typestore=store)
        self._types[connection.id] = type_name
        return connection

    def add_foreign(self, topic: Topic) -> Any:
        """See `Bag`."""
        name = stored_name(topic.type_name)
        register(name, topic.definition)
        return self.add(topic.name, name)

    def write(self, connection: Any, time_ns: int, data: bytes) -> None:
        """See `Bag`."""
        type_name = self._types[connection.id]
        if type_name == LOG_TYPE_2:
            data = log_message_2(data)
        cdr = typestore(ros2=True).ros1_to_cdr(data, type_name)
        self._writer.write(connection, time_ns, cdr)
        self._size += len(cdr)

    def flush(self) -> None:
        """See `Bag`; rosbags writes at its own pace."""

    def close(self) -> None:
        """See `Bag`."""
        self._writer.close()
        (self._folder / self._path.stem / self._path.name).rename(self._path)
        shutil.rmtree(self._folder)

    def abandon(self) -> None:
        """See `Bag`."""
        with suppress(OSError):
            self._writer.close()
