"""The page that the controller shares with compiled code, and with who watches the scan.

Compiled programs poll the budget at every back edge and every entry of a function, because neither
a signal handler nor another thread of Python can end them; the watchdog, which is another process,
ends them by writing it (docs/timing-model.md).
"""

from __future__ import annotations

import ctypes
import mmap
import os

SIZE = 0x1_0000
"""Bytes: a page of PLC memory."""

BUDGET, RELEASE = range(2)
"""Indices of 64-bit cells: the budget; the release time of the running task class in ns."""

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
        fd: file made by `shared`; None keeps the page to this process.

    Attributes:
        cells: signed 64-bit numbers.
    """

    def __init__(self, fd: int | None = None) -> None:
        self._map = mmap.mmap(-1 if fd is None else fd, SIZE)
        self.cells = memoryview(self._map).cast("q")
        if fd is None:
            self.rearm()

    @staticmethod
    def shared() -> int:
        """Return a file for a page that two processes see; the caller closes it."""
        fd = os.memfd_create("plcsim-system-area")
        os.ftruncate(fd, SIZE)
        SystemArea(fd).rearm()
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

    def host_address(self) -> int:
        """Return where the page lies in this process, for a second mapping of it."""
        return ctypes.addressof(ctypes.c_char.from_buffer(self._map))
