"""Work in a second process, for what it leaves on disk.

A copy of this process does it, so it begins with all that is in memory here; what it makes there is
lost. Where the work shall be of use, it fills a cache that is asked here afterwards.
"""

from __future__ import annotations

import fcntl
import os
import signal
import sys
from contextlib import ExitStack, contextmanager, suppress
from typing import TYPE_CHECKING, Final

from plcsim.host import realtime

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

FEWEST_FOR_HELP: Final = 8
"""Jobs that are worth a second process."""

_NUMBER_BYTES: Final = 4


def share(count: int, do: Callable[[int], bool], tell: Callable[[int], None]) -> None:
    """Do jobs, some of them in a copy of this process where that can be of use.

    Args:
        count: of the jobs.
        do: does one by its number, and returns whether that was work that caches did not know.
        tell: told how many are done or begun, here and there, after each that is done here.
    """
    with ExitStack() as stack:
        numbers = stack.enter_context(SharedNumbers(count))
        wait = None
        for number in numbers:
            is_new = do(number)
            tell(numbers.taken)
            if is_new and wait is None and count >= FEWEST_FOR_HELP and can_help():
                wait = stack.enter_context(helper_process(lambda: [*map(do, numbers)]))
        if wait is not None:
            wait()


def can_help() -> bool:
    """Whether there is a processor for a second process, and a copy of this one can work.

    A copy has one thread: locks that another thread holds here would stay locked there for ever.
    Beside a process with real-time rights there is no processor for a copy, which has them too.
    """
    return is_alone() and len(os.sched_getaffinity(0)) > 1 and not realtime.is_held()


def is_alone() -> bool:
    """Whether a copy of this process can work, if beside it or while it waits."""
    return len(sys._current_frames()) == 1 and sys.gettrace() is None


class SharedNumbers:
    """The numbers from 0 on, which this process and copies of it take: each is taken once.

    They stand in a file without a name, whose offset the copies share.

    Args:
        count: of the numbers.
    """

    def __init__(self, count: int) -> None:
        self._fd = os.memfd_create("numbers")
        with os.fdopen(os.dup(self._fd), "wb") as file:
            file.writelines(n.to_bytes(_NUMBER_BYTES, "little") for n in range(count))
        os.lseek(self._fd, 0, os.SEEK_SET)

    def __iter__(self) -> Iterator[int]:
        """Take numbers until there are no more."""
        while taken := self._take():
            yield int.from_bytes(taken, "little")

    def _take(self) -> bytes:
        """Read the next; under a lock, for reads of such a file do not wait for each other."""
        fcntl.lockf(self._fd, fcntl.LOCK_EX)  # goes with its process, should that be killed
        try:
            return os.read(self._fd, _NUMBER_BYTES)
        finally:
            fcntl.lockf(self._fd, fcntl.LOCK_UN)

    @property
    def taken(self) -> int:
        """How many are taken, here and elsewhere."""
        return os.lseek(self._fd, 0, os.SEEK_CUR) // _NUMBER_BYTES

    def __enter__(self) -> SharedNumbers:
        """Return these numbers."""
        return self

    def __exit__(self, *_error: object) -> None:
        """Forget them; copies of this process keep theirs."""
        os.close(self._fd)


@contextmanager
def helper_process(work: Callable[[], object]) -> Iterator[Callable[[], None]]:
    """Do work in a copy of this process during the block; give what waits for its end.

    Nothing is told of how it ends, and it prints nothing. It is killed where the block ends before.
    """
    sys.stdout.flush()
    sys.stderr.flush()
    pid = os.fork()
    if pid == 0:
        _help(work)
    is_over = False

    def wait() -> None:
        nonlocal is_over
        if not is_over:
            with suppress(ChildProcessError):
                os.waitpid(pid, 0)
            is_over = True

    try:
        yield wait
    finally:
        if not is_over:
            with suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
            wait()


def _help(work: Callable[[], object]) -> None:
    """Do the work, and end without running what belongs to the other process."""
    try:
        nowhere = os.open(os.devnull, os.O_RDWR)
        for stream in (0, 1, 2):
            os.dup2(nowhere, stream)
        work()
    finally:
        os._exit(0)
