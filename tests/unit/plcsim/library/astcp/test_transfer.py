from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plcsim.core.errors import PageFault
from plcsim.library.astcp import (
    ERR_OK,
    TcpRecv,
    TcpSend,
    tcpERR_NO_DATA,
    tcpERR_NO_OOBDATA,
    tcpERR_NOT_CONNECTED,
    tcpERR_PARAMETER,
    tcpERR_SENTLEN,
    tcpERR_SYSTEM,
    tcpERR_WOULDBLOCK,
    tcpMSG_DONTROUTE,
    tcpMSG_OOB,
    tcpMSG_PEEK,
    tcpSO_SNDBUF_SET,
)
from plcsim.network import Link, Outcome, Received, Sent, WireLimits

from .plc import CLIENT, MS, SERVER, WILD, World


def test_no_data_at_once(world: World) -> None:
    client, server = world.pair()
    for plc, ident in ((world.client, client), (world.server, server)):
        recv = plc.recv(ident)
        assert (recv.status, recv.recvlen) == (tcpERR_NO_DATA, 0)


def test_bytes_both_ways(world: World) -> None:
    client, server = world.pair()
    sent = world.client.send(client, b"ping")
    assert (sent.status, sent.sentlen) == (ERR_OK, 4)
    assert world.server.received(world.server.recv(server)) == b"ping"
    world.server.send(server, b"pong", tcpMSG_DONTROUTE)
    assert world.client.received(world.client.recv(client)) == b"pong"


def test_a_stream_has_no_message_boundaries(world: World) -> None:
    client, server = world.pair()
    world.client.send(client, b"abc")
    world.client.send(client, b"def")
    parts = [world.server.received(world.server.recv(server, datamax=4)) for _ in range(2)]
    assert parts == [b"abcd", b"ef"]


def test_received_bytes_stay_inside_the_buffer(world: World) -> None:
    client, server = world.pair()
    plc = world.server
    world.client.send(client, b"abcdef")
    plc.memory.write(plc.buffer, b"########")
    plc.recv(server, datamax=3)
    assert plc.memory.read(plc.buffer, 8) == b"abc#####"


def test_peek_leaves_the_data(world: World) -> None:
    client, server = world.pair()
    world.client.send(client, b"abc")
    plc = world.server
    assert [plc.received(plc.recv(server, flags=tcpMSG_PEEK)) for _ in range(2)] == [b"abc"] * 2
    assert plc.received(plc.recv(server)) == b"abc"
    assert plc.recv(server, flags=tcpMSG_PEEK).status == tcpERR_NO_DATA


def test_urgent_data(world: World) -> None:
    client, server = world.pair()
    plc = world.server
    assert plc.recv(server, flags=tcpMSG_OOB).status == tcpERR_NO_OOBDATA
    world.client.send(client, b"ab!", tcpMSG_OOB)
    assert plc.received(plc.recv(server, flags=tcpMSG_OOB | tcpMSG_PEEK)) == b"!"
    assert plc.received(plc.recv(server, flags=tcpMSG_OOB)) == b"!"
    assert plc.received(plc.recv(server)) == b"ab"


def test_a_part_then_nothing_then_the_rest() -> None:
    world = World(link=Link(latency_ns=MS))
    server = world.server.listen()
    client = world.client.dial()
    world.pass_time(2 * MS)
    client()
    server()
    world.client.ioctl(client.ident, tcpSO_SNDBUF_SET, (1000).to_bytes(4, "little"))
    sent = world.client.send(client.ident, bytes(1500))
    assert (sent.status, sent.sentlen) == (tcpERR_SENTLEN, 1000)
    sent(pData=sent.pData + 1000, datalen=500)
    assert (sent.status, sent.sentlen) == (tcpERR_WOULDBLOCK, 0)
    world.pass_time(MS)
    sent()
    assert (sent.status, sent.sentlen) == (ERR_OK, 500)


def test_a_graceful_end_is_status_0_with_no_bytes(world: World) -> None:
    client, server = world.pair()
    world.client.close(client)
    for _ in range(2):
        recv = world.server.recv(server)
        assert (recv.status, recv.recvlen) == (ERR_OK, 0)


def test_a_reset(world: World) -> None:
    client, server = world.pair()
    world.net.faults.reset(CLIENT, SERVER)
    for plc, ident in ((world.client, client), (world.server, server)):
        assert plc.recv(ident).status == tcpERR_NOT_CONNECTED
        assert plc.send(ident, b"x").status == tcpERR_NOT_CONNECTED


