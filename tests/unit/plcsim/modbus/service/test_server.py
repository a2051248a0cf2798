import asyncio
import errno
import json
import socket
import struct
import threading
from collections.abc import Awaitable, Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.modbus.service.audit import AuditLog
from plcsim.modbus.service.connection import ModbusConnection
from plcsim.modbus.service.server import Server
from plcsim.modbus.settings import ModbusSettings
from plcsim.shared_image import reader
from tests.ports import free_port

from ..site import World, frame, frames

READ = frame(bytes.fromhex("03 0000 0001"), 9)
ANSWER = frame(bytes.fromhex("03 02 0000"), 9)
SETTINGS = ModbusSettings(port=0)


class Scan:
    """The scan of a world in a thread, as fast as it can, until it is stopped."""

    def __init__(self, world: World) -> None:
        self._world = world
        self._stopped = threading.Event()
        self._thread = threading.Thread(target=self._run)

    def _run(self) -> None:
        while not self._stopped.is_set():
            self._world.plc.run(cycles=1)
            self._stopped.wait(0.001)

    def __enter__(self) -> World:
        self._thread.start()
        return self._world

    def __exit__(self, *_: object) -> None:
        self._stopped.set()
        self._thread.join()


@pytest.fixture(scope="module")
def world() -> Iterator[World]:
    with pytest.MonkeyPatch.context() as patch:
        # the thread of the scan may have to wait for that of the server for longer than usual
        patch.setattr(reader, "STALE_NS", 100_000_000_000)
        with Scan(World()) as made:
            yield made


Client = Callable[[Server], Awaitable[None]]


def serve(
    world: World, client: Client, settings: ModbusSettings = SETTINGS, audit: str = ""
) -> Server:
    """Run a client against a server in one event loop."""

    async def run() -> Server:
        with AuditLog(audit) as world.device.audit:
            server = Server(world.device, settings)
            await server.start()
            try:
                await asyncio.wait_for(client(server), 100)
            finally:
                await server.stop()
        return server

    return asyncio.run(run())


async def exchange(server: Server, data: bytes, size: int) -> bytes:
    reader, writer = await asyncio.open_connection("127.0.0.1", server.port)
    writer.write(data)
    try:
        return await reader.readexactly(size)
    except asyncio.IncompleteReadError as err:
        return err.partial
    finally:
        writer.close()


def test_requests_are_answered_over_a_socket(world: World) -> None:
    async def client(server: Server) -> None:
        assert await exchange(server, READ * 40, 40 * len(ANSWER)) == ANSWER * 40

    serve(world, client)


def test_writes_are_answered_and_audited(world: World, tmp_path: Path) -> None:
    async def client(server: Server) -> None:
        write = frame(bytes.fromhex("06 000a 0007"), 1)
        assert await exchange(server, write, len(write)) == write

    audit = tmp_path / "audit.jsonl"
    serve(world, client, audit=str(audit))
    line = json.loads(audit.read_text())
    assert line["tags"] == [{"tag": "p.words[3]", "value": 7, "before": 0}]
    assert line["peer"].startswith("127.0.0.1:")


def test_a_write_whose_peer_resets_its_connection_is_audited(world: World, tmp_path: Path) -> None:
    async def client(server: Server) -> None:
        for number in range(1, 21):
            with socket.create_connection(("127.0.0.1", server.port)) as peer:
                linger = struct.pack("ii", 1, 0)
                peer.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, linger)
                peer.sendall(frame(b"\x06\0\x0a" + struct.pack(">H", number)))
            while world.tag("p.words[3]") != number:
                await asyncio.sleep(0.001)

    audit = tmp_path / "audit.jsonl"
    serve(world, client, audit=str(audit))
    lines = [json.loads(line) for line in audit.read_text().splitlines()]
    assert [line["tags"][0]["value"] for line in lines] == list(range(1, 21))


