"""Two clocks with one interface, so that one scan loop serves both.

`MonotonicClock` sleeps on an absolute grid of CLOCK_MONOTONIC. `VirtualClock` jumps: time moves
only when the scan sleeps, or when somebody says what an execution cost. A clock knows the time, the
CPU time this thread has used, both in nanoseconds, and how often the thread gave up the CPU by
itself, which tells a program that waits from a host that took the CPU away.
"""

from __future__ import annotations

import time
from resource import RUSAGE_THREAD, getrusage
from typing import TYPE_CHECKING, Protocol

from plcsim.core.control import AS_FAST_AS_POSSIBLE, REAL_TIME

if TYPE_CHECKING:
    from collections.abc import Callable

LONGEST_SLEEP_NS = 100_000_000
"""A sleep is cut into pieces of this length, so that a stop request is seen in time."""


VIRTUAL_DATE_NS = 946_684_800_000_000_000
"""Date at which a controller on the virtual clock starts: 2000-01-01, nanoseconds since 1970."""


class Clock(Protocol):
    """What the scan loop asks of time."""

    is_virtual: bool

    def now_ns(self) -> int:
        """Return the time, nanoseconds from an arbitrary origin, never going back."""

    def sleep_until_ns(self, until_ns: int) -> None:
        """Return at ``until_ns`` or later, or after `LONGEST_SLEEP_NS`; at once if it is past."""

    def cpu_ns(self) -> int:
        """Return the CPU time that this thread has used, in nanoseconds."""

    def waits(self) -> int:
        """Return how often this thread gave up the CPU by waiting."""

    def unix_ns(self) -> int:
        """Return the time of day, nanoseconds since 1970; the clock's own time where virtual."""

    def stamp_ns(self) -> int:
        """Return the time for records only: nothing that runs may depend on it."""


class MonotonicClock:
    """CLOCK_MONOTONIC: never set, not in steps when the host's wall clock is.

    Args:
        cpu_ns: tells the CPU time of the thread that runs the scan.
    """

    is_virtual = False

    now_ns = stamp_ns = staticmethod(time.monotonic_ns)
    unix_ns = staticmethod(time.time_ns)

    def __init__(self, cpu_ns: Callable[[], int] = time.thread_time_ns) -> None:
        self.cpu_ns = cpu_ns

    def sleep_until_ns(self, until_ns: int) -> None:
        """Sleep until ``until_ns``, at most `LONGEST_SLEEP_NS`.

        CPython 3.11 and later turn the rest into an absolute deadline of clock_nanosleep, so an
        interrupted sleep does not drift.
        """
        rest_ns = until_ns - time.monotonic_ns()
        if rest_ns > 0:
            time.sleep(min(rest_ns, LONGEST_SLEEP_NS) / 1e9)

    def waits(self) -> int:
        """Return the voluntary context switches of this thread (getrusage(2), ru_nvcsw)."""
        return getrusage(RUSAGE_THREAD).ru_nvcsw


class VirtualClock:
    """A clock that jumps to where the scan wants to sleep.

    Args:
        start_ns: the first time; above 0 by default, because ROS takes 0 for "no time yet".
    """

    is_virtual = True

    def __init__(self, start_ns: int = 1_000_000_000) -> None:
        self._now_ns = start_ns
        self._speed = AS_FAST_AS_POSSIBLE
        self._anchor_ns = (0, 0)
        self._cpu_ns = 0
        self._waits = 0

    def now_ns(self) -> int:
        """Return the virtual time."""
        return self._now_ns

    unix_ns = stamp_ns = now_ns

    def sleep_until_ns(self, until_ns: int) -> None:
        """Jump to ``until_ns``; never back. With a speed, return early where it is not yet due."""
        if self._speed == AS_FAST_AS_POSSIBLE or self._is_due(until_ns):
            self._now_ns = max(self._now_ns, until_ns)

    def pace(self, speed: int) -> None:
        """Run at a speed from now on.

        What happens at which virtual time stays the same; only the waiting between is real.

        Args:
            speed: in millionths of real time (`plcsim.core.control.REAL_TIME`), or
                `AS_FAST_AS_POSSIBLE`.
        """
        self._speed = speed
        self._anchor_ns = (time.monotonic_ns(), self._now_ns)

    def _is_due(self, until_ns: int) -> bool:
        """Wait, at most `LONGEST_SLEEP_NS`; return whether ``until_ns`` has come at this speed."""
        real_ns, virtual_ns = self._anchor_ns
        due_ns = real_ns + (until_ns - virtual_ns) * REAL_TIME // self._speed
        rest_ns = due_ns - time.monotonic_ns()
        if rest_ns > 0:
            time.sleep(min(rest_ns, LONGEST_SLEEP_NS) / 1e9)
            return rest_ns <= LONGEST_SLEEP_NS
        if rest_ns < -LONGEST_SLEEP_NS:  # too slow, or just gone on after a pause: no burst
            self._anchor_ns = (time.monotonic_ns(), until_ns)
        return True

    def cpu_ns(self) -> int:
        """Return the CPU time spent so far, as told by `spend_ns`."""
        return self._cpu_ns

    def waits(self) -> int:
        """Return how often `wait_ns` was called."""
        return self._waits

    def wind_back_to_ns(self, earlier_ns: int) -> None:
        """Be again where the clock was, to run from there once more."""
        self._now_ns = min(self._now_ns, earlier_ns)

    def spend_ns(self, duration_ns: int) -> None:
        """Let a program use ``duration_ns`` of CPU time."""
        self._now_ns += duration_ns
        self._cpu_ns += duration_ns

    def stall_ns(self, duration_ns: int) -> None:
        """Let the host take the CPU away for ``duration_ns``."""
        self._now_ns += duration_ns

    def wait_ns(self, duration_ns: int) -> None:
        """Let a program wait for something for ``duration_ns`` (a blocking call)."""
        self._now_ns += duration_ns
        self._waits += 1


def first_date_ns(clock: Clock) -> int:
    """Return the date of a controller that starts now, in nanoseconds since 1970.

    On the real clock it is the host's, on the virtual one always the same.
    """
    return VIRTUAL_DATE_NS if clock.is_virtual else time.time_ns()
