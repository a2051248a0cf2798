"""The processor that a scan stays on, and how the runs of one host keep out of each other's way.

A run that has real-time rights holds a lock (flock(2)) on the folder of its processor in /sys.
Every user may look at that, and it goes with the process. Containers with a network of their own do
not see each other's locks.
"""

from __future__ import annotations

import contextlib
import fcntl
import os
from pathlib import Path

FOLDERS = Path("/sys/devices/system/cpu")
"""A folder for each processor, and the file ``isolated``."""


UNKNOWN = -1
"""In the place of a lock, where the host does not show its processors."""


def claim(cpu: int | None) -> tuple[int | None, str]:
    """Choose the processor for the scan of this process, and hold it until the process ends.

    Args:
        cpu: what was asked for; None, or one that is not there, takes the last that no other run
            holds. One that is isolated is taken only where it was asked for.

    Returns:
        the processor, None where there is only one; and in words what stands in the way, "" for
        nothing.
    """
    allowed = sorted(os.sched_getaffinity(0))
    if cpu is not None and cpu in {*allowed, *isolated()}:
        return cpu, "" if _lock(cpu) is not None else f"CPU {cpu}: another run has it as well"
    if len(allowed) == 1:
        return None, ""
    for free in reversed(allowed):
        if _lock(free) is not None:
            return free, ""
    return allowed[-1], f"CPU {allowed[-1]}: every processor has another run on it"


def isolated() -> list[int]:
    """Return the processors that the kernel keeps free of other work (isolcpus).

    A process is on none of them before it asks for one, so they are not among those allowed.
    """
    try:
        text = (FOLDERS / "isolated").read_text("ascii").strip()
    except OSError:
        return []
    ranges = [part.partition("-") for part in text.split(",") if part]
    return [cpu for low, _, high in ranges for cpu in range(int(low), int(high or low) + 1)]


def free_cpu() -> int | None:
    """Return the best processor for a scan now: the last isolated one, or that no run holds."""
    allowed = sorted(os.sched_getaffinity(0))
    if best := isolated()[-1:]:
        return best[0]
    if len(allowed) == 1:
        return None
    for cpu in reversed(allowed):
        lock = _lock(cpu)
        if lock is not None:
            if lock != UNKNOWN:
                os.close(lock)
            return cpu
    return allowed[-1]


def _lock(cpu: int) -> int | None:
    """Return a descriptor that holds a processor while it is open, None where another run does."""
    try:
        fd = os.open(FOLDERS / f"cpu{cpu}", os.O_RDONLY | os.O_CLOEXEC)
    except OSError:
        return UNKNOWN
    try:
        fcntl.flock(fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(fd)
        return None
    return fd


def missing_cpu(cpu: int | None) -> str:
    """Return in words that a processor is not there for this process, "" where it is."""
    allowed = sorted(os.sched_getaffinity(0))
    if cpu is None or cpu in {*allowed, *isolated()}:
        return ""
    there = ", ".join(map(str, allowed))
    return f"there is no processor {cpu} for the scan, only {there}; one of them is taken"


def keep_off(cpu: int | None) -> None:
    """Keep the calling process off the processor of a scan, where there is another."""
    others = os.sched_getaffinity(0) - {cpu}
    if others:
        with contextlib.suppress(OSError):
            os.sched_setaffinity(0, others)
