"""Processes that a benchmark starts: they end when it does, however it ends."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from contextlib import ExitStack
from typing import TYPE_CHECKING, NoReturn

from plcsim.host.realtime import die_with_parent

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import FrameType
    from typing import IO


def end_at_sigterm() -> None:
    """Let SIGTERM, as timeout(1) sends it, end this process as an exception: blocks are left."""

    def end(number: int, _frame: FrameType | None) -> NoReturn:
        sys.exit(128 + number)

    signal.signal(signal.SIGTERM, end)


class Children(ExitStack):
    """Processes that are ended at the end of the block, and by the kernel where this one is killed.

    They are started by the main thread, while there is no other.
    """

    def start(
        self,
        command: Sequence[object],
        *,
        stdin: int | None = None,
        stdout: IO[str] | int | None = None,
        stderr: IO[str] | int | None = None,
    ) -> subprocess.Popen[str]:
        """Start a process; what ends it is SIGTERM, then SIGKILL."""
        own = os.getpid()

        def follow() -> None:
            die_with_parent(signal.SIGTERM, own)

        process = subprocess.Popen(
            [str(word) for word in command],
            stdin=stdin,
            stdout=stdout,
            stderr=stderr,
            text=True,
            preexec_fn=follow,  # noqa: PLW1509  # no threads here
        )
        self.callback(end, process)
        return process


def end(process: subprocess.Popen[str], patience_s: float = 20) -> None:
    """End a process, where it has not ended yet."""
    if process.poll() is None:
        with contextlib.suppress(ProcessLookupError):
            process.terminate()
        try:
            process.wait(patience_s)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
