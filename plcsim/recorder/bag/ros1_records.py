"""The records of a ROS 1 bag: a header of named fields, then data (the wiki's Bags/Format/2.0)."""

from __future__ import annotations

import struct
from typing import Final

MAGIC: Final = b"#ROSBAG V2.0\n"

HEADER_SIZE: Final = 4096
"""Bytes that header and padding of the first record have in a bag of ROS 1 (rosbag's bag.cpp)."""

MESSAGE, BAG, INDEX, CHUNK, CHUNK_INFO, CONNECTION = (bytes([n]) for n in (2, 3, 4, 5, 6, 7))
"""Values of the field ``op``."""

U32: Final = struct.Struct("<I")
PLACE: Final = struct.Struct("<III")
"""Of a message: seconds, nanoseconds, and where its record begins in the chunk."""


def record(operation: bytes, fields: bytes, data: bytes | bytearray) -> bytes:
    """Return a record.

    Args:
        operation: its field ``op``.
        fields: the other ones, see `fields_of`.
        data: behind the header.
    """
    head = field("op", operation) + fields
    return U32.pack(len(head)) + head + U32.pack(len(data)) + data


def fields_of(**values: bytes | int) -> bytes:
    """Return fields; numbers have 32 bits."""
    return b"".join(
        field(name, U32.pack(value) if isinstance(value, int) else value)
        for name, value in values.items()
    )


def field(name: str, value: bytes) -> bytes:
    """Return a field."""
    return U32.pack(len(name) + 1 + len(value)) + name.encode() + b"=" + value


def bag_header(index: int, connections: int, chunks: int) -> bytes:
    """Return the first record.

    Args:
        index: where the connections and what tells of the chunks begin.
        connections: how many.
        chunks: how many.
    """
    fields = fields_of(
        index_pos=index.to_bytes(8, "little"), conn_count=connections, chunk_count=chunks
    )
    size = len(field("op", BAG)) + len(fields)
    return record(BAG, fields, b" " * (HEADER_SIZE - size))


def chunk_info(
    position: int, first: tuple[int, int], last: tuple[int, int], counts: bytes, connections: int
) -> bytes:
    """Return the record that tells of a chunk at the end of the bag.

    Args:
        position: of the chunk in the file.
        first: its earliest time, seconds and nanoseconds.
        last: its latest one.
        counts: number and messages of each connection, 32 bits each.
        connections: how many those are.
    """
    fields = fields_of(
        ver=1,
        chunk_pos=position.to_bytes(8, "little"),
        start_time=struct.pack("<II", *first),
        end_time=struct.pack("<II", *last),
        count=connections,
    )
    return record(CHUNK_INFO, fields, counts)
