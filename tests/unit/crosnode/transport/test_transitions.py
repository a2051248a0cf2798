"""A machine goes where its table says, and nowhere else; what every table of crosnode keeps."""

from enum import Enum, auto
from typing import Any

import pytest

from crosnode.errors import LocalProtocolError
from crosnode.node.life import LIFE
from crosnode.node.publisher_link import PUBLISHER_LINK
from crosnode.node.registration import REGISTRATION, RegistrationState
from crosnode.tcpros import service, topic
from crosnode.transport.link import LINK, LinkState
from crosnode.transport.transitions import Transitions, next_state
from crosnode.xmlrpc import connection


class Door(Enum):
    OPEN = auto()
    SHUT = auto()


class Hand(Enum):
    PUSH = auto()
    PULL = auto()


TABLE: Transitions[Door, Hand] = {
    Door.OPEN: {Hand.PUSH: Door.SHUT},
    Door.SHUT: {Hand.PULL: Door.OPEN},
}


def test_goes_where_the_table_says() -> None:
    assert next_state(TABLE, Door.OPEN, Hand.PUSH, "door") is Door.SHUT
    with pytest.raises(LocalProtocolError, match="door: PUSH in state SHUT"):
        next_state(TABLE, Door.SHUT, Hand.PUSH, "door")


TABLES: dict[str, Any] = {
    "link": LINK,
    "publisher link": PUBLISHER_LINK,
    "registration": REGISTRATION,
    "life": LIFE,
    "publisher": topic.PUBLISHER,
    "subscriber": topic.SUBSCRIBER,
    "service client": service.CLIENT,
    "service server": service.SERVER,
    "XML-RPC client": connection.CLIENT,
    "XML-RPC server": connection.SERVER,
}


@pytest.mark.parametrize("name", TABLES)
def test_every_state_is_reached_and_leads_to_the_last(name: str) -> None:
    table = TABLES[name]
    first, *_ = table
    (last,) = (state for state, row in table.items() if not row or state is RegistrationState.GONE)
    assert {first} | {to for row in table.values() for to in row.values()} == set(table)
    for state in table:
        seen, todo = set(), [state]
        while todo:
            here = todo.pop()
            if here not in seen:
                seen.add(here)
                todo += table[here].values()
        assert last in seen


def test_a_lost_link_is_over_whatever_it_did() -> None:
    ends = {state for row in LINK.values() for state in row.values()}
    assert LinkState.OVER in ends
    assert all(LinkState.OVER in row.values() for state, row in LINK.items() if row)
