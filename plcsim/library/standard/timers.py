"""Timers of IEC 61131-3: TON, TOF, TP; and TON_10ms, TOF_10ms, TP_10ms, which count ticks of 10 ms.

What the standard leaves to the implementation, for all three alike:

- PT may change while the timer runs and holds from that call on: a PT that is not above the time
  passed ends it at once. Once the timer has run out, a change of PT has no effect before the next
  start.
- A PT of 0 or less runs out in the call that starts it.
- A timer that runs out between two releases shows it at the second one, never early; ET is 0 in the
  call that starts it and PT, not more, when it has run out.
"""

from __future__ import annotations

from plcsim.core.function_block import FunctionBlock
from plcsim.library.standard import interface

NS_PER_MS = 1_000_000
NS_PER_TICK = 10_000_000

TICK_COUNTS = 1 << 32
"""Ticks are counted in a UDINT."""


class Timer(FunctionBlock):
    """What all timers share.

    How a timer knows when it started is left to `MillisecondTimer` and `TickTimer`.
    """

    __slots__ = ()

    IN: bool
    PT: int
    Q: bool
    ET: int
    M: bool

    def start(self) -> None:
        """Start at the release of the running task class."""
        raise NotImplementedError

    def clear(self) -> None:
        """Forget the start."""
        raise NotImplementedError

    @property
    def started(self) -> bool:
        """True from `start` to `clear`."""
        raise NotImplementedError

    def elapsed(self, limit: int) -> int:
        """Return the time since the start, within 0 and a limit; 0 for a limit below 0."""
        raise NotImplementedError


class MillisecondTimer(Timer):
    """A timer in milliseconds.

    The controller's data block has two 32-bit internals for it, StartTime and Restart, side by
    side. Together they hold one 64-bit count of nanoseconds, low word first: 1 + the release of the
    start, 0 where there was none. Milliseconds in StartTime alone would end a timer up to 1 ms
    early where releases are not whole milliseconds, and would wrap after 2^32 ms.
    """

    __slots__ = ()

    StartTime: int
    Restart: int

    def start(self) -> None:
        """Start at the release of the running task class."""
        self._set_start(1 + self.context.release_ns)

    def clear(self) -> None:
        """Forget the start."""
        self._set_start(0)

    def _set_start(self, start: int) -> None:
        self.StartTime = start  # a store keeps the low 32 bits
        self.Restart = start >> 32

    @property
    def started(self) -> bool:
        """True from `start` to `clear`."""
        return bool(self.StartTime or self.Restart)

    def elapsed(self, limit: int) -> int:
        """Return the milliseconds since the start."""
        start = self.Restart << 32 | self.StartTime & 0xFFFF_FFFF
        elapsed = (1 + self.context.release_ns - start) // NS_PER_MS
        elapsed = min(limit, elapsed)
        return elapsed if elapsed > 0 else 0  # quicker than min() and max()


class TickTimer(Timer):
    """A timer in ticks of 10 ms: StartTime is 1 + the tick of the start, 0 where there was none."""

    __slots__ = ()

    StartTime: int

    def start(self) -> None:
        """Start at the release of the running task class."""
        self.StartTime = 1 + self._tick % (TICK_COUNTS - 1)

    def clear(self) -> None:
        """Forget the start."""
        self.StartTime = 0

    @property
    def started(self) -> bool:
        """True from `start` to `clear`."""
        return bool(self.StartTime)

    def elapsed(self, limit: int) -> int:
        """Return the ticks since the start."""
        return min((1 + self._tick - self.StartTime) % (TICK_COUNTS - 1), limit)

    @property
    def _tick(self) -> int:
        return self.context.release_ns // NS_PER_TICK


class OnDelay(Timer):
    """What TON and TON_10ms do."""

    __slots__ = ()

    def execute(self) -> None:
        """Run the timer for one call."""
        if not self.IN:
            self.M = self.Q = False
            self.ET = 0
            return
        if not self.M:
            self.M = True
            self.start()
        if not self.Q:
            limit = self.PT
            elapsed = self.ET = self.elapsed(limit)
            self.Q = elapsed >= limit


class TON(interface.TON, OnDelay, MillisecondTimer):
    """On-delay timer: Q follows a rising edge of IN after PT, a falling edge at once.

    Inputs: IN, PT (TIME, ms). Outputs: Q, ET (TIME, ms; 0 while IN is FALSE).
    """


class TON_10ms(interface.TON_10ms, OnDelay, TickTimer):  # noqa: N801  # the controller's name
    """The same in ticks of 10 ms: PT and ET are UDINTs."""


class OffDelay(Timer):
    """What TOF and TOF_10ms do."""

    __slots__ = ()

    def execute(self) -> None:
        """Run the timer for one call."""
        if self.IN:
            self.M = self.Q = True
            self.ET = 0
            return
        if self.M:
            self.M = False
            self.start()
        if self.Q:
            limit = self.PT
            elapsed = self.ET = self.elapsed(limit)
            self.Q = elapsed < limit


class TOF(interface.TOF, OffDelay, MillisecondTimer):
    """Off-delay timer: Q follows a falling edge of IN after PT, a rising edge at once.

    Inputs: IN, PT (TIME, ms). Outputs: Q, ET (TIME, ms; 0 while IN is TRUE or never was).
    """


class TOF_10ms(interface.TOF_10ms, OffDelay, TickTimer):  # noqa: N801  # the controller's name
    """The same in ticks of 10 ms: PT and ET are UDINTs."""


class Pulse(Timer):
    """What TP and TP_10ms do."""

    __slots__ = ()

    def execute(self) -> None:
        """Run the timer for one call."""
        if self.IN and not self.started:
            self.start()
            self.Q = True
        if self.Q:
            limit = self.PT
            elapsed = self.ET = self.elapsed(limit)
            self.Q = elapsed < limit
        if not (self.Q or self.IN):
            self.clear()
            self.ET = 0


class TP(interface.TP, Pulse, MillisecondTimer):
    """Pulse timer: a rising edge of IN makes Q TRUE for PT; IN has no effect during the pulse.

    After the pulse ET stays at PT while IN is TRUE; IN must be FALSE in one call before the next
    pulse can start. Inputs: IN, PT (TIME, ms). Outputs: Q, ET (TIME, ms).
    """


class TP_10ms(interface.TP_10ms, Pulse, TickTimer):  # noqa: N801  # the controller's name
    """The same in ticks of 10 ms: PT and ET are UDINTs."""
