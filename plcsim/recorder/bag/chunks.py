"""Reads the messages of a ROS 1 bag chunk by chunk, several times as quick as by its index.

In a bag as it was recorded no chunk begins before the one before it ends: then one chunk is in
memory, sorted by time. Of chunks that overlap only the places of their messages are kept, 40 bytes
each, and the messages read one by one.
"""

from __future__ import annotations

import os
import struct
from collections import Counter
from functools import lru_cache
from itertools import permutations
from operator import attrgetter, itemgetter
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np
from rosbags.rosbag1 import Reader
from rosbags.rosbag1.reader import decompressors

from plcsim.recorder.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator, Sequence

_FIELDS: Final = {b"op=": "4s", b"conn=": "5sI", b"time=": "5sII"}
_SIZES: Final = {b"op=": 4, b"conn=": 9, b"time=": 13}
_HEAD: Final = 38
"""Bytes of the header of a message that has these fields alone."""

_U32: Final = struct.Struct("<I")
_MESSAGE: Final = b"op=\x02"
_SECOND_NS: Final = 1_000_000_000

_WHEN = itemgetter(0)

CACHED: Final = 64
"""Compressed chunks that are kept unpacked, of chunks that overlap."""


class _Layout(NamedTuple):
    """An order of the fields in a message's header.

    Attributes:
        form: the length of the header, each field's length, name and value, the length of the data.
        fixed: what is the same in all messages, in the places ``same``.
        same: places among the values of ``form``.
        connection: place of the connection's number; seconds and nanoseconds likewise.
    """

    form: struct.Struct
    fixed: tuple[object, ...]
    same: itemgetter[Any]
    connection: int
    seconds: int


def _layout(order: tuple[bytes, ...]) -> _Layout:
    form, same, at = "<I", [0], 1
    fixed: list[object] = [_HEAD]
    places = {}
    for name in order:
        form += f"I{_FIELDS[name]}"
        fixed += [_SIZES[name], _MESSAGE if name == b"op=" else name]
        same += [at, at + 1]
        places[name] = at + 2
        at += len(_FIELDS[name].replace("4s", "s").replace("5s", "s")) + 1
    return _Layout(
        struct.Struct(form + "I"),
        tuple(fixed),
        itemgetter(*same),
        places[b"conn="],
        places[b"time="],
    )


_LAYOUTS: Final = tuple(map(_layout, permutations(_FIELDS)))
"""roscpp, rospy and rosbags each have another order."""


class ChunkReader(Reader):
    """A reader that leaves the places of single messages alone: 300 bytes of memory for each."""

    def read_index_data(self, pos: int, indexes: dict[int, list[Any]]) -> None:
        """Read nothing; `messages` finds them in the chunks."""

    def open(self) -> None:
        """Open the bag; connections know their messages by what the chunks say of them."""
        super().open()
        counts = Counter[int]()
        for info in self.chunk_infos:
            counts.update(info.connection_counts)
        self.connections = [each._replace(msgcount=counts[each.id]) for each in self.connections]


def messages(reader: ChunkReader, connections: Collection[int]) -> Iterator[tuple[int, int, bytes]]:
    """Return connection, time in nanoseconds and bytes of each message, by time.

    Args:
        reader: open.
        connections: numbers of those that count.

    Raises:
        RecordingError: a chunk is damaged.
    """
    wanted = frozenset(connections)
    for group in _groups(reader):
        chosen = [info for info in group if not wanted.isdisjoint(info.connection_counts)]
        if len(chosen) == 1:
            data = _content(reader, chosen[0])
            for time_ns, connection, start, end in _places(data):
                if connection in wanted:
                    yield connection, time_ns, data[start:end]
        elif chosen:
            yield from _merged(reader, chosen, wanted)


def _groups(reader: ChunkReader) -> Iterator[list[Any]]:
    """Return chunks that overlap, together, by their times."""
    group: list[Any] = []
    end_ns = 0
    for info in sorted(_filled(reader), key=attrgetter("start_time", "pos")):
        if group and info.start_time >= end_ns - 1:  # rosbags counts the end one up
            yield group
            group = []
        group.append(info)
        end_ns = max(end_ns, info.end_time)
    if group:
        yield group


