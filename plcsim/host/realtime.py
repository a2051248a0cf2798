"""Real-time rights of the scan process, taken where the host gives them.

With them a cycle waits for nobody: SCHED_FIFO, one processor, memory that is never paged out,
timers without slack, a processor that does not sleep deeply, and no garbage collection while the
scan runs.
"""

from __future__ import annotations

import ctypes
import os
import re
import resource
from pathlib import Path
from typing import NamedTuple

from plcsim.host import garbage, processors

_MCL_CURRENT, _MCL_FUTURE, _MCL_ONFAULT = 1, 2, 4
_PR_SET_PDEATHSIG, _PR_SET_TIMERSLACK = 1, 29
_CAP_IPC_LOCK = 14

PROCESS_STATUS = Path("/proc/self/status")

LOCKED_MEMORY = "locked memory"
"""Of what is granted."""

_libc = ctypes.CDLL(None, use_errno=True)


class Rights(NamedTuple):
    """What the host gave and what it refused.

    Attributes:
        granted: in words.
        refused: in words, with the reason.
        cpu: the processor that the scan stays on, None for any.
    """

    granted: tuple[str, ...]
    refused: tuple[str, ...]
    cpu: int | None = None

    @property
    def complete(self) -> bool:
        """True where the scheduler itself gave way; the rest only narrows the tail."""
        return any(right.startswith("SCHED_FIFO") for right in self.granted)


def die_with_parent(signal_number: int, parent: int | None = None) -> None:
    """Ask the kernel to send this process a signal when its parent ends.

    Args:
        signal_number: the signal.
        parent: the parent's process id; where it has gone already, the signal is sent at once.
    """
    _libc.prctl(_PR_SET_PDEATHSIG, signal_number)
    if parent not in (None, os.getppid()):
        os.kill(os.getpid(), signal_number)


def sharpen_timers() -> None:
    """Let sleeps of this thread end without the 50 us of slack that Linux allows by default."""
    _libc.prctl(_PR_SET_TIMERSLACK, 1)


def is_held() -> bool:
    """Return whether the calling thread runs before all that have no real-time rights."""
    return os.sched_getscheduler(0) & ~os.SCHED_RESET_ON_FORK in (os.SCHED_FIFO, os.SCHED_RR)


def acquire(priority: int, cpu: int | None) -> Rights:
    """Take what rights there are for the calling thread.

    Args:
        priority: of SCHED_FIFO, 1 to 98.
        cpu: the processor to stay on; see `plcsim.host.processors.claim`.
    """
    granted: list[str] = []
    missing = processors.missing_cpu(cpu)
    refused = [missing] if missing else []
    sharpen_timers()
    try:
        # What a program starts (a thread, a process) must not hold the scan up as its equal.
        policy = os.SCHED_FIFO | os.SCHED_RESET_ON_FORK
        os.sched_setscheduler(0, policy, os.sched_param(priority))
        granted.append(f"SCHED_FIFO {priority}")
    except OSError as err:
        refused.append(f"SCHED_FIFO: {err.strerror}")
        return Rights(tuple(granted), tuple(refused))
    chosen = _pin(cpu, granted, refused)
    _lock_memory(granted, refused)
    _stay_awake(granted, refused)
    return Rights(tuple(granted), tuple(refused), chosen)


def _pin(cpu: int | None, granted: list[str], refused: list[str]) -> int | None:
    """Stay on one processor; return it, None where there is none or the host refuses."""
    chosen, note = processors.claim(cpu)
    if note:
        refused.append(note)
    if chosen is None:
        return None
    try:
        os.sched_setaffinity(0, {chosen})
    except OSError as err:
        refused.append(f"CPU {chosen}: {err.strerror}")
        return None
    granted.append(f"CPU {chosen}")
    return chosen


def _lock_memory(granted: list[str], refused: list[str]) -> None:
    """Lock all pages; only where no limit could make a later allocation fail (mlock(2))."""
    limit = resource.getrlimit(resource.RLIMIT_MEMLOCK)[0]
    if limit != resource.RLIM_INFINITY and not _has_capability(_CAP_IPC_LOCK):
        refused.append(f"{LOCKED_MEMORY}: the limit is {limit // 1024} KiB")
    elif _lock_all():
        granted.append(LOCKED_MEMORY)
    else:
        refused.append(f"{LOCKED_MEMORY}: {os.strerror(ctypes.get_errno())}")


def _lock_all() -> bool:
    """Lay out and lock all that is mapped; return whether the host does.

    What is mapped from now on is locked page by page, as it is touched: laid out at once, a
    mebibyte, of which Python takes one every now and then, holds a cycle up by half a millisecond
    (docs/decisions/0039-later-memory-is-locked-page-by-page.md).
    """
    if _libc.mlockall(_MCL_CURRENT) != 0:
        return False
    if _libc.mlockall(_MCL_FUTURE | _MCL_ONFAULT) == 0:
        return True
    return bool(_libc.mlockall(_MCL_CURRENT | _MCL_FUTURE) == 0)  # before Linux 4.4


def _has_capability(number: int) -> bool:
    """Return True where a capability is in effect, False where the kernel does not say."""
    try:
        status = PROCESS_STATUS.read_text("utf-8", "replace")
    except OSError:
        return False
    effective = re.search(r"^CapEff:\s*([0-9a-f]+)$", status, re.MULTILINE)
    return effective is not None and bool(int(effective[1], 16) >> number & 1)


def _stay_awake(granted: list[str], refused: list[str]) -> None:
    """Keep the processors out of deep sleep for as long as this process lives (Linux PM QoS)."""
    device = Path("/dev/cpu_dma_latency")
    try:
        fd = os.open(device, os.O_WRONLY | os.O_CLOEXEC)  # held until the process ends
        os.write(fd, (0).to_bytes(4, "little"))
        granted.append("no deep sleep")
    except OSError as err:
        refused.append(f"no deep sleep: {err.strerror}")


def settle(rights: Rights) -> None:
    """Call after INIT: what was made so far is no garbage, and nothing is collected in a cycle.

    Args:
        rights: where memory is locked, all that was made so far is laid out.
    """
    garbage.freeze()
    if LOCKED_MEMORY in rights.granted:
        _lock_all()
