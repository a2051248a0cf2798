"""Writes bags of ROS 1; what a recorder does most is done for many messages at once.

rosbags describes the connections; its writer takes 2 us for a message, keeps the places of all, and
gives the first record eight bytes less than ROS does, so that ``rosbag reindex`` would write over
the first chunk. Here the messages of a cycle are one piece of the chunk, the index of a chunk is
made by sorting, and what tells of the chunks at the end waits in a file without a name: a bag may
grow as long as it likes, the memory does not.
"""

from __future__ import annotations

import shutil
import struct
import tempfile
from contextlib import suppress
from itertools import accumulate
from typing import TYPE_CHECKING, Final

import numpy as np

from plcsim.recorder.bag.names import active
from plcsim.recorder.bag.ros1_records import (
    CHUNK,
    INDEX,
    MAGIC,
    MESSAGE,
    PLACE,
    bag_header,
    chunk_info,
    fields_of,
    record,
)
from plcsim.recorder.bag.types import stored_name, typestore

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from plcsim.core.traffic import Topic

    Rows = NDArray[np.uint8]

CHUNK_SIZE: Final = 1 << 20
"""Bytes after which a chunk is written."""

_SECOND_NS: Final = 1_000_000_000
_STAMP: Final = struct.Struct("<II")
_TO_TIME: Final = 34
"""Bytes of a message's record before its time: header with op and conn."""

_TO_DATA: Final = 46
"""Bytes of a message's record before its data: those, time and length of the data."""


