"""The page that the controller shares with compiled code, and with who watches the scan.

Compiled programs poll the budget at every back edge and every entry of a function, because neither
a signal handler nor another thread of Python can end them; the watchdog, which is another process,
ends them by writing it (docs/timing-model.md).
"""

from __future__ import annotations

import mmap
import os
from typing import Self

SIZE = 0x1_0000
"""Bytes: a page of PLC memory."""

BUDGET, RELEASE, DATE, WATCH = range(4)
"""Indices of 64-bit cells: the budget; the release time of the running task class in ns; the
nanoseconds from 1970-01-01 (UTC) to time 0 of the clock that the release time is read from; 1 while
compiled code tells of its stores (`plcsim.machine.watch`)."""

UNLIMITED = 1 << 62
"""The budget of a program that nobody has asked to end.

Its low word is 0, and that of no other is: compiled code looks at nothing else.
"""

STALLED = -1
"""The budget of a program that does not return."""

STOPPED = -2
"""The budget of a program that shall end because the user has asked for it twice."""

REASONS = {STALLED: "the program did not return", STOPPED: "stopped by SIGINT"}


class SystemArea:
    """The page, in the scan process and in the process that watches it.

    Args:
        page: its bytes.

    Attributes:
        cells: signed 64-bit numbers.
    """

    def __init__(self, page: mmap.mmap | memoryview) -> None:
        self.cells = memoryview(page).cast("q")

    @classmethod
    def of_file(cls, fd: int) -> Self:
        """Return the page in a file made by `shared_file`."""
        return cls(mmap.mmap(fd, SIZE))

    @classmethod
    def shared_file(cls) -> int:
        """Return a file for a page that two processes see; the caller closes it."""
        fd = os.memfd_create("plcsim-system-area")
        os.ftruncate(fd, SIZE)
        cls.of_file(fd).rearm()
        return fd

    def rearm(self) -> None:
        """Let programs run: nobody has asked the running one to end, or it has ended."""
        self.cells[BUDGET] = UNLIMITED

    def end_program(self, why: int) -> None:
        """Let the compiled program that runs end itself; ``why`` is `STALLED` or `STOPPED`."""
        self.cells[BUDGET] = why

    @property
    def verdict(self) -> str:
        """Why the running program shall end, in words; "" where it may go on."""
        budget = self.cells[BUDGET]
        return REASONS.get(budget, REASONS[STALLED]) if budget < 0 else ""
