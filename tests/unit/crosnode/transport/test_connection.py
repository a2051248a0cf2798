"""What all connections share: the table, the deadline, the bytes to send."""

from typing import ClassVar

import pytest

from crosnode.errors import LocalProtocolError
from crosnode.transport.connection import Act, Connection, Failed, State, Table


class Example(Connection):
    """Waits in time for a request, then answers without haste."""

    TABLE: ClassVar[Table] = {
        State.REQUEST: {Act.REQUEST: State.REPLY, Act.END: State.CLOSED},
        State.REPLY: {Act.REPLY: State.REQUEST, Act.END: State.CLOSED},
        State.CLOSED: {},
    }
    PAUSED: ClassVar[frozenset[State]] = frozenset({State.REPLY, State.CLOSED})
    TIMED: ClassVar[frozenset[State]] = frozenset({State.REQUEST})


def example() -> Example:
    return Example(State.REQUEST, timeout_ns=100, now_ns=1000)


def test_moves_by_the_table_only() -> None:
    connection = example()
    connection._move(Act.REQUEST)
    assert connection.state is State.REPLY
    with pytest.raises(LocalProtocolError, match="Example: REQUEST in state REPLY"):
        connection._move(Act.REQUEST)
    assert connection.state is State.REPLY


def test_deadline_only_in_timed_states() -> None:
    connection = example()
    assert connection.deadline_ns == 1100
    assert connection.handle_timer(1099) is None
    connection._move(Act.REQUEST)
    assert connection.deadline_ns is None
    assert connection.handle_timer(10**9) is None
    connection._move(Act.REPLY)
    assert connection.handle_timer(1100) == Failed("silent for 100 ns")
    assert connection.state is State.CLOSED


def test_paused_states_want_no_data() -> None:
    connection = example()
    assert connection.wants_data
    connection._move(Act.REQUEST)
    assert not connection.wants_data


def test_bytes_are_given_once() -> None:
    connection = example()
    connection._outbox += [b"a", b"b"]
    assert connection.data_to_send() == [b"a", b"b"]
    assert connection.data_to_send() == []


def test_close_twice() -> None:
    connection = example()
    connection.close()
    connection.close()
    assert connection.state is State.CLOSED
