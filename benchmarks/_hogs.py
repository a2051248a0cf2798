"""CPU hogs: one busy process for each processor, for experiments on a loaded machine."""

from __future__ import annotations

import os
import subprocess
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

BUSY = "x = 0\nwhile True:\n    x = (x * 3 + 1) % 1000003\n"


@contextmanager
def hogs(count: int = 0, *, wanted: bool = True) -> Iterator[None]:
    """Keep every processor busy inside the block, or so many."""
    count = (count or len(os.sched_getaffinity(0))) if wanted else 0
    running = [subprocess.Popen([sys.executable, "-c", BUSY]) for _ in range(count)]
    try:
        yield
    finally:
        for process in running:
            process.kill()
        for process in running:
            process.wait()
