"""System states of the controller: BOOT, RUN, SERVICE, STOPPED, as one table.

The controller also knows DIAGNOSIS (no valid application); here a project that cannot be loaded is
a configuration error before BOOT.
"""

from __future__ import annotations

from enum import Enum
from typing import Final

from plcsim.core.errors import StateError


class State(Enum):
    """What the controller is doing; values go into the status page."""

    BOOT = 1
    RUN = 2
    SERVICE = 3
    STOPPED = 4


class Event(Enum):
    """What changes the state."""

    INITIALISED = "all INIT units have run"
    FAULT = "a program failed or violated its cycle time"
    STOP = "somebody asked to stop"
    RESTART = "somebody asked for a restart"


TRANSITIONS: Final[dict[State, dict[Event, State]]] = {
    State.BOOT: {Event.INITIALISED: State.RUN, Event.FAULT: State.SERVICE},
    State.RUN: {Event.FAULT: State.SERVICE, Event.STOP: State.STOPPED},
    State.SERVICE: {Event.RESTART: State.BOOT},
    State.STOPPED: {Event.FAULT: State.SERVICE, Event.RESTART: State.BOOT},
}
"""Every transition.

SERVICE has no STOP, so that the way a run ended is not lost. An EXIT that fails after STOP leads to
SERVICE too.
"""


def next_state(state: State, event: Event) -> State:
    """Return the state that follows.

    Raises:
        StateError: the event cannot happen in this state.
    """
    if event not in TRANSITIONS[state]:
        raise StateError(f"not possible in state {state.name}: {event.value}")
    return TRANSITIONS[state][event]
