"""Makes a ROS 1 bag readable that was not closed: its recorder was killed, or the disk was full.

What counts is in chunks, one behind the other; the index at the end only tells where. So every
chunk that is complete is copied, and its index is made anew (rosbag's format 2.0, the wiki's
Bags/Format/2.0). A chunk that breaks off, and what is behind it, is left out.
"""

from __future__ import annotations

import bz2
from collections import defaultdict
from typing import TYPE_CHECKING, Any, BinaryIO, Final, NamedTuple, TypeAlias

from plcsim.recorder.bag.ros1_records import (
    CHUNK,
    CONNECTION,
    INDEX,
    MAGIC,
    MESSAGE,
    PLACE,
    U32,
    bag_header,
    chunk_info,
    fields_of,
)
from plcsim.recorder.bag.ros1_records import record as record_bytes
from plcsim.recorder.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

_MOST_HEADER: Final = 1 << 20
_MOST_CHUNK: Final = 1 << 30
"""Bytes; whoever says more is damaged."""

Place: TypeAlias = tuple[int, int, int]
"""Of a message: seconds, nanoseconds, and where its record begins in the chunk."""


class Recovered(NamedTuple):
    """What was found.

    Attributes:
        messages: how many.
        left_out: bytes at the end that are in no complete chunk.
    """

    messages: int
    left_out: int


class _Record(NamedTuple):
    fields: Mapping[bytes, bytes]
    head: bytes
    start: int
    data: bytes


class _DamagedError(Exception):
    """The bytes break off here, or are no record."""


def reindex(source: Path, target: Path) -> Recovered:
    """Copy what is complete in a ROS 1 bag into another one, with an index.

    Args:
        source: a bag, closed or not; it stays as it is.
        target: the bag that is made.

    Raises:
        RecordingError: the source is no bag of ROS 1, or the target is there or cannot be written.
    """
    making = target.with_name(f"{target.name}.reindexed")
    if target.exists():
        raise RecordingError(f"{target}: exists already, and is not written over")
    try:
        with source.open("rb") as old:
            if old.read(len(MAGIC)) != MAGIC:
                raise RecordingError(f"{source}: is no bag of ROS 1")
            with making.open("wb") as new:
                found = _copy(old, new)
        making.rename(target)
    except OSError as err:
        making.unlink(missing_ok=True)
        raise RecordingError(f"{err.filename or target}: {err.strerror or err}") from None
    return found


def _copy(old: BinaryIO, new: BinaryIO) -> Recovered:
    """Copy chunk by chunk, then write the index behind them."""
    new.write(MAGIC + bag_header(0, 0, 0))
    connections: dict[bytes, bytes] = {}
    infos: list[bytes] = []
    messages, end = 0, old.tell()
    for record in _chunks(old):
        try:
            places = _places(record, connections)
        except _DamagedError:
            break
        infos.append(_info(new.tell(), places))
        new.write(record.head + U32.pack(len(record.data)) + record.data)
        for connection, each in places.items():
            fields = fields_of(ver=1, conn=connection, count=len(each))
            new.write(record_bytes(INDEX, fields, b"".join(PLACE.pack(*place) for place in each)))
        messages += sum(map(len, places.values()))
        end = old.tell()
    index = new.tell()
    new.write(b"".join([*connections.values(), *infos]))
    new.seek(len(MAGIC))
    new.write(bag_header(index, len(connections), len(infos)))
    return Recovered(messages, _behind(old, end))


def _chunks(file: BinaryIO) -> Iterator[_Record]:
    """Return the chunks that are complete."""
    size = file.seek(0, 2)
    file.seek(len(MAGIC))
    try:
        while file.tell() < size:
            record = _read(file, size)
            if record.fields.get(b"op") == CHUNK:
                yield record
    except _DamagedError:
        return


def _behind(file: BinaryIO, end: int) -> int:
    """Return how many bytes behind the last chunk are no index of it."""
    size = file.seek(0, 2)
    file.seek(end)
    try:
        while end < size:
            if _read(file, size).fields.get(b"op") == CHUNK:
                break
            end = file.tell()
    except _DamagedError:
        pass
    return size - end


def _read(file: BinaryIO, size: int) -> _Record:
    start = file.tell()
    head = _part(file, size, _MOST_HEADER)
    data = _part(file, size, _MOST_CHUNK)
    return _Record(_fields_of(head), U32.pack(len(head)) + head, start, data)


def _part(file: BinaryIO, size: int, most: int) -> bytes:
    """Read a length and so many bytes."""
    length = file.read(U32.size)
    if len(length) < U32.size:
        raise _DamagedError
    count = U32.unpack(length)[0]
    if count > min(most, size - file.tell()):
        raise _DamagedError
    return file.read(count)


def _fields_of(head: bytes) -> dict[bytes, bytes]:
    found, at = {}, 0
    while at < len(head):
        end = at + U32.size + _u32(head, at)
        name, equals, value = head[at + U32.size : end].partition(b"=")
        if not equals or end > len(head):
            raise _DamagedError
        found[name] = value
        at = end
    return found


def _u32(data: bytes, at: int) -> int:
    if at + U32.size > len(data):
        raise _DamagedError
    return int.from_bytes(data[at : at + U32.size], "little")


def _places(chunk: _Record, connections: dict[bytes, bytes]) -> dict[bytes, list[Place]]:
    """Return where the messages of a chunk begin, by their connection; note new connections."""
    data, found = _content(chunk), defaultdict[bytes, list[Place]](list)
    new, at = {}, 0
    while at < len(data):
        start, behind_head = at, at + U32.size + _u32(data, at)
        at = behind_head + U32.size + _u32(data, behind_head)
        if at > len(data):
            raise _DamagedError
        fields = _fields_of(data[start + U32.size : behind_head])
        connection, time = fields.get(b"conn", b""), fields.get(b"time", b"")
        if fields.get(b"op") == CONNECTION and len(connection) == U32.size:
            new[connection] = data[start:at]
        elif fields.get(b"op") == MESSAGE and len(connection) == U32.size and len(time) == 8:
            found[connection].append((_u32(time, 0), _u32(time, 4), start))
        else:
            raise _DamagedError
    if found.keys() - new.keys() - connections.keys():
        raise _DamagedError
    connections.update((key, new[key]) for key in new.keys() - connections.keys())
    return dict(found)


def _content(chunk: _Record) -> bytes:
    """Return the records of a chunk, not more bytes than it says."""
    size = _u32(chunk.fields.get(b"size", b""), 0)
    if size > _MOST_CHUNK:
        raise _DamagedError
    compression = chunk.fields.get(b"compression")
    try:
        if compression == b"none":
            data = chunk.data
        elif compression == b"bz2":
            data = bz2.BZ2Decompressor().decompress(chunk.data, size + 1)
        elif compression == b"lz4":
            data = _lz4().decompress(chunk.data, size + 1)
        else:
            raise _DamagedError
    except (OSError, EOFError, RuntimeError):
        raise _DamagedError from None
    if len(data) != size:
        raise _DamagedError
    return data


def _lz4() -> Any:
    from lz4.frame import LZ4FrameDecompressor  # noqa: PLC0415  # comes with rosbags

    return LZ4FrameDecompressor()


def _info(position: int, places: Mapping[bytes, list[Place]]) -> bytes:
    """Return the record that tells of a chunk at the end of the bag."""
    times = [place[:2] for each in places.values() for place in each] or [(0, 0)]
    counts = b"".join(key + U32.pack(len(each)) for key, each in places.items())
    return chunk_info(position, min(times), max(times), counts, len(places))
