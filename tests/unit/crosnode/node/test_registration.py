"""The ways of a registration; what each leads to is in test_master_client.py."""

import pytest

from crosnode.errors import LocalProtocolError
from crosnode.node.registration import (
    REGISTRATION,
    Registration,
    RegistrationState,
    RegistrationTrigger,
)


def made(*triggers: RegistrationTrigger) -> Registration:
    registration = Registration("/x", ("register", []), ("unregister", []))
    for trigger in triggers:
        registration.move(trigger)
    return registration


def test_taken_back_before_a_master_heard_of_it() -> None:
    assert made(RegistrationTrigger.REMOVED).state is RegistrationState.GONE


def test_taken_back_while_the_master_is_away_it_is_stale() -> None:
    registration = made(
        RegistrationTrigger.CALLED, RegistrationTrigger.TAKEN, RegistrationTrigger.FORGOTTEN
    )
    assert registration.is_wanted
    assert not registration.is_settled
    assert registration.move(RegistrationTrigger.REMOVED) is RegistrationState.STALE
    assert not registration.is_wanted


def test_nothing_happens_to_what_is_gone() -> None:
    registration = made(RegistrationTrigger.REMOVED)
    with pytest.raises(LocalProtocolError, match="registration of /x: CALLED in state GONE"):
        registration.move(RegistrationTrigger.CALLED)


def test_a_state_that_may_be_known_to_a_master_does_not_just_vanish() -> None:
    known = (RegistrationState.CALLING, RegistrationState.REGISTERED, RegistrationState.AGAIN)
    for state in known:
        assert RegistrationState.GONE not in REGISTRATION[state].values()
