"""Blinky: a lamp that changes every half second."""

from plcsim import Program
from plcsim.library.standard import TON
from st_types import BOOL, TIME, UDINT, var


class Blinky(Program):
    """One timer that starts itself again."""

    lamp = var(BOOL)
    changes = var(UDINT)
    half_period = var(TIME, 500)
    timer = var(TON)

    def cyclic(self) -> None:
        """Change the lamp when the timer has run down, and start the timer again at once.

        The second pair of calls starts it in the same cycle. With IN=not Q, as one often sees it,
        every half period would be two cycles too long.
        """
        self.timer(IN=True, PT=self.half_period)
        if self.timer.Q:
            self.lamp = not self.lamp
            self.changes += 1
            self.timer(IN=False)
            self.timer(IN=True)
