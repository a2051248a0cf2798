"""What all connections share: the table, the deadline, the bytes to send."""

from typing import ClassVar

import pytest

from crosnode.errors import LocalProtocolError
from crosnode.transport.connection import (
    ConnectionEvent,
    ConnectionState,
    ProtocolConnection,
    Silent,
    Table,
    Trigger,
)
from crosnode.transport.dyn_buffer import Data


class Example(ProtocolConnection):
    """Waits in time for a request, then answers without haste."""

    TABLE: ClassVar[Table] = {
        ConnectionState.REQUEST: {
            Trigger.REQUEST: ConnectionState.REPLY,
            Trigger.END: ConnectionState.CLOSED,
        },
        ConnectionState.REPLY: {
            Trigger.REPLY: ConnectionState.REQUEST,
            Trigger.END: ConnectionState.CLOSED,
        },
        ConnectionState.CLOSED: {},
    }
    PAUSED: ClassVar[frozenset[ConnectionState]] = frozenset(
        {ConnectionState.REPLY, ConnectionState.CLOSED}
    )
    TIMED: ClassVar[frozenset[ConnectionState]] = frozenset({ConnectionState.REQUEST})
    IS_PARSED: ClassVar[bool] = False

    def event_price(self, now_ns: int) -> int:
        return 1

    def receive_data(self, data: Data) -> None:
        raise NotImplementedError

    def receive_eof(self) -> None:
        raise NotImplementedError

    def next_event(self, now_ns: int) -> ConnectionEvent | None:
        raise NotImplementedError


def example() -> Example:
    return Example(ConnectionState.REQUEST, timeout_ns=100, now_ns=1000)


def test_moves_by_the_table_only() -> None:
    connection = example()
    connection._move(Trigger.REQUEST)
    assert connection.state is ConnectionState.REPLY
    with pytest.raises(LocalProtocolError, match="Example: REQUEST in state REPLY"):
        connection._move(Trigger.REQUEST)
    assert connection.state is ConnectionState.REPLY


def test_deadline_only_in_timed_states() -> None:
    connection = example()
    assert connection.deadline_ns == 1100
    assert connection.handle_timer(1099) is None
    connection._move(Trigger.REQUEST)
    assert connection.deadline_ns is None
    assert connection.handle_timer(10**9) is None
    connection._move(Trigger.REPLY)
    assert connection.handle_timer(1100) == Silent("silent for 100 ns")
    assert connection.state is ConnectionState.CLOSED


def test_paused_states_want_no_data() -> None:
    connection = example()
    assert connection.wants_data
    connection._move(Trigger.REQUEST)
    assert not connection.wants_data


def test_bytes_are_given_once() -> None:
    connection = example()
    connection.outbox += [b"a", b"b"]
    assert connection.data_to_send() == [b"a", b"b"]
    assert connection.data_to_send() == []


def test_close_twice() -> None:
    connection = example()
    connection.close()
    connection.close()
    assert connection.state is ConnectionState.CLOSED
