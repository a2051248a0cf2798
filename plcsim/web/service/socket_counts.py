"""What the kernel counts of each TCP socket: bytes, segments and what was sent again.

Asked by NETLINK_SOCK_DIAG (sock_diag(7)), which needs no rights. The numbers are those of struct
tcp_info (linux/tcp.h).
"""

from __future__ import annotations

import socket
import struct
from contextlib import closing
from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator

_SOCK_DIAG: Final = 4
_BY_FAMILY: Final = 20
_DUMP: Final = 0x301  # NLM_F_REQUEST | NLM_F_ROOT | NLM_F_MATCH
_MESSAGE: Final = struct.Struct("=IHHII")
_REQUEST: Final = struct.Struct("=BBBxI48x")
_STATES: Final = 0xFFF & ~(1 << 6)  # all but TIME_WAIT, which belongs to nobody
_INFO: Final = 2
_SIZE: Final = 72
"""Bytes of struct inet_diag_msg; the inode is its last word."""

_COUNTS: Final = struct.Struct("=100xI16xQQ16xII")
_TIMEOUT_S: Final = 0.5


class SocketCounts(NamedTuple):
    """Of one socket since it was made; segments are those that carry data."""

    resent: int
    bytes_sent: int
    bytes_received: int
    segments_received: int
    segments_sent: int


def socket_counts() -> dict[int, SocketCounts]:
    """Return what is counted of all TCP sockets, by inode; nothing where the kernel tells none."""
    try:
        return {
            inode: counts
            for family in (socket.AF_INET, socket.AF_INET6)
            for inode, counts in _dump(family)
        }
    except OSError:
        return {}


def _dump(family: int) -> Iterator[tuple[int, SocketCounts]]:
    request = _REQUEST.pack(family, socket.IPPROTO_TCP, 1 << (_INFO - 1), _STATES)
    with closing(socket.socket(socket.AF_NETLINK, socket.SOCK_RAW, _SOCK_DIAG)) as asked:
        asked.settimeout(_TIMEOUT_S)
        asked.send(_MESSAGE.pack(_MESSAGE.size + len(request), _BY_FAMILY, _DUMP, 1, 0) + request)
        while True:
            data = asked.recv(1 << 16)
            at = 0
            while at + _MESSAGE.size <= len(data):
                length, kind, *_ = _MESSAGE.unpack_from(data, at)
                if kind != _BY_FAMILY or length < _MESSAGE.size:  # the end, or an error
                    return
                yield from _counts(data[at + _MESSAGE.size : at + length])
                at += (length + 3) & ~3


def _counts(data: bytes) -> Iterator[tuple[int, SocketCounts]]:
    """Return inode and counts of a socket in struct inet_diag_msg, where they are told."""
    (inode,) = struct.unpack_from("=I", data, _SIZE - 4)
    at = _SIZE
    while at + 4 <= len(data):
        length, kind = struct.unpack_from("=HH", data, at)
        if kind == _INFO and length - 4 >= _COUNTS.size:
            yield inode, SocketCounts(*_COUNTS.unpack_from(data, at + 4))
        at += max(4, (length + 3) & ~3)
