"""Whatever a network answers, a replay answers the same."""

from collections.abc import Callable
from typing import Any

from plcsim.network import Address, Datagram, Network, Option, Outcome, VirtualNetwork
from plcsim.recorder.journal.feed import Feed
from plcsim.recorder.journal.journal import Journal
from plcsim.recorder.journal.network import RecordedNetwork, ReplayNetwork

from .conftest import taken

SERVER, CLIENT = "192.168.0.1", "192.168.0.2"


class Time:
    now_ns = 0

    def __call__(self) -> int:
        return self.now_ns


def talk(server: Network, client: Network, wait: Callable[[], None]) -> list[Any]:
    """Use every call of a network; return the answers, without the sockets."""
    listener = server.open(SERVER, 5000).socket
    taken = server.open(SERVER, 5000).outcome
    caller = client.open(CLIENT, 0).socket
    assert listener is not None
    assert caller is not None
    told: list[Any] = [taken, listener.listen(3), listener.listening, listener.accept().outcome]
    told.append(caller.connect(Address(SERVER, 5000)))
    for _ in range(5):
        wait()
        told.append(caller.connect(Address(SERVER, 5000)))
    accepted = listener.accept()
    told += [accepted.outcome, accepted.peer, caller.local, caller.peer, listener.peer]
    peer = accepted.socket
    assert peer is not None
    told += [caller.send(b"hello"), peer.recv(100), server.look() == []]
    wait()
    told += [server.look() == [peer], client.look() == []]
    told += [peer.recv(3, peek=True), peer.recv(100), peer.recv(100)]
    told += [caller.set_option(Option.NO_DELAY, 1), caller.option(Option.NO_DELAY)]
    told += [caller.set_linger(3), caller.linger(), caller.set_linger(None), caller.linger()]
    told += [caller.shutdown(write=True)]
    wait()
    told.append(peer.recv(100))
    for each in (caller, peer, listener):
        each.close()
    told += [caller.local, caller.send(b"x"), caller.option(Option.NO_DELAY)]
    return told


def test_a_replay_answers_what_was_recorded() -> None:
    time = Time()
    net = VirtualNetwork(time)
    journal = Journal()

    def wait() -> None:
        time.now_ns += 1_000_000

    hosts = [RecordedNetwork(net.host(ip), journal) for ip in (SERVER, CLIENT)]
    recorded = talk(*hosts, wait)
    feed = Feed([taken(journal)])

    repeated = talk(ReplayNetwork(feed), ReplayNetwork(feed), lambda: None)

    assert repeated == recorded
    assert feed.left == ""
    assert Outcome.OK in recorded
    assert Outcome.WOULD_BLOCK in recorded


def send(server: Any, client: Any, wait: Callable[[], None]) -> list[Any]:
    """Use every call of UDP; return the answers, without the sockets."""
    outcome, here = server.open_datagrams(SERVER, 5000)
    told: list[Any] = [outcome, server.open_datagrams(SERVER, 5000).outcome, here.local, here.peer]
    there = client.open_datagrams(CLIENT, 0).socket
    told += [there.local, there.send(b"lost"), there.connect(Address(SERVER, 5000)), there.peer]
    told += [there.send(b"hello"), there.send(b"again", Address(SERVER, 5000)), here.recv(10)]
    wait()
    told += [here.recv(3, peek=True), here.recv(10), here.recv(10), here.recv(10)]
    told += [here.set_option(Option.BROADCAST, 1), here.option(Option.BROADCAST)]
    told += [there.disconnect(), there.peer]
    for each in (here, there):
        each.close()
    return [*told, here.local, here.recv(10)]


def test_a_replay_answers_the_datagrams_that_were_recorded() -> None:
    time = Time()
    net = VirtualNetwork(time)
    journal = Journal()

    def wait() -> None:
        time.now_ns += 1_000_000

    recorded = send(*(RecordedNetwork(net.host(ip), journal) for ip in (SERVER, CLIENT)), wait)
    feed = Feed([taken(journal)])
    repeated = send(ReplayNetwork(feed), ReplayNetwork(feed), lambda: None)

    assert repeated == recorded
    assert feed.left == ""
    came = {each.data for each in recorded if isinstance(each, Datagram)}
    assert came >= {b"hello", b"again", b""}
