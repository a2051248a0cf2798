"""Addresses as ROS writes them: ``http://host:port/`` (node), ``rosrpc://host:port`` (service)."""

from __future__ import annotations

import re
from typing import Final, NamedTuple

from crosnode.errors import InvalidNameError

_URI: Final = re.compile(
    r"(?P<scheme>[a-z]+)://(?P<host>\[[0-9A-Za-z:.%_-]+\]|[A-Za-z0-9._-]+|[0-9A-Fa-f.]*:[0-9A-Fa-f:.]+)"
    r":(?P<port>\d{1,5})(?:/.*)?",
    re.A | re.S,
)


DEFAULT_PORT: Final = 11311
"""Of a master."""


class Authority(NamedTuple):
    """What a URI names (RFC 3986): a host name or number, IPv6 without brackets, and a port."""

    host: str
    port: int


def parse_uri(uri: str, scheme: str) -> Authority:
    """Return the address of a URI, with or without a path.

    A literal of IPv6 may be without brackets, as rospy and roscpp write it.

    Raises:
        InvalidNameError: another scheme, no host, or a port outside of 1 to 65535.
    """
    match = _URI.fullmatch(uri)
    if not match or match["scheme"] != scheme or not 0 < int(match["port"]) < 65536:
        raise InvalidNameError(f"{uri[:100]!r} is not a URI of the form {scheme}://host:port/.")
    return Authority(match["host"].strip("[]"), int(match["port"]))


def make_authority(host: str, port: int) -> str:
    """Return host and port as a URI has them: IPv6, which may have its brackets, in brackets."""
    host = host.strip("[]")
    return f"[{host}]:{port}" if ":" in host else f"{host}:{port}"


def make_uri(scheme: str, host: str, port: int) -> str:
    """Return the URI of an address; one of a node ends in a slash, as rospy and roscpp write it."""
    return f"{scheme}://{make_authority(host, port)}" + ("/" if scheme == "http" else "")