def _content(reader: ChunkReader, info: Any) -> bytes:
    chunk = reader.chunks[info.pos]
    data = os.pread(_fd(reader), chunk.datasize, chunk.datapos)
    return bytes(chunk.decompressor(data))


def _fd(reader: ChunkReader) -> int:
    assert reader.bio is not None
    return reader.bio.fileno()


def _merged(
    reader: ChunkReader, group: Sequence[Any], wanted: frozenset[int]
) -> Iterator[tuple[int, int, bytes]]:
    """Return the messages of chunks that overlap, by time."""
    parts = []
    for number, info in enumerate(group):
        places = np.array(_places(_content(reader, info)), dtype=np.int64).reshape(-1, 4)
        parts.append(np.column_stack([places, np.full(len(places), number)]))
    table = np.concatenate(parts)
    del parts
    order = np.argsort(table[:, 0], kind="stable")
    read = _reads(reader, group)
    for each in order:
        time_ns, connection, start, end, number = table[each].tolist()
        if connection in wanted:
            yield connection, time_ns, read(number, start, end)


def _reads(reader: ChunkReader, group: Sequence[Any]) -> Callable[[int, int, int], bytes]:
    """Return what reads a message: of a chunk that is not compressed, nothing but its bytes."""
    fd = _fd(reader)
    chunks = [reader.chunks[info.pos] for info in group]

    @lru_cache(CACHED)
    def unpacked(number: int) -> bytes:
        return _content(reader, group[number])

    def read(number: int, start: int, end: int) -> bytes:
        chunk = chunks[number]
        if chunk.decompressor is decompressors["none"]:
            return os.pread(fd, end - start, chunk.datapos + start)
        return unpacked(number)[start:end]

    return read


def _filled(reader: ChunkReader) -> list[Any]:
    return [each for each in reader.chunk_infos if each.connection_counts]


def _places(data: bytes) -> list[tuple[int, int, int, int]]:
    """Return time, connection, start and end of each message of a chunk, by time."""
    found: list[tuple[int, int, int, int]] = []
    at, latest_ns, is_sorted = 0, 0, True
    layout = _LAYOUTS[0]
    try:
        while at < len(data):
            values = layout.form.unpack_from(data, at) if len(data) - at >= 46 else ()
            if not values or layout.same(values) != layout.fixed:
                other = _layout_at(data, at)
                if other is not None:
                    layout = other
                    continue
                entry, at = _by_fields(data, at)
                if entry is not None:
                    found.append(entry)
                    is_sorted = False
                continue
            seconds = layout.seconds
            time_ns = values[seconds] * _SECOND_NS + values[seconds + 1]
            start = at + 46
            at = start + values[-1]
            found.append((time_ns, values[layout.connection], start, at))
            is_sorted = is_sorted and time_ns >= latest_ns
            latest_ns = time_ns
    except struct.error:
        at = -1
    if at != len(data):
        raise RecordingError("a chunk is damaged")
    if not is_sorted:
        found.sort(key=_WHEN)
    return found


def _layout_at(data: bytes, at: int) -> _Layout | None:
    """Return the layout of the message at this place, None for what is none."""
    if len(data) - at < 46:
        return None
    return next((e for e in _LAYOUTS if e.same(e.form.unpack_from(data, at)) == e.fixed), None)


def _by_fields(data: bytes, at: int) -> tuple[tuple[int, int, int, int] | None, int]:
    """Return the place of a message with other fields, None for another record, and its end."""
    fields: dict[bytes, bytes] = {}
    behind = at + _U32.size + _U32.unpack_from(data, at)[0]
    at += _U32.size
    while at < behind:
        size = _U32.unpack_from(data, at)[0]
        name, _, value = data[at + _U32.size : at + _U32.size + size].partition(b"=")
        fields[name] = value
        at += _U32.size + size
    start = behind + _U32.size
    end = int(start + _U32.unpack_from(data, behind)[0])
    if fields.get(b"op") != _MESSAGE[3:]:
        return None, end
    seconds, nanoseconds = struct.unpack("<II", fields.get(b"time", b""))
    (connection,) = _U32.unpack(fields.get(b"conn", b""))
    return (seconds * _SECOND_NS + nanoseconds, connection, start, end), end
