from __future__ import annotations

import errno
import gc
import os
import resource
import socket
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from plcsim.host.descriptors import ROOM
from plcsim.network import Address, OsNetwork, Outcome
from plcsim.network.os_network import OsSocket, SocketWatch
from plcsim.network.protocol import MAX_RECEIVE_LOW, Option

if TYPE_CHECKING:
    from collections.abc import Iterator

NET = OsNetwork()


class Failing:
    """A socket of the host on which every call fails as told."""

    family = socket.AF_INET

    def __init__(self, number: int) -> None:
        self.number = number

    def settimeout(self, _: float) -> None:
        pass

    def fileno(self) -> int:
        return -1

    def fail(self, *_: object) -> None:
        raise OSError(self.number, os.strerror(self.number))

    accept = send = recv = listen = setsockopt = getsockopt = shutdown = close = getsockname = fail


def failing(number: int, *, connected: bool = True) -> OsSocket:
    return OsSocket(Failing(number), SocketWatch(), Address("127.0.0.1", 1) if connected else None)


@pytest.fixture
def listener() -> Iterator[OsSocket]:
    made = NET.open("127.0.0.1", 0).socket
    made.listen(5)
    yield made
    made.close()


@contextmanager
def no_descriptors() -> Iterator[None]:
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (3, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))


def connect(listener: OsSocket) -> OsSocket:
    client = NET.open("", 0).socket
    while (outcome := client.connect(listener.local)) is Outcome.WOULD_BLOCK:
        time.sleep(0.0005)
    assert outcome is Outcome.OK
    return client


def test_no_more_descriptors_to_open() -> None:
    with no_descriptors():
        assert NET.open("", 0).outcome is Outcome.NO_RESOURCES


def test_no_more_descriptors_to_accept(listener: OsSocket) -> None:
    client = connect(listener)
    with no_descriptors():
        assert listener.accept().outcome is Outcome.NO_RESOURCES
    answer = listener.accept()
    assert answer.outcome is Outcome.OK
    answer.socket.close()
    client.close()


def test_descriptors_never_block_and_end_with_the_program(listener: OsSocket) -> None:
    client = connect(listener)
    server = listener.accept().socket
    for made in (listener, client, server):
        number = made._socket.fileno()
        assert not os.get_blocking(number)
        assert not os.get_inheritable(number)
    client.close()
    server.close()


def test_a_failed_open_leaves_no_descriptor() -> None:
    gc.collect()  # what others left open is not counted
    before = len(list(Path("/proc/self/fd").iterdir()))
    assert NET.open("203.0.113.7", 0).outcome is Outcome.NOT_LOCAL
    assert len(list(Path("/proc/self/fd").iterdir())) == before


@pytest.mark.parametrize(
    ("number", "outcome"),
    [
        (errno.EAGAIN, Outcome.WOULD_BLOCK),
        (errno.EINTR, Outcome.WOULD_BLOCK),
        (errno.ECONNRESET, Outcome.RESET),
        (errno.EPIPE, Outcome.RESET),
        (errno.ETIMEDOUT, Outcome.TIMED_OUT),
        (errno.EHOSTUNREACH, Outcome.UNREACHABLE),
        (errno.ENOBUFS, Outcome.NO_RESOURCES),
        (errno.EIO, Outcome.SYSTEM),
    ],
)
def test_failures_of_a_connection(number: int, outcome: Outcome) -> None:
    assert failing(number).recv(1).outcome is outcome
    assert failing(number).send(b"x").outcome is outcome
    assert failing(number).shutdown(write=True) is outcome


def test_a_lost_connection_stays_lost() -> None:
    made = failing(errno.ETIMEDOUT)
    assert made.recv(1).outcome is Outcome.TIMED_OUT
    made._socket = Failing(errno.EPIPE)
    assert made.send(b"x").outcome is Outcome.TIMED_OUT


@pytest.mark.parametrize(
    ("number", "outcome"),
    [
        (errno.ECONNABORTED, Outcome.WOULD_BLOCK),
        (errno.ENETUNREACH, Outcome.WOULD_BLOCK),
        (errno.EMFILE, Outcome.NO_RESOURCES),
        (errno.EPROTO, Outcome.SYSTEM),
    ],
)
def test_failures_of_accept(number: int, outcome: Outcome) -> None:
    assert failing(number, connected=False).accept().outcome is outcome


def test_failures_of_close_are_nobody_s() -> None:
    made = failing(errno.EIO)
    made.close()
    assert made.peer is None


def test_a_connection_by_loopback_is_refused_after_the_listener_is_gone(
    listener: OsSocket,
) -> None:
    target = listener.local
    listener.close()
    client = NET.open("", 0).socket
    while (outcome := client.connect(target)) is Outcome.WOULD_BLOCK:
        time.sleep(0.0005)
    assert outcome is Outcome.REFUSED
    client.close()


def test_the_table_of_descriptors_does_not_grow_while_connections_come() -> None:
    wanted = min(ROOM, resource.getrlimit(resource.RLIMIT_NOFILE)[0])
    code = (
        "import re; from plcsim.network import OsNetwork; OsNetwork();"
        "print(re.search(r'FDSize:\\s+(\\d+)', open('/proc/self/status').read())[1])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert int(done.stdout) >= wanted


def test_what_lies_below_the_mark_is_told_once_the_mark_is_taken_back(listener: OsSocket) -> None:
    client = connect(listener)
    server = listener.accept().socket
    NET.look()
    assert client.set_option(Option.RECEIVE_LOW, MAX_RECEIVE_LOW) is Outcome.OK
    assert server.send(b"block").taken == 5
    assert client not in NET.look()
    assert client.set_option(Option.RECEIVE_LOW, 1) is Outcome.OK
    assert client in NET.look()
    assert client.recv(10).data == b"block"
    client.close()
    server.close()