def test_a_peer_that_is_lost(world: World) -> None:
    client, _ = world.pair()
    world.net.faults.silence(SERVER)
    assert world.client.send(client, b"x").status == ERR_OK
    world.pass_time(world.net.limits.retransmit_ns)
    assert world.client.recv(client).status == tcpERR_NOT_CONNECTED


def test_never_connected(world: World) -> None:
    opened = world.client.open()
    assert world.client.recv(opened.ident).status == tcpERR_NOT_CONNECTED
    assert world.client.send(opened.ident, b"x").status == tcpERR_NOT_CONNECTED


def test_sending_nothing(world: World) -> None:
    client, _ = world.pair()
    sent = world.client.send(client, b"")
    assert (sent.status, sent.sentlen) == (ERR_OK, 0)


@pytest.mark.parametrize("flags", [tcpMSG_PEEK, 8, 0x8000_0000])
def test_unknown_flags_of_send(world: World, flags: int) -> None:
    client, _ = world.pair()
    assert world.client.send(client, b"x", flags).status == tcpERR_PARAMETER


@pytest.mark.parametrize("flags", [tcpMSG_DONTROUTE, 8, 0x8000_0000])
def test_unknown_flags_of_recv(world: World, flags: int) -> None:
    client, _ = world.pair()
    assert world.client.recv(client, flags=flags).status == tcpERR_PARAMETER


def test_no_buffer(world: World) -> None:
    client, _ = world.pair()
    assert world.client.call(TcpSend, ident=client, datalen=1).status == tcpERR_PARAMETER
    assert world.client.call(TcpRecv, ident=client, datamax=1).status == tcpERR_PARAMETER
    assert world.client.recv(client, datamax=0).status == tcpERR_PARAMETER


@pytest.mark.parametrize(("at", "size"), [(WILD, 1), (1, 1), (None, 0xFFFF_FFFF)])
def test_a_wild_buffer_loses_no_bytes(world: World, at: int | None, size: int) -> None:
    client, server = world.pair()
    world.client.send(client, b"kept")
    plc = world.server
    address = plc.buffer if at is None else at
    recv = plc.new(TcpRecv)
    with pytest.raises(PageFault):
        recv(enable=True, ident=server, pData=address, datamax=size)
    assert plc.received(plc.recv(server)) == b"kept"
    with pytest.raises(PageFault):
        plc.call(TcpSend, ident=server, pData=address, datalen=size)
    assert world.client.recv(client).status == tcpERR_NO_DATA


def test_failures_of_the_system(world: World) -> None:
    client, _ = world.pair()
    socket = world.client.idents.find(client).socket
    socket.send = lambda *_, **__: Sent(Outcome.SYSTEM)
    socket.recv = lambda *_, **__: Received(Outcome.SYSTEM)
    assert world.client.send(client, b"x").status == tcpERR_SYSTEM
    assert world.client.recv(client).status == tcpERR_SYSTEM
    socket.send = lambda *_, **__: Sent(Outcome.NO_RESOURCES)
    assert world.client.send(client, b"x").status == tcpERR_WOULDBLOCK


def test_more_than_a_send_buffer_can_hold_is_sent_in_parts() -> None:
    world = World(limits=WireLimits(send_buffer=10))
    client, _ = world.pair()
    plc = world.client
    size = 1_000_000
    sent = plc.call(TcpSend, ident=client, pData=plc.memory.allocate(size), datalen=size)
    assert (sent.status, sent.sentlen) == (tcpERR_SENTLEN, 10)


@settings(max_examples=40, deadline=None)
@given(
    data=st.binary(min_size=1, max_size=2000),
    sizes=st.lists(st.integers(1, 300), min_size=1, max_size=8),
    buffer=st.integers(1, 200),
)
def test_a_program_that_follows_the_statuses_loses_nothing(
    data: bytes, sizes: list[int], buffer: int
) -> None:
    world = World(limits=WireLimits(send_buffer=buffer, receive_buffer=buffer))
    client, server = world.pair()
    world.client.memory.write(world.client.buffer, data)
    send, recv = world.client.new(TcpSend), world.server.new(TcpRecv)
    sent, got, turn = 0, b"", 0
    while len(got) < len(data):
        size = min(sizes[turn % len(sizes)], len(data) - sent)
        if size:
            send(enable=True, ident=client, pData=world.client.buffer + sent, datalen=size)
            assert send.status in (ERR_OK, tcpERR_SENTLEN, tcpERR_WOULDBLOCK)
            sent += send.sentlen
        recv(enable=True, ident=server, pData=world.server.buffer, datamax=sizes[turn % 2 - 1])
        assert recv.status in (ERR_OK, tcpERR_NO_DATA)
        got += world.server.received(recv)
        turn += 1
        assert turn < 10_000
    assert got == data
