import asyncio
import resource
import socket
import time
from collections.abc import Awaitable, Callable

import pytest

from plcsim.modbus.service import listener
from plcsim.modbus.service.listener import Listener, endpoint


class Greeter(asyncio.Protocol):
    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        assert isinstance(transport, asyncio.Transport)
        transport.write(b"welcome")


Client = Callable[[Listener], Awaitable[None]]


def listen(
    client: Client,
    host: str = "127.0.0.1",
    most: int = 100,
    failures: list[str] | None = None,
) -> tuple[list[str], list[str]]:
    """Run a client; return the addresses that asked for admission, and the failures."""
    asked: list[str] = []
    failures = [] if failures is None else failures

    def admit(address: str, _port: int) -> asyncio.Protocol | None:
        asked.append(address)
        return Greeter() if len(asked) <= most else None

    async def run() -> None:
        made = Listener(host, 0, None, admit, lambda _name, text: failures.append(text))
        try:
            await asyncio.wait_for(client(made), 100)
        finally:
            made.close()

    asyncio.run(run())
    return asked, failures


async def greeting(port: int, host: str = "127.0.0.1") -> bytes:
    reader, writer = await asyncio.open_connection(host, port)
    try:
        return await reader.read(7)
    except ConnectionResetError:
        return b""
    finally:
        writer.close()


def test_who_is_not_admitted_is_closed_at_once() -> None:
    async def client(made: Listener) -> None:
        assert await greeting(made.port) == b"welcome"
        assert await greeting(made.port) == b""

    assert listen(client, most=1) == (["127.0.0.1", "127.0.0.1"], [])


def test_two_colons_are_all_addresses_of_both_kinds() -> None:
    if not socket.has_dualstack_ipv6():
        pytest.skip("this host has no IPv6")

    async def client(made: Listener) -> None:
        assert await greeting(made.port, "127.0.0.1") == b"welcome"
        assert await greeting(made.port, "::1") == b"welcome"

    asked, _ = listen(client, host="::")
    assert asked == ["::ffff:127.0.0.1", "::1"]


def test_without_descriptors_nobody_gets_in_until_there_are_some_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(listener, "PAUSE_S", 0.05)
    limits = resource.getrlimit(resource.RLIMIT_NOFILE)

    async def client(made: Listener) -> None:
        waiting = socket.socket()
        waiting.settimeout(0)
        probe = socket.socket()
        free = probe.fileno()
        probe.close()
        resource.setrlimit(resource.RLIMIT_NOFILE, (free, limits[1]))
        try:
            waiting.connect_ex(("127.0.0.1", made.port))
            start_s = time.monotonic()
            while len(failures) < 4:
                await asyncio.sleep(0.01)
            spent_s.append(time.monotonic() - start_s)
        finally:
            resource.setrlimit(resource.RLIMIT_NOFILE, limits)
        loop = asyncio.get_running_loop()
        assert await asyncio.wait_for(loop.sock_recv(waiting, 7), 100) == b"welcome"
        waiting.close()

    failures: list[str] = []
    spent_s: list[float] = []
    asked, _ = listen(client, failures=failures)
    assert asked == ["127.0.0.1"]
    assert spent_s[0] >= 2 * listener.PAUSE_S  # it does not try all the time
    assert "Too many open files" in failures[0]


@pytest.mark.parametrize(
    ("host", "written"),
    [
        ("10.0.0.1", "10.0.0.1:502"),
        ("fe80::1", "[fe80::1]:502"),
        ("::ffff:10.0.0.1", "10.0.0.1:502"),
    ],
)
def test_addresses_are_written_as_people_write_them(host: str, written: str) -> None:
    assert endpoint(host, 502) == written
