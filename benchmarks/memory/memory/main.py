"""Uses variables, a string and a timer, and tells what the process holds as the cycles go by.

What is resident and allocated is told after a tenth of PLCSIM_CYCLES and after all of them. Then
allocations are traced (tracing takes memory itself) and told after a hundredth and a tenth more.
"""

import gc
import json
import os
import sys
import tracemalloc
from pathlib import Path
from resource import getpagesize

from plcsim import Program
from plcsim.library.standard import TON
from st_types import BOOL, REAL, STRING, UDINT, var

CYCLES = int(os.environ["PLCSIM_CYCLES"])

held: list[dict[str, int]] = []
traced: list[int] = []


def hold() -> None:
    """Note what the process holds."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text("ascii").split()[1])
    held.append(
        {
            "resident_kib": pages * getpagesize() // 1024,
            "blocks": sys.getallocatedblocks(),
            "objects": len(gc.get_objects()),
        }
    )


def hold_and_trace() -> None:
    """Note what the process holds, and trace from now on."""
    hold()
    tracemalloc.start()


def trace() -> None:
    """Note what was allocated since tracing began and is still held."""
    gc.collect()
    traced.append(tracemalloc.get_traced_memory()[0])


MARKS = {
    CYCLES // 10: hold,
    CYCLES: hold_and_trace,
    CYCLES + CYCLES // 100: trace,
    CYCLES + CYCLES // 10: trace,
}


class Memory(Program):
    """A few statements of each kind."""

    cycles = var(UDINT)
    level = var(REAL)
    full = var(BOOL)
    text = var(STRING(20))
    timer = var(TON)

    def cyclic(self) -> None:
        """Count, fill, time, write; tell at the marks."""
        self.cycles += 1
        self.level = 0.0 if self.full else self.level + 0.25
        self.full = self.level > 100.0
        self.timer(IN=not self.timer.Q, PT=50)
        self.text = "full" if self.full else "filling"
        if self.cycles in MARKS:
            MARKS[self.cycles]()

    def exit(self) -> None:
        """Write the figures."""
        print(json.dumps({"held": held, "traced_bytes": traced}))
