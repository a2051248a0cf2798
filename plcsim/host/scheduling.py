"""Whether a process waits by itself, or for a processor that the host has given to others."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Final

_RUNNABLE: Final = b"R"
"""State of a process that is on a processor or in the queue for one (proc(5))."""

_SCHEDULED: Final = 2
"""Kind of the clock of a process: what the scheduler has given it (clock_getcpuclockid(3))."""


def processor_ns(pid: int) -> int | None:
    """Return the processor time that a process has had, in nanoseconds.

    Returns:
        None where its first thread waits for something else than a processor, and where the host
        does not tell.
    """
    try:
        status = Path(f"/proc/{pid}/stat").read_bytes().rpartition(b")")[2].split()
        if status[0] != _RUNNABLE:
            return None
        return time.clock_gettime_ns(~pid << 3 | _SCHEDULED)
    except OSError:
        return None
