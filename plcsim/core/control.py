"""What an operator may ask of a controller: stop, pause, go on, single cycles, restart, speed.

A request is made at any time of the scan and carried out between two cycles, by whoever runs the
controller (`plcsim.process.operation`).
"""

from __future__ import annotations

from enum import Enum
from typing import NamedTuple


class Action(Enum):
    """The acts; the controller's own words for them."""

    STOP = 1
    PAUSE = 2
    CONTINUE = 3
    CYCLES = 4
    WARM_RESTART = 5
    COLD_RESTART = 6
    SPEED = 7


class Step(Enum):
    """What is done to a controller between its cycles."""

    BOOT = 1
    START = 2
    RESUME = 3
    SHUTDOWN = 4
    CLOSE = 5
    RUN = 6


class Ending(Enum):
    """How a run is asked to end after its cycle."""

    PAUSE = 1
    STOP = 2


AS_FAST_AS_POSSIBLE = 0
"""The speed of a virtual clock that waits for nothing."""

REAL_TIME = 1_000_000
"""The speed of a virtual clock that runs as time does; 10 times this is ten times as fast."""


class Request(NamedTuple):
    """One request.

    Attributes:
        action: the act.
        argument: of CYCLES, how many cycles of the class with the lowest number; of SPEED, in
            millionths of `REAL_TIME`.
        source: who asks, for the logbook.
    """

    action: Action
    argument: int = 0
    source: str = ""
