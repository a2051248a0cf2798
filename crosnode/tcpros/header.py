"""TCPROS connection headers: ``key=value`` fields, each behind its length.

Source: wiki.ros.org/ROS/Connection Header. Unknown fields are kept and never a fault; of two fields
with one key the later counts, as in rospy.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Final

from crosnode.errors import TcprosError

if TYPE_CHECKING:
    from collections.abc import Mapping

_LENGTH: Final = struct.Struct("<I")

ANY: Final = "*"
"""The md5sum or type of a peer that takes any."""


def encode_header(fields: Mapping[str, str]) -> bytes:
    """Return a header as it goes on the wire, its own length in front."""
    parts = [f"{key}={value}".encode() for key, value in fields.items()]
    body = b"".join(_LENGTH.pack(len(part)) + part for part in parts)
    return _LENGTH.pack(len(body)) + body


def decode_header(body: bytes) -> dict[str, str]:
    """Return the fields of a header's body, the part behind its length.

    Values that are not UTF-8 come with replacement characters.

    Raises:
        TcprosError: a length that leaves the body, or a field without ``=``.
    """
    fields: dict[str, str] = {}
    position = 0
    while position < len(body):
        if position + _LENGTH.size > len(body):
            raise TcprosError(f"header ends within a length at byte {position}")
        (size,) = _LENGTH.unpack_from(body, position)
        start, position = position + _LENGTH.size, position + _LENGTH.size + size
        if position > len(body):
            raise TcprosError(f"header field of {size} bytes at byte {start} leaves the header")
        key, equals, value = body[start:position].partition(b"=")
        if not equals:
            raise TcprosError(f"header field without '=' at byte {start}")
        fields[key.decode(errors="replace")] = value.decode(errors="replace")
    return fields


def missing_field(fields: Mapping[str, str], required: tuple[str, ...]) -> str | None:
    """Return the reason to refuse a header that lacks a field, None where all are there."""
    missing = [key for key in required if key not in fields]
    return f"missing required '{missing[0]}' field" if missing else None


def sums_agree(one: str, other: str) -> bool:
    """Return whether two md5sums are equal, or one of them takes any."""
    return one == other or ANY in (one, other)
