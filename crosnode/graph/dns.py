"""Questions to a name server and its answers (RFC 1035, RFC 3596), as bytes."""

from __future__ import annotations

import re
import struct
from ipaddress import IPv4Address, IPv6Address
from typing import Final, NamedTuple

from plcsim.network.protocol import is_ipv4

PORT: Final = 53
MAX_ANSWER: Final = 512
"""Bytes over UDP (RFC 1035, 4.2.1)."""

_HEAD: Final = struct.Struct(">HHHHHH")
_TAIL: Final = struct.Struct(">HH")
_RECORD: Final = struct.Struct(">HHIH")
_RECURSE, _IS_ANSWER, _CODE = 0x0100, 0x8000, 0x000F
_TYPE_A, _TYPE_AAAA, _CLASS_IN = 1, 28, 1
_POINTER: Final = 0xC0
_NO_SUCH_NAME: Final = 3

_NAME: Final = re.compile(r"[A-Za-z0-9_-]{1,63}(\.[A-Za-z0-9_-]{1,63})*\.?")
MAX_NAME: Final = 253


class NameServers(NamedTuple):
    """Who is asked for names.

    Attributes:
        servers: IPv4 addresses, in order.
        domains: what is put behind a name without a dot.
    """

    servers: tuple[str, ...] = ()
    domains: tuple[str, ...] = ()


class NameAnswer(NamedTuple):
    """What a name server says.

    Attributes:
        ip: of the name, "" where it has none.
        ttl_s: seconds for which that holds.
    """

    ip: str
    ttl_s: int


def parse_name_servers(text: str) -> NameServers:
    """Return what a text in the form of ``/etc/resolv.conf`` says; servers of IPv6 are left out."""
    servers, domains = [], []
    for line in text.splitlines():
        key, *words = line.split() or [""]
        if key == "nameserver" and words and is_ipv4(words[0]):
            servers.append(words[0])
        elif key in ("search", "domain"):
            domains = [word for word in words if is_name(word)]
    return NameServers(tuple(servers[:3]), tuple(domains[:6]))


def is_name(host: str) -> bool:
    """Return whether a name server may be asked for a name."""
    return len(host) <= MAX_NAME and bool(_NAME.fullmatch(host))


def question(number: int, name: str, *, ipv6: bool = False) -> bytes:
    """Return the question for the address of a name."""
    labels = b"".join(bytes([len(label)]) + label.encode() for label in name.rstrip(".").split("."))
    head = _HEAD.pack(number, _RECURSE, 1, 0, 0, 0)
    kind = _TYPE_AAAA if ipv6 else _TYPE_A
    return head + labels + b"\0" + _TAIL.pack(kind, _CLASS_IN)


def parse_answer(number: int, name: str, data: bytes, *, ipv6: bool = False) -> NameAnswer | None:
    """Return the answer to a question; None for bytes that are none, and for a server's failure."""
    try:
        return _parse(number, name, data, ipv6=ipv6)
    except (struct.error, IndexError):
        return None


def _parse(number: int, name: str, data: bytes, *, ipv6: bool) -> NameAnswer | None:
    found, flags, questions, answers, _, _ = _HEAD.unpack_from(data)
    asked = question(number, name, ipv6=ipv6)[_HEAD.size :]
    if found != number or not flags & _IS_ANSWER or questions != 1:
        return None
    if data[_HEAD.size : _HEAD.size + len(asked)].lower() != asked.lower():
        return None
    if flags & _CODE:
        return NameAnswer("", 0) if flags & _CODE == _NO_SUCH_NAME else None
    at = _HEAD.size + len(asked)
    for _ in range(answers):
        at = _behind_name(data, at)
        kind, group, ttl_s, size = _RECORD.unpack_from(data, at)
        at += _RECORD.size
        if at + size > len(data):
            return None
        if (kind, group, size) == (
            (_TYPE_AAAA, _CLASS_IN, 16) if ipv6 else (_TYPE_A, _CLASS_IN, 4)
        ):
            made = (IPv6Address if ipv6 else IPv4Address)(data[at : at + size])
            return NameAnswer(str(made), ttl_s)
        at += size
    return NameAnswer("", 0)


def _behind_name(data: bytes, at: int) -> int:
    """Return the place behind a name, of which a pointer is the last part."""
    while data[at]:
        if data[at] & _POINTER == _POINTER:
            return at + 2
        at += 1 + data[at]
    return at + 1
