"""Processes that programs start do not outlive the run.

They are in the process group of the scan process, which is killed when the scan has ended. One
that has left the group, as a daemon does, becomes a child of the supervisor's process when its own
parent ends (PR_SET_CHILD_SUBREAPER, prctl(2)), and is killed there.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal
from pathlib import Path

_PR_SET_CHILD_SUBREAPER = 36

MOST_GENERATIONS = 100
"""A child that is killed leaves its own children to us; so often that is looked for."""


def end_group(leader: int) -> None:
    """Kill what is left of a process group; its leader may have ended but is not waited for yet."""
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(leader, signal.SIGKILL)


class Orphans:
    """The orphans among the descendants of this process, from now on.

    Children that this process has already are none.
    """

    def __init__(self) -> None:
        self._spared = _children()
        _become_subreaper(1)

    def reap(self) -> None:
        """Let go of those that have ended.

        Who started a process waits for its exit code, so what this process started itself is left
        alone, be it for another run or for something else: it is in our group or leads its own.
        """
        for pid in _children() - self._spared:
            with contextlib.suppress(ChildProcessError, ProcessLookupError, FileNotFoundError):
                if not _is_own(pid):
                    os.waitpid(pid, os.WNOHANG)

    def end(self) -> None:
        """Kill them all; what this process started itself has to have ended."""
        for _ in range(MOST_GENERATIONS):
            found = _children() - self._spared
            if not found:
                break
            self._spared |= {pid for pid in found if not _kill(pid)}
        _become_subreaper(0)


def _become_subreaper(is_one: int) -> None:
    ctypes.CDLL(None).prctl(_PR_SET_CHILD_SUBREAPER, is_one)


def _is_own(pid: int) -> bool:
    """Whether a child may have been started by this process, and not left to it.

    Raises:
        FileNotFoundError, ProcessLookupError: there is no such process any more.
    """
    status = Path(f"/proc/{pid}/stat").read_bytes().rpartition(b")")[2].split()
    group, session = int(status[2]), int(status[3])
    return session == os.getsid(0) and group in (pid, os.getpgrp())


def _kill(pid: int) -> bool:
    """Kill a child and wait for its end; False where it is not ours to kill."""
    try:
        os.kill(pid, signal.SIGKILL)
    except PermissionError:  # it runs as another user
        return False
    except ProcessLookupError:
        pass
    with contextlib.suppress(ChildProcessError):
        os.waitpid(pid, 0)
    return True


def _children() -> set[int]:
    """Return the children of this process, as far as the kernel tells (proc(5), children)."""
    found: set[int] = set()
    for file in Path("/proc/self/task").glob("*/children"):
        with contextlib.suppress(OSError):
            found |= {int(pid) for pid in file.read_text("ascii").split()}
    return found
