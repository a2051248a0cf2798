"""The real clock for tests: it stands still while the test itself runs."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from plcsim.core.clock import MonotonicClock
from plcsim.host.running_time import cpu_time

if TYPE_CHECKING:
    from types import TracebackType


class WallClock(MonotonicClock):
    """CLOCK_MONOTONIC that runs only inside ``with clock:``.

    Between two calls of `Plc.run` a test computes and compares; on the controller that time does
    not exist, and no grid point must be missed because of it.
    """

    def __init__(self) -> None:
        super().__init__(cpu_time())
        self._shift_ns = 0
        self._stopped_ns: int | None = time.monotonic_ns()

    def __enter__(self) -> None:
        if self._stopped_ns is not None:
            self._shift_ns += time.monotonic_ns() - self._stopped_ns
            self._stopped_ns = None

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stopped_ns = time.monotonic_ns()

    def now_ns(self) -> int:
        """Return the time without that in which the clock stood still."""
        here_ns = time.monotonic_ns() if self._stopped_ns is None else self._stopped_ns
        return here_ns - self._shift_ns

    stamp_ns = now_ns

    def sleep_until_ns(self, until_ns: int) -> None:
        """Sleep until ``until_ns`` of this clock."""
        super().sleep_until_ns(until_ns + self._shift_ns)
