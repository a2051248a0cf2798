"""Connections: limits are each client's own, long chunks end them, and who is refused is told."""

import asyncio

import pytest

pytest.importorskip("asyncua")
from asyncua import Server, ua
from asyncua.common.connection import TransportLimits

from plcsim.opcua.service.connections import OpcuaConnection, error

BUSY = error(ua.StatusCodes.BadTcpServerTooBusy, "opcua.connections")


class Transport:
    def __init__(self):
        self.sent = b""
        self.is_ended = False

    def get_extra_info(self, _name):
        return ("127.0.0.1", 50000)

    def write(self, data):
        self.sent += data

    def close(self):
        self.is_ended = True

    def is_closing(self):
        return self.is_ended


def connected(act, most=2):
    """Call with what makes a connection and its transport, on an event loop."""

    async def run():
        server = Server()
        server.iserver.max_connections = most
        clients, limits = [], TransportLimits()

        def connect():
            made = OpcuaConnection(
                iserver=server.iserver,
                policies=[],
                clients=clients,
                closing_tasks=[],
                limits=limits,
            )
            transport = Transport()
            made.connection_made(transport)
            return made, transport

        act(connect)
        for client in list(clients):
            client._task.cancel()
            client._activation_watchdog_task.cancel()

    asyncio.run(run())


def test_who_finds_no_room_is_told():
    def act(connect):
        ends = [connect()[1] for _ in range(3)]
        assert [end.is_ended for end in ends] == [False, False, True]
        assert (ends[1].sent, ends[2].sent) == (b"", BUSY)

    connected(act)


@pytest.mark.parametrize("at", [8, 9, 40])
def test_a_chunk_that_is_too_long_ends_its_connection(at):
    def act(connect):
        made, end = connect()
        data = b"MSGF" + (100_000_000).to_bytes(4, "little") + b"x" * 32
        made.data_received(data[:7])
        assert not end.is_ended
        made.data_received(data[7:at])
        assert end.is_ended
        assert b"a chunk of 100000000 bytes" in end.sent
        made.data_received(b"x" * 1000)
        assert made._buffer == b""

    connected(act)


def test_a_chunk_that_comes_in_pieces_is_waited_for():
    def act(connect):
        made, end = connect()
        made.data_received(b"MSGF" + (60_000).to_bytes(4, "little") + b"x" * 50_000)
        assert not end.is_ended

    connected(act)


def test_what_one_client_negotiates_is_its_own():
    def act(connect):
        greedy, other = connect()[0], connect()[0]
        hello = ua.Hello()
        hello.ReceiveBufferSize = hello.SendBufferSize = 8192
        hello.MaxMessageSize = hello.MaxChunkCount = 1
        greedy.limits.create_acknowledge_and_set_limits(hello)
        assert greedy.limits.max_message_size == 1
        assert other.limits == TransportLimits()

    connected(act)
