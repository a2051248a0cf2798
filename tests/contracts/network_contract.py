"""What every ``Network`` must do, whatever carries its bytes.

A rig gives two networks (of the server's and of the client's host) and lets time pass.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import partial
from typing import TYPE_CHECKING, TypeVar

import pytest

from plcsim.network import Address, Network, Option, Outcome, Socket

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

T = TypeVar("T")
PATIENCE = 5_000


class Rig(ABC):
    """A server's and a client's network, and the time between calls."""

    server: Network
    client: Network
    server_ip: str

    def __init__(self) -> None:
        self._opened: list[Socket] = []

    @abstractmethod
    def wait(self) -> None:
        """Let a little time pass."""

    def eventually(self, call: Callable[[], T], done: Callable[[T], bool]) -> T:
        """Repeat ``call`` until ``done`` likes its answer."""
        for _ in range(PATIENCE):
            answer = call()
            if done(answer):
                return answer
            self.wait()
        pytest.fail(f"still {answer} after {PATIENCE} calls")

    def keep(self, made: Socket | None) -> Socket:
        """Take a socket that must be there; it is closed at the end of the test."""
        assert made is not None
        self._opened.append(made)
        return made

    def open(self, net: Network, ip: str = "", port: int = 0, *, reuse: bool = False) -> Socket:
        outcome, made = net.open(ip, port, reuse_address=reuse)
        assert outcome is Outcome.OK
        return self.keep(made)

    def listen(self, backlog: int = 3, *, reuse: bool = False) -> Socket:
        listener = self.open(self.server, reuse=reuse)
        assert listener.listen(backlog) is Outcome.OK
        return listener

    def address(self, listener: Socket) -> Address:
        return Address(self.server_ip, listener.local.port)

    def connect(self, listener: Socket) -> tuple[Socket, Socket]:
        """Connect; return the client's and the server's socket."""
        client = self.open(self.client)
        target = self.address(listener)
        assert self.settle(lambda: client.connect(target)) is Outcome.OK
        answer = self.eventually(listener.accept, lambda a: a.outcome is not Outcome.WOULD_BLOCK)
        assert answer.outcome is Outcome.OK
        assert answer.peer == client.local
        return client, self.keep(answer.socket)

    def pair(self) -> tuple[Socket, Socket]:
        return self.connect(self.listen())

    def settle(self, call: Callable[[], Outcome]) -> Outcome:
        """Repeat ``call`` until it no longer blocks."""
        return self.eventually(call, lambda outcome: outcome is not Outcome.WOULD_BLOCK)

    def end_of(self, reader: Socket) -> Outcome:
        """Read until there is an end; return which."""
        answer = self.eventually(
            lambda: reader.recv(4096),
            lambda a: a.outcome not in (Outcome.OK, Outcome.WOULD_BLOCK),
        )
        return answer.outcome

    def read(self, reader: Socket, size: int) -> bytes:
        """Read exactly ``size`` bytes."""
        data = b""
        while len(data) < size:
            rest = size - len(data)
            answer = self.eventually(
                partial(reader.recv, rest), lambda a: a.outcome is not Outcome.WOULD_BLOCK
            )
            assert answer.outcome is Outcome.OK
            data += answer.data
        return data

    def close(self) -> None:
        for made in self._opened:
            made.close()


class NetworkContract:
    """The suite; a subclass gives ``make_rig``."""

    def make_rig(self) -> Rig:
        raise NotImplementedError

    @pytest.fixture
    def rig(self) -> Iterator[Rig]:
        rig = self.make_rig()
        yield rig
        rig.close()

    # opening

    def test_port_zero_gives_a_free_port(self, rig: Rig) -> None:
        one, two = rig.open(rig.server), rig.open(rig.server)
        assert 0 < one.local.port != two.local.port > 0
        assert one.local.ip == "0.0.0.0"

    def test_a_port_is_taken_until_it_is_closed(self, rig: Rig) -> None:
        one = rig.open(rig.server)
        port = one.local.port
        assert rig.server.open("", port).outcome is Outcome.IN_USE
        one.close()
        assert rig.open(rig.server, port=port).local.port == port

    def test_a_listening_port_is_taken_even_with_reuse(self, rig: Rig) -> None:
        port = rig.listen(reuse=True).local.port
        assert rig.server.open("", port, reuse_address=True).outcome is Outcome.IN_USE

    def test_two_bound_with_reuse_cannot_both_listen(self, rig: Rig) -> None:
        one = rig.open(rig.server, reuse=True)
        two = rig.open(rig.server, port=one.local.port, reuse=True)
        assert one.listen(1) is Outcome.OK
        assert two.listen(1) is Outcome.IN_USE

    @pytest.mark.parametrize(
        "name",
        ["localhost", "::1", "256.1.1.1", " 1.1.1.1", "<broadcast>", "1.1.1.\u0661"],
    )
    def test_only_ipv4_literals_are_addresses(self, rig: Rig, name: str) -> None:
        assert rig.server.open(name, 0).outcome is Outcome.INVALID_ADDRESS
        assert rig.open(rig.client).connect(Address(name, 80)) is Outcome.INVALID_ADDRESS

    def test_a_foreign_address_cannot_be_bound(self, rig: Rig) -> None:
        assert rig.server.open("203.0.113.7", 0).outcome is Outcome.NOT_LOCAL

    @pytest.mark.parametrize("port", [-1, 65_536])
    def test_a_port_out_of_range_is_invalid(self, rig: Rig, port: int) -> None:
        assert rig.server.open("", port).outcome is Outcome.INVALID
        target = Address(rig.server_ip, port)
        assert rig.open(rig.client).connect(target) is Outcome.INVALID_ADDRESS

    # connecting

    def test_connecting_ends_with_ok_once(self, rig: Rig) -> None:
        listener = rig.listen()
        client, server = rig.connect(listener)
        assert client.connect(rig.address(listener)) is Outcome.ALREADY_CONNECTED
        assert client.peer == rig.address(listener)
        assert server.peer == client.local
        assert server.local == rig.address(listener)

    def test_nobody_listens(self, rig: Rig) -> None:
        bound = rig.open(rig.server)
        client = rig.open(rig.client)
        target = Address(rig.server_ip, bound.local.port)
        assert rig.settle(lambda: client.connect(target)) is Outcome.REFUSED
        assert client.peer is None

    def test_a_socket_does_not_connect_to_itself(self, rig: Rig) -> None:
        lonely = rig.open(rig.client, "127.0.0.1")
        assert rig.settle(lambda: lonely.connect(lonely.local)) is Outcome.REFUSED

    def test_accept_without_a_client_would_block(self, rig: Rig) -> None:
        assert rig.listen().accept().outcome is Outcome.WOULD_BLOCK

    def test_accept_needs_listen(self, rig: Rig) -> None:
        assert rig.open(rig.server).accept().outcome is Outcome.INVALID

    def test_a_listening_socket_takes_no_other_part(self, rig: Rig) -> None:
        listener = rig.listen()
        assert listener.listening
        assert listener.connect(rig.address(rig.listen())) is Outcome.INVALID
        assert listener.send(b"x").outcome is Outcome.NOT_CONNECTED
        assert listener.recv(1).outcome is Outcome.NOT_CONNECTED
        assert listener.listen(0) is Outcome.OK

    def test_a_connected_socket_cannot_listen(self, rig: Rig) -> None:
        client, server = rig.pair()
        assert client.listen(1) is Outcome.INVALID
        assert server.listen(1) is Outcome.INVALID

    def test_one_listening_socket_serves_many(self, rig: Rig) -> None:
        listener = rig.listen(10)
        pairs = [rig.connect(listener) for _ in range(8)]
        for number, (client, _) in enumerate(pairs):
            client.send(bytes([number]))
        assert [rig.read(server, 1)[0] for _, server in pairs] == list(range(8))

    def test_a_backlog_of_zero_lets_one_in(self, rig: Rig) -> None:
        rig.connect(rig.listen(0))

    # bytes

    def test_unconnected_sockets_carry_nothing(self, rig: Rig) -> None:
        idle = rig.open(rig.client)
        assert idle.send(b"x").outcome is Outcome.NOT_CONNECTED
        assert idle.recv(1).outcome is Outcome.NOT_CONNECTED
        assert idle.shutdown(write=True) is Outcome.NOT_CONNECTED

    def test_bytes_arrive_both_ways(self, rig: Rig) -> None:
        client, server = rig.pair()
        assert client.send(b"ping") == (Outcome.OK, 4)
        assert rig.read(server, 4) == b"ping"
        assert server.send(memoryview(b"pong")) == (Outcome.OK, 4)
        assert rig.read(client, 4) == b"pong"
        assert client.recv(1).outcome is Outcome.WOULD_BLOCK

    def test_recv_gives_no_more_than_asked(self, rig: Rig) -> None:
        client, server = rig.pair()
        client.send(b"abc")
        assert rig.read(server, 1) == b"a"
        assert rig.read(server, 2) == b"bc"
        assert server.recv(0).outcome is Outcome.INVALID
        assert server.recv(4_294_967_295).outcome is Outcome.WOULD_BLOCK

    def test_peek_leaves_the_bytes(self, rig: Rig) -> None:
        client, server = rig.pair()
        client.send(b"ab")
        peeked = rig.eventually(lambda: server.recv(2, peek=True), lambda a: a.data == b"ab")
        assert peeked.outcome is Outcome.OK
        assert server.recv(2, peek=True).data == b"ab"
        assert server.recv(2).data == b"ab"
        assert server.recv(2, peek=True).outcome is Outcome.WOULD_BLOCK

    def test_sending_nothing_is_ok(self, rig: Rig) -> None:
        client, _ = rig.pair()
        assert client.send(b"") == (Outcome.OK, 0)

    def test_a_full_buffer_takes_a_part_then_nothing(self, rig: Rig) -> None:
        client, server = rig.pair()
        flood = bytes(range(256)) * 65_536
        sent = 0
        for _ in range(PATIENCE):
            outcome, taken = client.send(flood[sent:])
            if outcome is Outcome.WOULD_BLOCK:
                break
            sent += taken
        assert outcome is Outcome.WOULD_BLOCK
        assert 0 < sent < len(flood)
        assert rig.read(server, sent) == flood[:sent]
        rig.eventually(lambda: client.send(b"x"), lambda a: a.outcome is Outcome.OK)

    def test_urgent_byte(self, rig: Rig) -> None:
        client, server = rig.pair()
        assert server.recv(1, urgent=True).outcome is Outcome.NO_URGENT_DATA
        assert client.send(b"ab!", urgent=True).outcome is Outcome.OK
        urgent = rig.eventually(
            lambda: server.recv(1, urgent=True), lambda a: a.outcome is Outcome.OK
        )
        assert urgent.data == b"!"
        assert rig.read(server, 2) == b"ab"
        assert server.recv(1, urgent=True).outcome is Outcome.NO_URGENT_DATA

    def test_urgent_byte_inline(self, rig: Rig) -> None:
        client, server = rig.pair()
        assert server.set_option(Option.URGENT_INLINE, 1) is Outcome.OK
        client.send(b"ab!", urgent=True)
        assert rig.read(server, 3) == b"ab!"
        assert server.recv(1, urgent=True).outcome is Outcome.NO_URGENT_DATA

    # ending

    def test_an_orderly_end_comes_after_the_bytes(self, rig: Rig) -> None:
        client, server = rig.pair()
        client.send(b"bye")
        client.close()
        assert rig.read(server, 3) == b"bye"
        assert rig.end_of(server) is Outcome.CLOSED
        assert server.recv(1).outcome is Outcome.CLOSED

    def test_half_close_leaves_the_other_direction(self, rig: Rig) -> None:
        client, server = rig.pair()
        assert client.shutdown(write=True) is Outcome.OK
        assert client.send(b"x").outcome is Outcome.NOT_CONNECTED
        assert rig.end_of(server) is Outcome.CLOSED
        server.send(b"late")
        assert rig.read(client, 4) == b"late"
        server.close()
        assert rig.end_of(client) is Outcome.CLOSED

    def test_no_more_reading_after_shutdown(self, rig: Rig) -> None:
        client, _ = rig.pair()
        assert client.shutdown(read=True) is Outcome.OK
        assert client.recv(1).outcome is Outcome.CLOSED

    def test_linger_zero_resets(self, rig: Rig) -> None:
        client, server = rig.pair()
        assert client.set_linger(0) is Outcome.OK
        client.close()
        assert rig.end_of(server) is Outcome.RESET
        assert server.recv(1).outcome is Outcome.RESET
        assert server.send(b"x").outcome is Outcome.RESET
        assert server.send(b"x").outcome is Outcome.RESET

    def test_bytes_before_a_reset_can_be_read(self, rig: Rig) -> None:
        client, server = rig.pair()
        client.send(b"last")
        rig.eventually(lambda: server.recv(4, peek=True), lambda a: a.data == b"last")
        client.set_linger(0)
        client.close()
        rig.eventually(lambda: server.send(b"x"), lambda a: a.outcome is Outcome.RESET)
        assert server.recv(4) == (Outcome.OK, b"last")
        assert server.recv(4).outcome is Outcome.RESET

    def test_closing_with_unread_bytes_resets(self, rig: Rig) -> None:
        client, server = rig.pair()
        client.send(b"unread")
        rig.eventually(lambda: server.recv(6, peek=True), lambda a: a.data == b"unread")
        server.close()
        assert rig.end_of(client) is Outcome.RESET

    def test_sending_to_a_closed_peer_ends_in_reset(self, rig: Rig) -> None:
        client, server = rig.pair()
        server.close()
        assert rig.end_of(client) is Outcome.CLOSED
        rig.eventually(lambda: client.send(b"x"), lambda a: a.outcome is Outcome.RESET)
        assert client.recv(1).outcome is Outcome.RESET

    def test_a_long_linger_does_not_wait(self, rig: Rig) -> None:
        client, server = rig.pair()
        client.set_linger(30)
        client.send(b"rest")
        client.close()
        assert rig.read(server, 4) == b"rest"
        assert rig.end_of(server) is Outcome.CLOSED

    def test_closing_the_listening_socket_drops_who_waits(self, rig: Rig) -> None:
        listener = rig.listen()
        client = rig.open(rig.client)
        target = rig.address(listener)
        assert rig.settle(lambda: client.connect(target)) is Outcome.OK
        listener.close()
        assert rig.end_of(client) is Outcome.RESET

    def test_accepted_sockets_outlive_the_listening_one(self, rig: Rig) -> None:
        listener = rig.listen()
        client, server = rig.connect(listener)
        listener.close()
        client.send(b"x")
        assert rig.read(server, 1) == b"x"

    def test_time_wait_keeps_the_port_without_reuse(self, rig: Rig) -> None:
        listener = rig.listen(reuse=True)
        port = listener.local.port
        client, server = rig.connect(listener)
        server.close()
        assert rig.end_of(client) is Outcome.CLOSED
        client.close()
        listener.close()
        for _ in range(5):
            rig.wait()
        assert rig.server.open("", port).outcome is Outcome.IN_USE
        again = rig.open(rig.server, port=port, reuse=True)
        assert again.listen(1) is Outcome.OK

    def test_a_closed_socket_answers_without_harm(self, rig: Rig) -> None:
        closed = rig.open(rig.client)
        closed.close()
        closed.close()
        assert closed.local == ("0.0.0.0", 0)
        assert closed.peer is None
        assert not closed.listening
        assert closed.listen(1) is Outcome.INVALID
        assert closed.accept().outcome is Outcome.INVALID
        assert closed.connect(Address(rig.server_ip, 80)) is Outcome.INVALID
        assert closed.send(b"x").outcome is Outcome.NOT_CONNECTED
        assert closed.recv(1).outcome is Outcome.NOT_CONNECTED
        assert closed.shutdown(read=True) is Outcome.NOT_CONNECTED
        assert closed.set_option(Option.KEEPALIVE, 1) is Outcome.INVALID
        assert closed.option(Option.KEEPALIVE).outcome is Outcome.INVALID
        assert closed.set_linger(1) is Outcome.INVALID
        assert closed.linger() is None

    def test_closing_while_connecting(self, rig: Rig) -> None:
        listener = rig.listen()
        client = rig.open(rig.client)
        client.connect(rig.address(listener))
        client.close()
        assert client.connect(rig.address(listener)) is Outcome.INVALID

    # options

    @pytest.mark.parametrize(
        ("option", "value"),
        [
            (Option.KEEPALIVE, 1),
            (Option.URGENT_INLINE, 1),
            (Option.NO_DELAY, 1),
            (Option.SEND_BUFFER, 8192),
            (Option.RECEIVE_BUFFER, 16_384),
            (Option.KEEP_COUNT, 3),
            (Option.KEEP_IDLE, 10),
            (Option.KEEP_INTERVAL, 5),
        ],
    )
    def test_options_read_back(self, rig: Rig, option: Option, value: int) -> None:
        fresh = rig.open(rig.client)
        assert fresh.set_option(option, value) is Outcome.OK
        assert fresh.option(option) == (Outcome.OK, value)

    @pytest.mark.parametrize("option", list(Option))
    @pytest.mark.parametrize("value", [0, 4_294_967_295])
    def test_no_value_does_harm(self, rig: Rig, option: Option, value: int) -> None:
        fresh = rig.open(rig.client)
        assert fresh.set_option(option, value) in (Outcome.OK, Outcome.INVALID)
        assert fresh.option(option).outcome is Outcome.OK

    @pytest.mark.parametrize("seconds", [None, 0, 3])
    def test_linger_reads_back(self, rig: Rig, seconds: int | None) -> None:
        fresh = rig.open(rig.client)
        assert fresh.set_linger(seconds) is Outcome.OK
        assert fresh.linger() == seconds

    @pytest.mark.parametrize("seconds", [-1, 4_294_967_295])
    def test_linger_out_of_range(self, rig: Rig, seconds: int) -> None:
        assert rig.open(rig.client).set_linger(seconds) is Outcome.INVALID

    def test_accepted_sockets_inherit_options(self, rig: Rig) -> None:
        listener = rig.listen()
        listener.set_option(Option.KEEPALIVE, 1)
        listener.set_linger(0)
        _, server = rig.connect(listener)
        assert server.option(Option.KEEPALIVE).value == 1
        assert server.linger() == 0