class Ros1Bag:
    """A bag of ROS 1; a connection is its number.

    Args:
        path: of the file, when it is closed.
        chunk_size: bytes after which a chunk is written.
    """

    def __init__(self, path: Path, chunk_size: int = CHUNK_SIZE) -> None:
        from rosbags.rosbag1 import Writer  # noqa: PLC0415  # an extra

        self._path = path
        self._active = active(path)
        self._chunk_size = chunk_size
        self._writer = Writer(self._active)
        self._writer.open()
        assert self._writer.bio is not None
        self._file = self._writer.bio
        self._file.seek(0)
        self._file.write(MAGIC + bag_header(0, 0, 0))
        self._file.flush()
        self._written = self._file.tell()
        self._infos = tempfile.TemporaryFile(dir=path.parent)  # noqa: SIM115  # closed by close
        self._heads: list[bytes] = []
        self._head_rows: Rows = np.empty((0, _TO_TIME), np.uint8)
        self._chunks = 0
        self._begin()

    def _begin(self) -> None:
        """Begin a chunk."""
        self._data = bytearray()
        self._first_ns, self._last_ns = 1 << 63, 0
        self._stamps: list[tuple[int, int, int]] = []  # seconds, nanoseconds, messages
        self._numbers: list[int] = []
        self._places: list[int] = []

    @property
    def size(self) -> int:
        """Bytes in the file, and in the chunk that is being filled."""
        return self._written + len(self._data)

    def add(self, topic: str, type_name: str, *, latching: bool = False) -> int:
        """See `plcsim.recorder.bag.files.Bag`."""
        connection = self._writer.add_connection(
            topic, type_name, typestore=typestore(), callerid="/plcsim", latching=int(latching)
        )
        return self._added(connection.id)

    def add_foreign(self, topic: Topic) -> int:
        """See `plcsim.recorder.bag.files.Bag`."""
        connection = self._writer.add_connection(
            topic.name,
            stored_name(topic.type_name),
            msgdef=topic.definition,
            md5sum=topic.md5sum,
            callerid=topic.node if topic.is_sent else f"{topic.node}/received",
            latching=int(topic.is_latching),
        )
        return self._added(connection.id)

    def _added(self, number: int) -> int:
        """Take what describes a connection into this chunk."""
        described = self._writer.chunks[-1].data
        self._data += described.getvalue()
        described.seek(0)
        described.truncate()
        fields = fields_of(conn=number)
        head = record(MESSAGE, fields + fields_of(time=bytes(8)), b"")
        self._heads.append(head[:_TO_TIME])
        self._head_rows = np.frombuffer(b"".join(self._heads), np.uint8).reshape(-1, _TO_TIME)
        return number

    def write(self, time_ns: int, messages: Sequence[tuple[int, bytes]]) -> None:
        """See `plcsim.recorder.bag.files.Bag`."""
        stamp = divmod(time_ns, _SECOND_NS)
        time = _STAMP.pack(*stamp)
        heads = self._heads
        parts: list[bytes] = []
        for number, data in messages:
            parts += heads[number], time, len(data).to_bytes(4, "little"), data
        sizes = [_TO_DATA + len(data) for _, data in messages]
        places = [*accumulate(sizes, initial=len(self._data))][:-1]
        self._add(time_ns, stamp, [number for number, _ in messages], places, b"".join(parts))

    def write_rows(self, time_ns: int, connections: Sequence[int], rows: Rows) -> None:
        """See `plcsim.recorder.bag.files.Bag`."""
        stamp = divmod(time_ns, _SECOND_NS)
        count, size = rows.shape
        first, width = len(self._data), _TO_DATA + size
        made = np.empty((count, width), np.uint8)
        made[:, :_TO_TIME] = self._head_rows[connections]
        made[:, _TO_TIME:_TO_DATA] = np.frombuffer(PLACE.pack(*stamp, size), np.uint8)
        made[:, _TO_DATA:] = rows
        places = range(first, first + count * width, width)
        self._add(time_ns, stamp, connections, places, made.tobytes())

    def _add(
        self,
        time_ns: int,
        stamp: tuple[int, int],
        numbers: Sequence[int],
        places: Sequence[int],
        data: bytes,
    ) -> None:
        """Add messages of one time to the chunk."""
        self._first_ns = min(self._first_ns, time_ns)
        self._last_ns = max(self._last_ns, time_ns)
        self._stamps.append((*stamp, len(numbers)))
        self._numbers += numbers
        self._places += places
        self._data += data
        if len(self._data) >= self._chunk_size:
            self._write_chunk()

    def _write_chunk(self) -> None:
        """Write the chunk that is open, and its index."""
        fields = fields_of(compression=b"none", size=len(self._data))
        index, info = self._index(self._written)
        self._file.write(record(CHUNK, fields, self._data) + index)
        self._infos.write(info)
        self._written = self._file.tell()
        self._chunks += 1
        self._begin()

    def _index(self, position: int) -> tuple[bytes, bytes]:
        """Return the index of the chunk, and what tells of it at the end of the bag."""
        seconds, nanoseconds, counts = np.array(self._stamps, np.uint32).T.reshape(3, -1)
        numbers = np.array(self._numbers, np.uint32)
        order = np.argsort(numbers, kind="stable")
        places = np.empty((len(numbers), 3), "<u4")
        places[:, 0] = np.repeat(seconds, counts)[order]
        places[:, 1] = np.repeat(nanoseconds, counts)[order]
        places[:, 2] = np.array(self._places, np.uint32)[order]
        found, starts, many = np.unique(numbers[order], return_index=True, return_counts=True)
        index = [
            record(
                INDEX,
                fields_of(ver=1, conn=number, count=count),
                places[start : start + count].tobytes(),
            )
            for number, start, count in zip(
                found.tolist(), starts.tolist(), many.tolist(), strict=True
            )
        ]
        pairs = np.stack([found, many], axis=1).astype("<u4").tobytes()
        first = divmod(min(self._first_ns, self._last_ns), _SECOND_NS)
        last = divmod(self._last_ns, _SECOND_NS)
        return b"".join(index), chunk_info(position, first, last, pairs, len(found))

    def flush(self) -> None:
        """See `plcsim.recorder.bag.files.Bag`."""
        if self._data:
            self._write_chunk()
        self._file.flush()

    def close(self) -> None:
        """See `plcsim.recorder.bag.files.Bag`."""
        self.flush()
        connections = self._writer.connections
        for each in connections:
            self._writer.write_connection(each, self._file)
        self._infos.seek(0)
        shutil.copyfileobj(self._infos, self._file)
        self._file.seek(len(MAGIC))
        self._file.write(bag_header(self._written, len(connections), self._chunks))
        self._end()
        self._active.rename(self._path)

    def abandon(self) -> None:
        """See `plcsim.recorder.bag.files.Bag`."""
        with suppress(OSError):
            self._end()

    def _end(self) -> None:
        self._infos.close()
        self._writer.bio = None
        self._file.close()
