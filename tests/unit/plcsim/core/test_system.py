"""The table of system states."""

import pytest

from plcsim.core.errors import StateError
from plcsim.core.system import TRANSITIONS, Event, State, next_state


@pytest.mark.parametrize(
    ("events", "state"),
    [
        ([Event.INITIALISED], State.RUN),
        ([Event.FAULT], State.SERVICE),
        ([Event.INITIALISED, Event.STOP], State.STOPPED),
        ([Event.INITIALISED, Event.FAULT], State.SERVICE),
        ([Event.INITIALISED, Event.STOP, Event.FAULT], State.SERVICE),
        ([Event.FAULT, Event.RESTART, Event.INITIALISED], State.RUN),
        ([Event.INITIALISED, Event.STOP, Event.RESTART], State.BOOT),
    ],
)
def test_events_lead_from_boot(events, state):
    reached = State.BOOT
    for event in events:
        reached = next_state(reached, event)
    assert reached is state


def test_every_state_has_its_row_and_service_is_left_by_a_restart_only():
    assert TRANSITIONS.keys() == set(State)
    assert TRANSITIONS[State.SERVICE].keys() == {Event.RESTART}


def test_an_event_that_is_not_in_the_table_is_refused_by_name():
    with pytest.raises(StateError, match="not possible in state SERVICE: somebody asked to stop"):
        next_state(State.SERVICE, Event.STOP)
