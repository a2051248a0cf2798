"""Reads the messages of a ROS 1 bag chunk by chunk, several times as quick as by its index.

It goes where no chunk begins before the one before it ends, as in every bag that was recorded and
not put together: what is in a chunk is sorted by time, and no more than one chunk is in memory.
"""

from __future__ import annotations

import struct
from itertools import pairwise, permutations
from operator import attrgetter, itemgetter
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.recorder.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

_FIELDS: Final = {b"op=": "4s", b"conn=": "5sI", b"time=": "5sII"}
_SIZES: Final = {b"op=": 4, b"conn=": 9, b"time=": 13}
_HEAD: Final = 38
"""Bytes of the header of a message that has these fields alone."""

_U32: Final = struct.Struct("<I")
_MESSAGE: Final = b"op=\x02"
_SECOND_NS: Final = 1_000_000_000

_WHEN = itemgetter(0)


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


def is_in_order(reader: Any) -> bool:
    """Whether no chunk of a bag begins before the one before it ends.

    Args:
        reader: `rosbags.rosbag1.Reader`, open.
    """
    chunks = sorted(_filled(reader), key=attrgetter("start_time"))
    return all(one.end_time - 1 <= other.start_time for one, other in pairwise(chunks))


def messages(reader: Any, connections: Collection[int]) -> Iterator[tuple[int, int, bytes]]:
    """Return connection, time in nanoseconds and bytes of each message, by time.

    Args:
        reader: `rosbags.rosbag1.Reader`, open, whose bag `is_in_order`.
        connections: numbers of those that count.

    Raises:
        RecordingError: a chunk is damaged.
    """
    wanted = frozenset(connections)
    for info in sorted(_filled(reader), key=attrgetter("start_time", "pos")):
        if wanted.isdisjoint(info.connection_counts):
            continue
        chunk = reader.chunks[info.pos]
        reader.bio.seek(chunk.datapos)
        data = chunk.decompressor(reader.bio.read(chunk.datasize))
        for time_ns, connection, start, end in _places(data):
            if connection in wanted:
                yield connection, time_ns, data[start:end]


def _filled(reader: Any) -> list[Any]:
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
