from __future__ import annotations

from plcsim.network.options import SocketOptions
from plcsim.network.protocol import Option, Outcome


def test_buffers_begin_as_given() -> None:
    options = SocketOptions(100, 200)
    assert options[Option.SEND_BUFFER] == 100
    assert options[Option.RECEIVE_BUFFER] == 200


def test_a_wrong_value_leaves_the_old_one() -> None:
    options = SocketOptions(100, 200)
    assert options.set(Option.KEEP_COUNT, 5) is Outcome.OK
    assert options.set(Option.KEEP_COUNT, 0) is Outcome.INVALID
    assert options[Option.KEEP_COUNT] == 5


def test_a_wrong_linger_leaves_the_old_one() -> None:
    options = SocketOptions(100, 200)
    assert options.set_linger(0) is Outcome.OK
    assert options.set_linger(-1) is Outcome.INVALID
    assert options.linger == 0


def test_inherited_values_are_copies() -> None:
    parent, child = SocketOptions(100, 200), SocketOptions(1, 1)
    parent.set(Option.KEEPALIVE, 1)
    parent.set_linger(3)
    child.inherit(parent)
    parent.set(Option.KEEPALIVE, 0)
    assert child[Option.KEEPALIVE] == 1
    assert child[Option.SEND_BUFFER] == 100
    assert child.linger == 3