def test_a_peer_that_sends_no_more_still_gets_all_its_answers(world: World) -> None:
    write = frame(bytes.fromhex("06 000a 0009"))

    async def client(server: Server) -> None:
        reader, writer = await asyncio.open_connection("127.0.0.1", server.port)
        writer.write(write + READ * 500)
        writer.write_eof()
        assert await asyncio.wait_for(reader.read(), 100) == write + ANSWER * 500
        writer.close()
        while server.peers:
            await asyncio.sleep(0.001)

    serve(world, client)


def test_what_is_not_modbus_is_closed_and_the_server_goes_on(world: World) -> None:
    async def client(server: Server) -> None:
        assert await exchange(server, b"GET / HTTP/1.1\r\n\r\n", 1) == b""
        assert await exchange(server, READ, len(ANSWER)) == ANSWER
        assert server.faults == 1

    serve(world, client)


def test_only_so_many_connections_are_served(world: World) -> None:
    async def client(server: Server) -> None:
        idle = [await asyncio.open_connection("127.0.0.1", server.port) for _ in range(3)]
        while len(server.peers) < 3:
            await asyncio.sleep(0.001)
        refused = []
        for _ in range(200):
            reader, writer = await asyncio.open_connection("127.0.0.1", server.port)
            refused.append(reader.read())
            writer.close()
        await asyncio.gather(*refused, return_exceptions=True)
        assert len(server.peers) == 3
        for reader, writer in idle:
            writer.write(READ)
            assert await reader.readexactly(len(ANSWER)) == ANSWER
            writer.close()
        while server.peers:
            await asyncio.sleep(0.001)
        assert await exchange(server, READ, len(ANSWER)) == ANSWER

    assert serve(world, client, replace(SETTINGS, connections=3)).refused == 200


@pytest.mark.parametrize(
    ("networks", "admitted"),
    [((), True), (("127.0.0.0/8",), True), (("::1/128", "127.0.0.1/32"), True),
     (("10.0.0.0/8",), False)],
)  # fmt: skip
def test_only_the_allowed_networks_are_served(
    world: World, networks: tuple[str, ...], admitted: bool
) -> None:
    async def client(server: Server) -> None:
        try:
            answer = await exchange(server, READ, len(ANSWER))
        except ConnectionError:
            answer = b""
        assert answer == (ANSWER if admitted else b"")

    serve(world, client, replace(SETTINGS, allow=networks))


def test_an_ipv4_peer_of_an_ipv6_socket_is_known_by_its_ipv4_address(world: World) -> None:
    server = Server(world.device, replace(SETTINGS, allow=("10.0.0.0/8",)))
    assert server.admits("::ffff:10.1.2.3")
    assert server.admits("10.1.2.3")
    assert not server.admits("::ffff:11.1.2.3")
    assert not server.admits("fe80::1%eth0")


def test_a_read_only_server_has_no_function_that_writes(world: World) -> None:
    async def client(server: Server) -> None:
        answer = await exchange(server, frame(bytes.fromhex("06 0000 0001")), 9)
        assert frames(answer)[0][2].hex() == "8601"
        assert await exchange(server, READ, len(ANSWER)) == ANSWER

    serve(world, client, replace(SETTINGS, read_only=True))


def test_an_idle_connection_is_closed_half_a_request_does_not_keep_it(world: World) -> None:
    async def client(server: Server) -> None:
        reader, writer = await asyncio.open_connection("127.0.0.1", server.port)
        writer.write(READ)
        await reader.readexactly(len(ANSWER))
        for byte in READ[:-1]:
            writer.write(bytes([byte]))
            await asyncio.sleep(0.05)
        with pytest.raises((asyncio.IncompleteReadError, ConnectionError)):
            await reader.readexactly(1)
        writer.close()

    serve(world, client, replace(SETTINGS, idle_ns=400_000_000))


