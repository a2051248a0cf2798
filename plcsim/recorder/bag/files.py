"""The formats of bags: ROS 1, and ROS 2 in sqlite3 or MCAP, by the end of the file's name.

A file that is being written ends in ``.active``. What has been written is in the file within
`FLUSH_NS`, so that little is missing where the recorder is killed; ``rosbag reindex`` then makes a
ROS 1 bag readable.
"""

from __future__ import annotations

import shutil
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Protocol

from plcsim.recorder.bag.names import SUFFIXES, active
from plcsim.recorder.bag.ros1_bag import Ros1Bag
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
    from collections.abc import Sequence
    from pathlib import Path

    from plcsim.core.traffic import Topic
    from plcsim.recorder.bag.ros1_bag import Rows


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

    def write(self, time_ns: int, messages: Sequence[tuple[Any, bytes]]) -> None:
        """Write messages of one time, as ROS 1 serialises them, each with its connection."""

    def write_rows(self, time_ns: int, connections: Sequence[Any], rows: Rows) -> None:
        """Write messages of one time that are equally long: one row of bytes for each."""

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

    def write(self, time_ns: int, messages: Sequence[tuple[Any, bytes]]) -> None:
        """See `Bag`."""
        store = typestore(ros2=True)
        for connection, data in messages:
            type_name = self._types[connection.id]
            told = log_message_2(data) if type_name == LOG_TYPE_2 else data
            cdr = store.ros1_to_cdr(told, type_name)
            self._writer.write(connection, time_ns, cdr)
            self._size += len(cdr)

    def write_rows(self, time_ns: int, connections: Sequence[Any], rows: Rows) -> None:
        """See `Bag`."""
        self.write(time_ns, [(c, row.tobytes()) for c, row in zip(connections, rows, strict=True)])

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
