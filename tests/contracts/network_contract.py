"""What every ``Network`` must do, whatever carries its bytes."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, TypeVar

import pytest

from plcsim.network import Address, Option, Outcome, Socket

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from plcsim.network import Network

    from .network_rigs import Rig

T = TypeVar("T")
PATIENCE = 5_000


class Talk:
    """A server's and a client's network, and shortcuts for their sockets."""

    def __init__(self, rig: Rig) -> None:
        self.server = rig.server
        self.client = rig.client
        self.server_ip = rig.server_ip
        self.wait = rig.wait
        self._opened: list[Socket] = []

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
    """The suite; a subclass says what carries the bytes."""

    rig_class: type[Rig]

    @pytest.fixture
    def talk(self) -> Iterator[Talk]:
        talk = Talk(self.rig_class())
        yield talk
        talk.close()

    # opening

    def test_port_zero_gives_a_free_port(self, talk: Talk) -> None:
        one, two = talk.open(talk.server), talk.open(talk.server)
        assert 0 < one.local.port != two.local.port > 0
        assert one.local.ip == "0.0.0.0"

    def test_a_port_is_taken_until_it_is_closed(self, talk: Talk) -> None:
        one = talk.open(talk.server)
        port = one.local.port
        assert talk.server.open("", port).outcome is Outcome.IN_USE
        one.close()
        assert talk.open(talk.server, port=port).local.port == port

    def test_a_listening_port_is_taken_even_with_reuse(self, talk: Talk) -> None:
        port = talk.listen(reuse=True).local.port
        assert talk.server.open("", port, reuse_address=True).outcome is Outcome.IN_USE

    def test_two_bound_with_reuse_cannot_both_listen(self, talk: Talk) -> None:
        one = talk.open(talk.server, reuse=True)
        two = talk.open(talk.server, port=one.local.port, reuse=True)
        assert one.listen(1) is Outcome.OK
        assert two.listen(1) is Outcome.IN_USE

    @pytest.mark.parametrize(
        "name",
        ["localhost", "::1%lo", "256.1.1.1", " 1.1.1.1", "<broadcast>", "1.1.1.\u0661"],
    )
    def test_only_literals_are_addresses(self, talk: Talk, name: str) -> None:
        assert talk.server.open(name, 0).outcome is Outcome.INVALID_ADDRESS
        assert talk.open(talk.client).connect(Address(name, 80)) is Outcome.INVALID_ADDRESS

    def test_a_foreign_address_cannot_be_bound(self, talk: Talk) -> None:
        assert talk.server.open("203.0.113.7", 0).outcome is Outcome.NOT_LOCAL

    @pytest.mark.parametrize("port", [-1, 65_536])
    def test_a_port_out_of_range_is_invalid(self, talk: Talk, port: int) -> None:
        assert talk.server.open("", port).outcome is Outcome.INVALID
        target = Address(talk.server_ip, port)
        assert talk.open(talk.client).connect(target) is Outcome.INVALID_ADDRESS

    # connecting

    def test_connecting_ends_with_ok_once(self, talk: Talk) -> None:
        listener = talk.listen()
        client, server = talk.connect(listener)
        assert client.connect(talk.address(listener)) is Outcome.ALREADY_CONNECTED
        assert client.peer == talk.address(listener)
        assert server.peer == client.local
        assert server.local == talk.address(listener)

    def test_nobody_listens(self, talk: Talk) -> None:
        bound = talk.open(talk.server)
        client = talk.open(talk.client)
        target = Address(talk.server_ip, bound.local.port)
        assert talk.settle(lambda: client.connect(target)) is Outcome.REFUSED
        assert client.peer is None

    def test_a_socket_does_not_connect_to_itself(self, talk: Talk) -> None:
        lonely = talk.open(talk.client, "127.0.0.1")
        assert talk.settle(lambda: lonely.connect(lonely.local)) is Outcome.REFUSED

    def test_accept_without_a_client_would_block(self, talk: Talk) -> None:
        assert talk.listen().accept().outcome is Outcome.WOULD_BLOCK

    def test_accept_needs_listen(self, talk: Talk) -> None:
        assert talk.open(talk.server).accept().outcome is Outcome.INVALID

    def test_a_listening_socket_takes_no_other_part(self, talk: Talk) -> None:
        listener = talk.listen()
        assert listener.listening
        assert listener.connect(talk.address(talk.listen())) is Outcome.INVALID
        assert listener.send(b"x").outcome is Outcome.NOT_CONNECTED
        assert listener.recv(1).outcome is Outcome.NOT_CONNECTED
        assert listener.listen(0) is Outcome.OK

    def test_a_connected_socket_cannot_listen(self, talk: Talk) -> None:
        client, server = talk.pair()
        assert client.listen(1) is Outcome.INVALID
        assert server.listen(1) is Outcome.INVALID

    def test_one_listening_socket_serves_many(self, talk: Talk) -> None:
        listener = talk.listen(10)
        pairs = [talk.connect(listener) for _ in range(8)]
        for number, (client, _) in enumerate(pairs):
            client.send(bytes([number]))
        assert [talk.read(server, 1)[0] for _, server in pairs] == list(range(8))

    def test_a_backlog_of_zero_lets_one_in(self, talk: Talk) -> None:
        talk.connect(talk.listen(0))

    # bytes

    def test_unconnected_sockets_carry_nothing(self, talk: Talk) -> None:
        idle = talk.open(talk.client)
        assert idle.send(b"x").outcome is Outcome.NOT_CONNECTED
        assert idle.recv(1).outcome is Outcome.NOT_CONNECTED
        assert idle.shutdown(write=True) is Outcome.NOT_CONNECTED

    def test_bytes_arrive_both_ways(self, talk: Talk) -> None:
        client, server = talk.pair()
        assert client.send(b"ping") == (Outcome.OK, 4)
        assert talk.read(server, 4) == b"ping"
        assert server.send(memoryview(b"pong")) == (Outcome.OK, 4)
        assert talk.read(client, 4) == b"pong"
        assert client.recv(1).outcome is Outcome.WOULD_BLOCK

    def test_recv_gives_no_more_than_asked(self, talk: Talk) -> None:
        client, server = talk.pair()
        client.send(b"abc")
        assert talk.read(server, 1) == b"a"
        assert talk.read(server, 2) == b"bc"
        assert server.recv(0).outcome is Outcome.INVALID
        assert server.recv(4_294_967_295).outcome is Outcome.WOULD_BLOCK

    def test_peek_leaves_the_bytes(self, talk: Talk) -> None:
        client, server = talk.pair()
        client.send(b"ab")
        peeked = talk.eventually(lambda: server.recv(2, peek=True), lambda a: a.data == b"ab")
        assert peeked.outcome is Outcome.OK
        assert server.recv(2, peek=True).data == b"ab"
        assert server.recv(2).data == b"ab"
        assert server.recv(2, peek=True).outcome is Outcome.WOULD_BLOCK

    def test_sending_nothing_is_ok(self, talk: Talk) -> None:
        client, _ = talk.pair()
        assert client.send(b"") == (Outcome.OK, 0)

    def test_a_full_buffer_takes_a_part_then_nothing(self, talk: Talk) -> None:
        client, server = talk.pair()
        flood = bytes(range(256)) * 65_536
        sent = 0
        for _ in range(PATIENCE):
            outcome, taken = client.send(flood[sent:])
            if outcome is Outcome.WOULD_BLOCK:
                break
            sent += taken
        assert outcome is Outcome.WOULD_BLOCK
        assert 0 < sent < len(flood)
        assert talk.read(server, sent) == flood[:sent]
        talk.eventually(lambda: client.send(b"x"), lambda a: a.outcome is Outcome.OK)

    def test_urgent_byte(self, talk: Talk) -> None:
        client, server = talk.pair()
        assert server.recv(1, urgent=True).outcome is Outcome.NO_URGENT_DATA
        assert client.send(b"ab!", urgent=True).outcome is Outcome.OK
        urgent = talk.eventually(
            lambda: server.recv(1, urgent=True), lambda a: a.outcome is Outcome.OK
        )
        assert urgent.data == b"!"
        assert talk.read(server, 2) == b"ab"
        assert server.recv(1, urgent=True).outcome is Outcome.NO_URGENT_DATA

    def test_urgent_byte_inline(self, talk: Talk) -> None:
        client, server = talk.pair()
        assert server.set_option(Option.URGENT_INLINE, 1) is Outcome.OK
        client.send(b"ab!", urgent=True)
        assert talk.read(server, 3) == b"ab!"
        assert server.recv(1, urgent=True).outcome is Outcome.NO_URGENT_DATA

    # ending

    def test_an_orderly_end_comes_after_the_bytes(self, talk: Talk) -> None:
        client, server = talk.pair()
        client.send(b"bye")
        client.close()
        assert talk.read(server, 3) == b"bye"
        assert talk.end_of(server) is Outcome.CLOSED
        assert server.recv(1).outcome is Outcome.CLOSED

    def test_half_close_leaves_the_other_direction(self, talk: Talk) -> None:
        client, server = talk.pair()
        assert client.shutdown(write=True) is Outcome.OK
        assert client.send(b"x").outcome is Outcome.NOT_CONNECTED
        assert talk.end_of(server) is Outcome.CLOSED
        server.send(b"late")
        assert talk.read(client, 4) == b"late"
        server.close()
        assert talk.end_of(client) is Outcome.CLOSED

    def test_no_more_reading_after_shutdown(self, talk: Talk) -> None:
        client, _ = talk.pair()
        assert client.shutdown(read=True) is Outcome.OK
        assert client.recv(1).outcome is Outcome.CLOSED

    def test_linger_zero_resets(self, talk: Talk) -> None:
        client, server = talk.pair()
        assert client.set_linger(0) is Outcome.OK
        client.close()
        assert talk.end_of(server) is Outcome.RESET
        assert server.recv(1).outcome is Outcome.RESET
        assert server.send(b"x").outcome is Outcome.RESET
        assert server.send(b"x").outcome is Outcome.RESET

    def test_bytes_before_a_reset_can_be_read(self, talk: Talk) -> None:
        client, server = talk.pair()
        client.send(b"last")
        talk.eventually(lambda: server.recv(4, peek=True), lambda a: a.data == b"last")
        client.set_linger(0)
        client.close()
        talk.eventually(lambda: server.send(b"x"), lambda a: a.outcome is Outcome.RESET)
        assert server.recv(4) == (Outcome.OK, b"last")
        assert server.recv(4).outcome is Outcome.RESET

    def test_closing_with_unread_bytes_resets(self, talk: Talk) -> None:
        client, server = talk.pair()
        client.send(b"unread")
        talk.eventually(lambda: server.recv(6, peek=True), lambda a: a.data == b"unread")
        server.close()
        assert talk.end_of(client) is Outcome.RESET

    def test_sending_to_a_closed_peer_ends_in_reset(self, talk: Talk) -> None:
        client, server = talk.pair()
        server.close()
        assert talk.end_of(client) is Outcome.CLOSED
        talk.eventually(lambda: client.send(b"x"), lambda a: a.outcome is Outcome.RESET)
        assert client.recv(1).outcome is Outcome.RESET

    def test_a_long_linger_does_not_wait(self, talk: Talk) -> None:
        client, server = talk.pair()
        client.set_linger(30)
        client.send(b"rest")
        client.close()
        assert talk.read(server, 4) == b"rest"
        assert talk.end_of(server) is Outcome.CLOSED

    def test_closing_the_listening_socket_drops_who_waits(self, talk: Talk) -> None:
        listener = talk.listen()
        client = talk.open(talk.client)
        target = talk.address(listener)
        assert talk.settle(lambda: client.connect(target)) is Outcome.OK
        listener.close()
        assert talk.end_of(client) is Outcome.RESET

    def test_accepted_sockets_outlive_the_listening_one(self, talk: Talk) -> None:
        listener = talk.listen()
        client, server = talk.connect(listener)
        listener.close()
        client.send(b"x")
        assert talk.read(server, 1) == b"x"

    def test_a_look_tells_who_has_news(self, talk: Talk) -> None:
        listener = talk.listen()
        assert listener not in talk.server.look()
        client = talk.open(talk.client)
        talk.settle(lambda: client.connect(talk.address(listener)))
        talk.eventually(talk.server.look, lambda news: listener in news)
        peer = talk.keep(listener.accept().socket)
        assert listener not in talk.server.look()
        assert client not in talk.client.look()
        assert peer not in talk.server.look()
        client.send(b"ab")
        talk.eventually(talk.server.look, lambda news: peer in news)
        assert talk.read(peer, 2) == b"ab"
        assert peer not in talk.server.look()
        client.close()
        talk.eventually(talk.server.look, lambda news: peer in news)
        assert peer.recv(1).outcome is Outcome.CLOSED
        assert peer in talk.server.look()
        peer.close()
        listener.close()
        assert not {peer, listener, client} & set(talk.server.look())

    def test_time_wait_keeps_the_port_without_reuse(self, talk: Talk) -> None:
        listener = talk.listen(reuse=True)
        port = listener.local.port
        client, server = talk.connect(listener)
        server.close()
        assert talk.end_of(client) is Outcome.CLOSED
        client.close()
        listener.close()
        for _ in range(5):
            talk.wait()
        assert talk.server.open("", port).outcome is Outcome.IN_USE
        again = talk.open(talk.server, port=port, reuse=True)
        assert again.listen(1) is Outcome.OK

    def test_a_closed_socket_answers_without_harm(self, talk: Talk) -> None:
        closed = talk.open(talk.client)
        closed.close()
        closed.close()
        assert closed.local == ("0.0.0.0", 0)
        assert closed.peer is None
        assert not closed.listening
        assert closed.listen(1) is Outcome.INVALID
        assert closed.accept().outcome is Outcome.INVALID
        assert closed.connect(Address(talk.server_ip, 80)) is Outcome.INVALID
        assert closed.send(b"x").outcome is Outcome.NOT_CONNECTED
        assert closed.recv(1).outcome is Outcome.NOT_CONNECTED
        assert closed.shutdown(read=True) is Outcome.NOT_CONNECTED
        assert closed.set_option(Option.KEEPALIVE, 1) is Outcome.INVALID
        assert closed.option(Option.KEEPALIVE).outcome is Outcome.INVALID
        assert closed.set_linger(1) is Outcome.INVALID
        assert closed.linger() is None

    def test_closing_while_connecting(self, talk: Talk) -> None:
        listener = talk.listen()
        client = talk.open(talk.client)
        client.connect(talk.address(listener))
        client.close()
        assert client.connect(talk.address(listener)) is Outcome.INVALID

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
    def test_options_read_back(self, talk: Talk, option: Option, value: int) -> None:
        fresh = talk.open(talk.client)
        assert fresh.set_option(option, value) is Outcome.OK
        assert fresh.option(option) == (Outcome.OK, value)

    def test_what_only_datagrams_have(self, talk: Talk) -> None:
        fresh = talk.open(talk.client)
        assert fresh.set_option(Option.BROADCAST, 1) is Outcome.INVALID
        assert fresh.option(Option.BROADCAST).outcome is Outcome.INVALID

    @pytest.mark.parametrize("option", [o for o in Option if o is not Option.BROADCAST])
    @pytest.mark.parametrize("value", [0, 4_294_967_295])
    def test_no_value_does_harm(self, talk: Talk, option: Option, value: int) -> None:
        fresh = talk.open(talk.client)
        assert fresh.set_option(option, value) in (Outcome.OK, Outcome.INVALID)
        assert fresh.option(option).outcome is Outcome.OK

    @pytest.mark.parametrize("seconds", [None, 0, 3])
    def test_linger_reads_back(self, talk: Talk, seconds: int | None) -> None:
        fresh = talk.open(talk.client)
        assert fresh.set_linger(seconds) is Outcome.OK
        assert fresh.linger() == seconds

    @pytest.mark.parametrize("seconds", [-1, 4_294_967_295])
    def test_linger_out_of_range(self, talk: Talk, seconds: int) -> None:
        assert talk.open(talk.client).set_linger(seconds) is Outcome.INVALID

    def test_accepted_sockets_inherit_options(self, talk: Talk) -> None:
        listener = talk.listen()
        listener.set_option(Option.KEEPALIVE, 1)
        listener.set_linger(0)
        _, server = talk.connect(listener)
        assert server.option(Option.KEEPALIVE).value == 1
        assert server.linger() == 0
