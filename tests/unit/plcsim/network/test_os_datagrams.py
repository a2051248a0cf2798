"""Datagrams of the host; what both networks do is in the contract."""

import socket

from plcsim.network import Address, OsNetwork, Outcome
from plcsim.network.os_datagrams import MOST_FOREIGN


def test_a_port_that_the_host_does_not_give(monkeypatch):
    def denied(*_):
        raise PermissionError(13, "denied")

    monkeypatch.setattr(socket.socket, "bind", denied)
    assert OsNetwork().open_datagrams("", 99).outcome is Outcome.DENIED


def test_no_descriptors_left(monkeypatch):
    def none_left(*_):
        raise OSError(24, "too many open files")

    monkeypatch.setattr(socket, "socket", none_left)
    assert OsNetwork().open_datagrams("", 0).outcome is Outcome.NO_RESOURCES


def test_foreign_datagrams_never_hold_a_call_up():
    network = OsNetwork()
    server, client, friend = (network.open_datagrams("127.0.0.1", 0).socket for _ in range(3))
    server.connect(friend.local)
    for _ in range(MOST_FOREIGN + 10):
        client.send(b"x", server.local)
    friend.send(b"mine", server.local)
    found = [server.recv(10) for _ in range(2)]
    assert [each.outcome for each in found] == [Outcome.WOULD_BLOCK, Outcome.OK]
    assert found[1].data == b"mine"
    for each in (server, client, friend):
        each.close()


def test_no_route(monkeypatch):
    network = OsNetwork()
    made = network.open_datagrams("127.0.0.1", 0).socket
    sent = made.send(b"x", Address("203.0.113.1", 9))
    assert sent.outcome in (Outcome.UNREACHABLE, Outcome.INVALID, Outcome.OK)
    made.close()
