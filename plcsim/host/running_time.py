"""CPU time of a thread without the time for which the machine itself stood still.

A virtual machine may be stopped in the middle of a program: its host swaps, moves it, or gives its
processor to others and does not say so. The guest's kernel then counts the time as that of the
thread that was running. What gives it away is a timer that should have rung meanwhile and did not.
Here it is the kernel's own sampling timer (perf_event_open(2), PERF_COUNT_SW_CPU_CLOCK): it runs
while the thread runs, and it leaves a record in shared memory each time it rings.
"""

from __future__ import annotations

import ctypes
import mmap
import os
import platform
import struct
import time
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable

BEAT_NS: Final = 1_000_000
"""Nanoseconds of CPU time between two beats."""

_SYSTEM_CALLS: Final = {"x86_64": 298, "aarch64": 241}
"""Number of perf_event_open by machine; glibc has no function for it."""

_ATTRIBUTES: Final = struct.Struct("IIQQQQQIIQ")
"""The first version of struct perf_event_attr, 64 bytes: type, size, config, sample_period,
sample_type, read_format, flags, wakeup_events, bp_type, config1."""

_SOFTWARE, _CPU_CLOCK, _SAMPLE_TIME, _CLOSE_ON_EXEC = 1, 0, 1 << 2, 1 << 3
_RECORD: Final = 16
"""Bytes of a record: its header, and the time."""
_HEAD: Final = 1024 // 8
"""Place of data_head in struct perf_event_mmap_page, in words of 8 bytes."""


def without_standstills(cpu_ns: Callable[[], int], beats: Callable[[], int]) -> Callable[[], int]:
    """Return what tells a CPU time in which no standstill counts for more than two beats.

    From one call to the next it grows by no more than the beats between them, and one beat.

    Args:
        cpu_ns: tells the CPU time as the kernel counts it, nanoseconds.
        beats: tells how often a timer has rung that rings every `BEAT_NS` of CPU time.
    """
    last_ns, last_beats, stood_still_ns = cpu_ns(), beats(), 0

    def running_ns() -> int:  # no object: it is asked four times in a cycle
        nonlocal last_ns, last_beats, stood_still_ns
        now_ns, now_beats = cpu_ns(), beats()
        excess_ns = now_ns - last_ns - (now_beats - last_beats + 1) * BEAT_NS
        last_ns, last_beats = now_ns, now_beats
        if excess_ns > 0:
            stood_still_ns += excess_ns
        return now_ns - stood_still_ns

    return running_ns


def cpu_time() -> Callable[[], int]:
    """Return what tells the CPU time of the calling thread, in nanoseconds.

    Standstills are left out where the kernel lets its timer be watched (`tells_standstills`).
    """
    beats = _beats_of_this_thread()
    return without_standstills(time.thread_time_ns, beats) if beats else time.thread_time_ns


def tells_standstills() -> bool:
    """Return whether `cpu_time` can leave standstills out.

    It can on x86-64 and ARM64, with root's rights, CAP_PERFMON, or kernel.perf_event_paranoid of 1
    or below; a container needs a runtime that does not forbid perf_event_open(2).
    """
    return _beats_of_this_thread() is not None


def _beats_of_this_thread() -> Callable[[], int] | None:
    """Start the timer; return what tells how often it has rung, None where the kernel refuses."""
    number = _SYSTEM_CALLS.get(platform.machine())
    if number is None:
        return None
    attributes = _ATTRIBUTES.pack(
        _SOFTWARE, _ATTRIBUTES.size, _CPU_CLOCK, BEAT_NS, _SAMPLE_TIME, 0, 0, 0, 0, 0
    )
    libc = ctypes.CDLL(None, use_errno=True)
    fd = libc.syscall(number, attributes, 0, -1, -1, _CLOSE_ON_EXEC)
    if fd < 0:
        return None
    try:
        # read only: the kernel then writes over the oldest records, and the head goes on
        page = mmap.mmap(fd, 2 * mmap.PAGESIZE, prot=mmap.PROT_READ)
    except OSError:
        return None
    finally:
        os.close(fd)  # the mapping keeps the timer
    words = memoryview(page).cast("Q")

    def beats() -> int:
        return words[_HEAD] // _RECORD

    return beats
