"""What a controller holds after a tenth of CYCLES, and after all: two rows of figures as JSON.

``python benchmarks/_memory.py CYCLES``. The resident memory is taken first, in a run of its own;
then the allocations are traced over as many cycles again, for tracing takes memory itself.
"""

from __future__ import annotations

import gc
import json
import sys
import tracemalloc
from pathlib import Path
from resource import getpagesize

from _scans import controller_of
from _statements import program_of

STATEMENTS = 5
TRACED_SHARE = 10


def main() -> int:
    cycles = int(sys.argv[1])
    controller = controller_of(program_of(STATEMENTS))
    rows = []
    for share in (cycles // 10, cycles - cycles // 10):
        controller.run(cycles=share)
        rows.append(held(controller.classes[0].cycles))
    tracemalloc.start()
    for row, share in zip(rows, (1, 9), strict=True):
        controller.run(cycles=share * cycles // 10 // TRACED_SHARE)
        gc.collect()
        row["traced_bytes"] = tracemalloc.get_traced_memory()[0]
    json.dump(rows, sys.stdout)
    return 0


def held(cycles: int) -> dict[str, int]:
    """Return the memory held now."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text("ascii").split()[1])
    return {
        "cycles": cycles,
        "resident_kib": pages * getpagesize() // 1024,
        "blocks": sys.getallocatedblocks(),
        "objects": len(gc.get_objects()),
    }


if __name__ == "__main__":
    sys.exit(main())
