"""State machines as tables: for each state, what may happen there and the state that follows.

All transitions of a machine stand in its table; the code around it only says what happened. The
diagrams in docs/state-machines.md are generated from the tables.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from typing import TypeAlias, TypeVar

from crosnode.errors import LocalProtocolError

S = TypeVar("S", bound=Enum)
T = TypeVar("T", bound=Enum)

Transitions: TypeAlias = Mapping[S, Mapping[T, S]]


def next_state(table: Transitions[S, T], state: S, trigger: T, machine: str) -> S:
    """Return the state that follows.

    Args:
        table: all transitions of the machine.
        state: the present one.
        trigger: what happens.
        machine: name of the machine, for the error.

    Raises:
        LocalProtocolError: this cannot happen in this state.
    """
    try:
        return table[state][trigger]
    except KeyError:
        raise LocalProtocolError(f"{machine}: {trigger.name} in state {state.name}") from None
