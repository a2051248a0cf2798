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

_reserved: list[socket.socket] = []
"""Names in the system's abstract name space, gone with this process (unix(7))."""


def free_port() -> int:
    """Return a port that nobody listens at, and that no other test gets meanwhile.

    One that the system has given away (port 0) and taken back may be given to the next who asks,
    long before the server that is told its number has started. It stays reserved as long as this
    process lives: where a test has stopped its server, nobody of another test answers there.
    """
    while True:
        port = next(_next)
        with suppress(OSError), socket.socket() as probe:
            probe.bind(("", port))
            if _reserve(port):
                return port


def _reserve(port: int) -> bool:
    """Keep a port for this process among all that ask here; False where another one has it."""
    name = socket.socket(socket.AF_UNIX)
    try:
        name.bind(f"\0plcsim-tests-port-{port}")
    except OSError:
        name.close()
        return False
    _reserved.append(name)
    return True