def test_a_peer_that_does_not_read_is_not_served_without_bound(world: World) -> None:
    async def client(server: Server) -> None:
        large = frame(bytes.fromhex("03 0068 007d"))
        narrow = socket.socket()  # of which little on its way is enough
        narrow.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 8192)
        narrow.connect(("127.0.0.1", server.port))
        reader, writer = await asyncio.open_connection(sock=narrow)
        sent = 0
        for _ in range(400):
            writer.write(large * 1000)
            sent += 1000
            with suppress(TimeoutError):
                await asyncio.wait_for(writer.drain(), 0.2)
            if server.peers and next(iter(server.peers))._is_blocked:
                break
        (peer,) = server.peers
        assert peer._is_blocked
        assert peer._transport.get_write_buffer_size() < 512 * 1024
        assert len(peer.connection._buffer) < 512 * 1024
        assert await exchange(server, READ, len(ANSWER)) == ANSWER
        for _ in range(sent):
            assert (await reader.readexactly(9 + 250))[:2] == b"\0\1"
        writer.close()

    serve(world, client)


def test_stopping_closes_the_connections_and_the_port_is_free_again(world: World) -> None:
    ports = []

    async def client(server: Server) -> None:
        ports.append(server.port)
        reader, writer = await asyncio.open_connection("127.0.0.1", server.port)
        while not server.peers:
            await asyncio.sleep(0.001)
        await server.stop()
        assert await reader.read() == b""
        writer.close()

    serve(world, client, replace(SETTINGS, port=free_port()))

    async def again(server: Server) -> None:
        assert await exchange(server, READ, len(ANSWER)) == ANSWER

    serve(world, again, replace(SETTINGS, port=ports[0]))


def test_a_port_in_use_is_a_configuration_error(world: World) -> None:
    async def client(server: Server) -> None:
        taken = replace(SETTINGS, port=server.port)
        text = f"modbus: cannot listen on 127.0.0.1:{server.port}: Address already in use$"
        with pytest.raises(ConfigurationError, match=text):
            await Server(world.device, taken).start()

    serve(world, client)


def test_a_port_that_needs_rights_gets_the_remedy(
    world: World, monkeypatch: pytest.MonkeyPatch
) -> None:
    def denied(*_: object, **__: object) -> socket.socket:
        raise PermissionError(errno.EACCES, "Permission denied (while attempting to bind)")

    async def start() -> None:
        low = replace(SETTINGS, port=502)
        await Server(world.device, low).start()

    monkeypatch.setattr(socket, "create_server", denied)
    with pytest.raises(ConfigurationError, match=r"127.0.0.1:502: 502 needs root.*port = 1502"):
        asyncio.run(start())


def test_a_peer_that_floods_does_not_hold_up_the_others(
    world: World, monkeypatch: pytest.MonkeyPatch
) -> None:
    steps: list[int] = []
    original = ModbusConnection.step

    def counted(self: ModbusConnection, now_ns: int, requests: int = 64) -> bytes:
        before = self.requests
        answers = original(self, now_ns, requests)
        steps.append(self.requests - before)
        return answers

    monkeypatch.setattr(ModbusConnection, "step", counted)

    async def client(server: Server) -> None:
        flood = asyncio.create_task(exchange(server, READ * 3000, 3000 * len(ANSWER)))
        for _ in range(20):
            assert await exchange(server, READ, len(ANSWER)) == ANSWER
        assert await flood == ANSWER * 3000

    serve(world, client)
    assert max(steps) <= 64


def test_an_aborted_connection_leaves_its_writes_to_the_scan(world: World) -> None:
    async def client(server: Server) -> None:
        _, writer = await asyncio.open_connection("127.0.0.1", server.port)
        writer.write(frame(bytes.fromhex("06 0068 0c0c")))
        await writer.drain()
        writer.transport.abort()
        data = b""
        while data != b"\x0c\x0c":
            data = (await exchange(server, frame(bytes.fromhex("03 0068 0001")), 11))[9:]

    serve(world, client)
    assert struct.pack(">H", world.tag("p.words[4]")) == b"\x0c\x0c"


def test_what_asyncio_would_log_is_counted_and_printed_a_few_times(
    world: World, capsys: pytest.CaptureFixture[str]
) -> None:
    async def client(_server: Server) -> None:
        loop = asyncio.get_running_loop()
        for _ in range(50):
            loop.call_exception_handler({"message": "odd", "exception": ValueError("x")})

    assert serve(world, client).faults == 50
    assert capsys.readouterr().err.count("modbus: asyncio: odd: ValueError('x'); closed") == 10
