"""Timers of IEC 61131-3: TON, TOF, TP.

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


class Timer(FunctionBlock):
    """What the timers share: the release they started at.

    The controller's data block has two 32-bit internals for it, StartTime and Restart, side by
    side. Together they hold one 64-bit count of nanoseconds, low word first: 1 + the release of the
    start, 0 where there was none. Milliseconds in StartTime alone would end a timer up to 1 ms
    early where releases are not whole milliseconds, and would wrap after 2^32 ms.
    """

    __slots__ = ()

    PT: int
    StartTime: int
    Restart: int

    def _start(self) -> None:
        """Start at the release of the running task class."""
        self._set_start(1 + self.context.release_ns)

    def _clear(self) -> None:
        """Forget the start."""
        self._set_start(0)

    def _set_start(self, start: int) -> None:
        self.StartTime = start  # a store keeps the low 32 bits
        self.Restart = start >> 32

    @property
    def _started(self) -> bool:
        """True from `_start` to `_clear`."""
        return bool(self.StartTime or self.Restart)

    def _elapsed(self) -> int:
        """Return the milliseconds since the start, within 0..PT; 0 for a PT below 0."""
        start = self.Restart << 32 | self.StartTime & 0xFFFF_FFFF
        elapsed = (1 + self.context.release_ns - start) // NS_PER_MS
        return max(0, min(elapsed, self.PT))


class TON(interface.TON, Timer):
    """On-delay timer: Q follows a rising edge of IN after PT, a falling edge at once.

    Inputs: IN, PT (TIME, ms). Outputs: Q, ET (TIME, ms; 0 while IN is FALSE).
    """

    def execute(self) -> None:
        """Run the timer for one call."""
        if not self.IN:
            self.M = self.Q = False
            self.ET = 0
            return
        if not self.M:
            self.M = True
            self._start()
        if not self.Q:
            self.ET = self._elapsed()
            self.Q = self.ET >= self.PT


class TOF(interface.TOF, Timer):
    """Off-delay timer: Q follows a falling edge of IN after PT, a rising edge at once.

    Inputs: IN, PT (TIME, ms). Outputs: Q, ET (TIME, ms; 0 while IN is TRUE or never was).
    """

    def execute(self) -> None:
        """Run the timer for one call."""
        if self.IN:
            self.M = self.Q = True
            self.ET = 0
            return
        if self.M:
            self.M = False
            self._start()
        if self.Q:
            self.ET = self._elapsed()
            self.Q = self.ET < self.PT


class TP(interface.TP, Timer):
    """Pulse timer: a rising edge of IN makes Q TRUE for PT; IN has no effect during the pulse.

    After the pulse ET stays at PT while IN is TRUE; IN must be FALSE in one call before the next
    pulse can start. Inputs: IN, PT (TIME, ms). Outputs: Q, ET (TIME, ms).
    """

    def execute(self) -> None:
        """Run the timer for one call."""
        if self.IN and not self._started:
            self._start()
            self.Q = True
        if self.Q:
            self.ET = self._elapsed()
            self.Q = self.ET < self.PT
        if not (self.Q or self.IN):
            self._clear()
            self.ET = 0
