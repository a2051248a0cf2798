"""Measures how long the scan is awake: from each wake-up to the next sleep."""

import json
import time

from plcsim import Program
from plcsim.core.clock import MonotonicClock
from plcsim.core.statistics import Histogram

awake = Histogram()


def measure_sleeps() -> None:
    """Note the time between the end of a sleep and the beginning of the next."""
    sleep_until_ns = MonotonicClock.sleep_until_ns
    woke_ns = 0

    def measured(clock: MonotonicClock, until_ns: int) -> None:
        nonlocal woke_ns
        if woke_ns:
            awake.record(time.monotonic_ns() - woke_ns)
        sleep_until_ns(clock, until_ns)
        woke_ns = time.monotonic_ns()

    MonotonicClock.sleep_until_ns = measured  # type: ignore[method-assign, assignment]  # the probe


class Awake(Program):
    """Does nothing in its cycles."""

    def init(self) -> None:
        """Put the probe in."""
        measure_sleeps()

    def exit(self) -> None:
        """Write the figures."""
        print(json.dumps(awake.summary()._asdict()))
