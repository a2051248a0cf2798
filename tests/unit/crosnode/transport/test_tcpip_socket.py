"""The socket of the thesis on the virtual network: its states, and bytes both ways."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from crosnode.transport.dyn_buffer import DynBuffer, DynString
from crosnode.transport.tcpip_socket import (
    AREA_SIZE,
    LARGE_PIECE,
    SocketPool,
    TcpipSocket,
    TcpipSocketState,
)
from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.library.astcp import tcpERR_ALREADY_EXIST, tcpERR_INVALID
from plcsim.library.astcp.idents import IdentTable
from plcsim.library.astcp.settings import AsTcpSettings
from plcsim.network import VirtualNetwork

FAILED, IN_PROGRESS, DISCONNECTED, DONE, UNKNOWN = TcpipSocketState
IP = "192.168.0.10"
PORT = 4000


class Pair:
    """A listening socket, and a connected pair on demand."""

    def __init__(self, idents: int = 128, seed: int = 0) -> None:
        net = VirtualNetwork(lambda: 0, seed=seed)
        settings = [AsTcpSettings(idents=idents)]
        self.net = net
        self.context = Context(Memory(), net.host(IP), settings)
        self.pool = self.context.library(SocketPool)
        self.listener = self.pool.get()
        self.listener.init("", PORT)
        assert self.listener.open(listening=True) is DONE
        self.server, self.client = self.pool.get(), self.pool.get()
        self.accept()

    def accept(self) -> TcpipSocketState:
        return self.listener.accept(self.server, 5)

    def connect(self) -> "Pair":
        self.client.init(IP, PORT)
        for _ in range(20):
            if self.client.connect() is DONE:
                break
        assert self.client.is_connected
        while self.accept() is not DONE:
            pass
        return self


def read(socket: TcpipSocket, size: int) -> bytes:
    buffer = DynBuffer()
    for _ in range(10_000):
        if buffer.size >= size:
            break
        assert socket.read_buffer(buffer) in (DONE, IN_PROGRESS)
    return bytes(buffer.take())


def test_the_values_of_the_states_are_those_of_appendix_a() -> None:
    assert [state.value for state in TcpipSocketState] == [0, 1, 2, 3, 4]


def test_a_socket_is_open_then_connected_then_closed() -> None:
    pair = Pair()
    client = pair.client
    assert not client.is_open
    pair.connect()
    assert client.is_open
    assert client.is_connected
    assert pair.server.ip == IP
    assert pair.server.port == client.own_port > 0
    assert pair.listener.own_port == PORT
    client.close()
    assert not client.is_open
    assert not client.is_connected
    assert client.own_port == 0


def test_nobody_there_is_in_progress() -> None:
    pair = Pair()
    assert pair.accept() is IN_PROGRESS
    pair.connect()
    assert pair.server.read_buffer(DynBuffer()) is IN_PROGRESS


def test_refused_is_failed_and_the_status_says_why() -> None:
    pair = Pair()
    pair.client.init(IP, PORT + 1)
    while (state := pair.client.connect()) is IN_PROGRESS:
        pass
    assert state is FAILED
    assert pair.client.status == tcpERR_INVALID


def test_a_port_in_use_is_failed() -> None:
    pair = Pair()
    other = pair.pool.get()
    other.init("", PORT)
    assert other.open(listening=True) is FAILED
    assert other.status == tcpERR_ALREADY_EXIST


def test_without_a_free_ident_opening_is_in_progress() -> None:
    pair = Pair(idents=1)
    pair.client.init(IP, PORT)
    assert pair.client.connect() is IN_PROGRESS
    assert not pair.client.is_open


def test_the_end_of_the_peer_is_disconnected() -> None:
    pair = Pair().connect()
    pair.client.close()
    buffer = DynBuffer()
    while (state := pair.server.read_buffer(buffer)) is IN_PROGRESS:
        pass
    assert state is DISCONNECTED
    assert not pair.server.is_connected


def test_reading_takes_no_more_than_asked_or_fits() -> None:
    pair = Pair().connect()
    outgoing = DynBuffer()
    outgoing.push_back(b"0123456789")
    assert pair.client.write_buffer(outgoing) is DONE
    buffer = DynBuffer(6)
    while (answer := pair.server.read_buffer_ex(buffer, 4)).state is IN_PROGRESS:
        pass
    assert answer == (DONE, 4)
    assert pair.server.read_buffer_ex(buffer, 100) == (DONE, 2)
    assert pair.server.read_buffer_ex(buffer, 100) == (IN_PROGRESS, 0)
    assert bytes(buffer.take()) == b"012345"


def test_a_full_send_buffer_leaves_the_rest_in_the_buffer() -> None:
    pair = Pair().connect()
    data = bytes(range(256)) * 1024
    outgoing = DynBuffer()
    outgoing.push_back(data)
    state, written = pair.client.write_buffer_ex(outgoing, len(data))
    assert state is IN_PROGRESS
    assert 0 < written < len(data)
    assert outgoing.size == len(data) - written


def test_strings_go_both_ways() -> None:
    pair = Pair().connect()
    question = DynString()
    question.push_back_str("grüß dich")
    assert pair.client.write_string(question) is DONE
    answer = DynString()
    while pair.server.read_string(answer) is IN_PROGRESS:
        pass
    assert str(answer) == "grüß dich"


def test_another_address_closes_the_connection() -> None:
    pair = Pair().connect()
    client = pair.client
    client.check_address_and_change_if_necessary(IP, PORT)
    assert client.is_connected
    client.check_address_and_change_if_necessary(IP, PORT + 1)
    assert not client.is_open
    assert (client.ip, client.port) == (IP, PORT + 1)


def test_a_closed_socket_answers_failed() -> None:
    pair = Pair()
    outgoing = DynBuffer()
    outgoing.push_back(b"x")
    assert pair.client.read_buffer(DynBuffer()) is FAILED
    assert pair.client.write_buffer(outgoing) is FAILED


def test_sockets_are_used_again_so_that_plc_memory_does_not_grow() -> None:
    pair = Pair()
    used = pair.context.memory.used
    for _ in range(200):
        pair.connect()
        pair.pool.put(pair.client)
        pair.pool.put(pair.server)
        pair.client, pair.server = pair.pool.get(), pair.pool.get()
    assert pair.context.memory.used == used
    assert len(pair.context.library(IdentTable).in_use()) == 1


@settings(max_examples=25, deadline=None)
@given(
    st.lists(st.binary(min_size=1, max_size=5000), min_size=1, max_size=5),
    st.integers(0, 1000),
    st.booleans(),
)
def test_any_data_arrives_whole_even_in_short_sends(
    pieces: list[bytes], seed: int, short: bool
) -> None:
    pair = Pair(seed=seed).connect()
    if short:
        pair.net.faults.short_sends(IP, largest=700)
    outgoing = DynBuffer()
    for piece in pieces:
        outgoing.push_back(piece)
    data = b"".join(pieces)
    received = DynBuffer()
    while received.size < len(data):
        pair.client.write_buffer_ex(outgoing, AREA_SIZE)
        pair.server.read_buffer(received)
    assert bytes(received.take()) == data


@pytest.mark.parametrize("status", [9999, 35688])
def test_a_status_that_no_block_should_give_is_unknown(status: int) -> None:
    pair = Pair().connect()
    assert pair.server._ended(status) is UNKNOWN


def test_a_large_piece_goes_to_its_place_without_a_stop() -> None:
    pair = Pair().connect()
    data = bytes(range(256)) * 1024
    outgoing = DynBuffer()
    outgoing.push_back(b"size")
    outgoing.push_back(data)
    place = bytearray(4 + len(data))
    have = 0
    while have < len(place):
        pair.client.write_buffer_ex(outgoing, outgoing.size)
        state, size = pair.server.read_into(memoryview(place)[have:])
        assert state in (DONE, IN_PROGRESS)
        have += size
    assert place == b"size" + data
    pair.client.close()
    while (answer := pair.server.read_into(memoryview(place))).state is IN_PROGRESS:
        pass
    assert answer == (DISCONNECTED, 0)


def test_a_closed_socket_fails_for_large_pieces_too() -> None:
    pair = Pair()
    outgoing = DynBuffer()
    outgoing.push_back(bytes(LARGE_PIECE))
    assert pair.client.read_into(memoryview(bytearray(10))) == (FAILED, 0)
    assert pair.client.write_buffer(outgoing) is FAILED
