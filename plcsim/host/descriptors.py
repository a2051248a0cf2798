"""File descriptors of this process: how many it may have, and room for them before they come."""

from __future__ import annotations

import os
import resource
from contextlib import suppress
from fcntl import F_DUPFD_CLOEXEC, fcntl
from typing import Final

SPARE: Final = 64
"""A process that serves connections needs so many for everything else."""

ROOM: Final = 4_096
"""The process has room for so many from the start."""


def allow(wanted: int) -> None:
    """Raise the limit of this process to ``wanted``, or to what the system allows."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    if soft < wanted:
        most = wanted if hard == resource.RLIM_INFINITY else min(wanted, hard)
        resource.setrlimit(resource.RLIMIT_NOFILE, (most, hard))


def make_room() -> None:
    """Let the kernel's table of descriptors grow now, and not in a cycle.

    It doubles when it is full. Where a process has threads, those of numpy for example, the call
    that needs the next descriptor then sleeps until no processor uses the old table (Linux,
    expand_fdtable: synchronize_rcu): an accept(2) of 7 to 16 ms at descriptor 256.
    """
    most, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
    fd = os.open(os.devnull, os.O_RDONLY | os.O_CLOEXEC)
    with suppress(OSError):
        os.close(fcntl(fd, F_DUPFD_CLOEXEC, min(ROOM, most) - 1))
    os.close(fd)
