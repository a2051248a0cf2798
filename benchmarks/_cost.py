"""Own cost per cycle in real time, in a scan process as `plcsim run` starts it.

``python benchmarks/_cost.py PROJECT CYCLES`` writes the summary of the time from one wake-up to the
next sleep: latch, programs, publish, record, and the search for what is due next.
"""

from __future__ import annotations

import json
import os
import sys
import time
from unittest import mock

from plcsim import scan_process
from plcsim.clock import MonotonicClock
from plcsim.statistics import Histogram
from plcsim.status_page import StatusPage


class AwakeClock(MonotonicClock):
    """Measures how long the scan is awake between two sleeps."""

    def __init__(self) -> None:
        self.awake = Histogram()
        self._woke_ns = 0

    def sleep_until_ns(self, until_ns: int) -> None:
        if self._woke_ns:
            self.awake.record(time.monotonic_ns() - self._woke_ns)
        super().sleep_until_ns(until_ns)
        self._woke_ns = time.monotonic_ns()


def main() -> int:
    project, cycles = sys.argv[1], int(sys.argv[2])
    clock = AwakeClock()
    order = scan_process.RunOrder(
        project,
        virtual=False,
        for_ns=None,
        cycles=cycles,
        status_fd=StatusPage().fd,
        result_fd=os.memfd_create("result"),
        dump_fd=os.memfd_create("dump"),
    )
    sys.argv[1:] = [order.to_json()]
    with mock.patch.object(scan_process, "MonotonicClock", return_value=clock):
        scan_process.main()
    json.dump(clock.awake.summary()._asdict(), sys.stdout)
    return 0


if __name__ == "__main__":
    sys.exit(main())
