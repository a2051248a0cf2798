"""The bare Python loop: what the interpreter alone costs on an absolute grid.

``python -m plcsim.doctor.python_loop CYCLE_NS CYCLES PRIORITY CPU``, with the arguments and the
output of floor.c beside it, and the rights that the host gave and refused.
"""

from __future__ import annotations

import json
import sys
import time

from plcsim.host import realtime


def run(cycle_ns: int, cycles: int) -> tuple[int, list[int]]:
    """Wake ``cycles`` times on the grid; return the missed grid points and each lateness in ns."""
    lateness_ns = [0] * cycles
    missed = 0
    release_ns = time.monotonic_ns() + cycle_ns
    for cycle in range(cycles):
        rest_ns = release_ns - time.monotonic_ns()
        if rest_ns > 0:
            time.sleep(rest_ns / 1e9)
        late_ns = lateness_ns[cycle] = time.monotonic_ns() - release_ns
        passed = max(1, -(-late_ns // cycle_ns))
        missed += passed - 1
        release_ns += passed * cycle_ns
    return missed, lateness_ns


def main() -> int:
    """Run the loop as the arguments say and write the figures to stdout."""
    cycle_ns, cycles, priority, cpu = (int(argument) for argument in sys.argv[1:])
    realtime.sharpen_timers()
    rights = realtime.Rights((), ())
    if priority:
        rights = realtime.acquire(priority, None if cpu < 0 else cpu)
        realtime.settle(rights)
    missed, lateness_ns = run(cycle_ns, cycles)
    figures = {"missed": missed, "lateness_ns": lateness_ns, "rights": rights._asdict()}
    json.dump(figures, sys.stdout)
    return 0


if __name__ == "__main__":
    sys.exit(main())
