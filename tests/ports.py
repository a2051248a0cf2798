"""Ports for servers whose port has to be named before they run."""

import itertools
import os
import socket
from contextlib import suppress
from pathlib import Path

_FIRST = 12_000
"""Below are those of well-known services."""


def _ports() -> list[int]:
    """Ports that the system gives nobody by itself, from another one on in each process."""
    system = Path("/proc/sys/net/ipv4/ip_local_port_range").read_text()
    ports = range(_FIRST, int(system.split()[0]))
    start = os.getpid() * 97 % len(ports)
    return [*ports[start:], *ports[:start]]


_next = itertools.cycle(_ports())


def free_port() -> int:
    """Return a port that nobody listens at, and that no other process gets meanwhile.

    One that the system has given away (port 0) and taken back may be given to the next who asks,
    long before the server that is told its number has started.
    """
    while True:
        port = next(_next)
        with suppress(OSError), socket.socket() as probe:
            probe.bind(("", port))
            return port
