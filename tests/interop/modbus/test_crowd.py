"""1,000 connections at once against the running tank with its default limits."""

import contextlib
import resource
import select
import socket
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

CROWD = 1000
LIMIT = 64
WORKERS = 4
ENOUGH = 20
"""So many answers show that a worker is served beside the crowd."""

REQUEST = bytes.fromhex("000100000006010300000001")


@pytest.fixture(autouse=True)
def descriptors() -> Iterator[None]:
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, min(hard, CROWD + 200)), hard))
    yield
    resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))


class Worker:
    """A client that reads all the time on one connection."""

    def __init__(self, port: int) -> None:
        self.answers = 0
        self.is_well = True
        self._socket = socket.create_connection(("127.0.0.1", port), 100)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._work)
        self._thread.start()

    def _work(self) -> None:
        while not self._ended.wait(0.001):
            try:
                self._socket.sendall(REQUEST)
                self.is_well = self._socket.recv(260)[7:8] == b"\x03"
            except OSError:
                self.is_well = False
            if not self.is_well:
                return
            self.answers += 1

    def goes_on(self) -> bool:
        """Wait until it has been answered some more times."""
        wanted, deadline = self.answers + ENOUGH, time.monotonic() + 100
        while self.is_well and self.answers < wanted and time.monotonic() < deadline:
            time.sleep(0.001)
        return self.answers >= wanted

    def stop(self) -> None:
        self._ended.set()
        self._thread.join()
        self._socket.close()


def connections(port: int) -> list[socket.socket]:
    """Start to connect, all at once."""
    made = []
    for _ in range(CROWD):
        one = socket.socket()
        one.settimeout(0)
        one.connect_ex(("127.0.0.1", port))
        made.append(one)
    return made


def outcomes(crowd: list[socket.socket]) -> dict[str, int]:
    """Ask on every connection; count those that were answered and those that were closed."""
    counts = {"answered": 0, "closed": 0}
    poll = select.poll()
    waiting = {one.fileno(): one for one in crowd}
    for fd in waiting:
        poll.register(fd, select.POLLOUT)
    deadline = time.monotonic() + 100
    while waiting and time.monotonic() < deadline:
        for fd, events in poll.poll(100):
            outcome = _outcome(waiting[fd], events)
            if outcome:
                counts[outcome] += 1
                poll.unregister(fd)
                del waiting[fd]
            else:
                poll.modify(fd, select.POLLIN)
    return counts


def _outcome(one: socket.socket, events: int) -> str:
    """Return "" where the request was sent just now."""
    try:
        if events & select.POLLOUT:
            one.sendall(REQUEST)
            return ""
        return "answered" if one.recv(260)[7:8] == b"\x03" else "closed"
    except OSError:
        return "closed"


def resident_kib(pid: int) -> int:
    return int(Path(f"/proc/{pid}/status").read_text().split("VmRSS:")[1].split()[0])


def descriptors_of(pid: int) -> int:
    return len(list(Path(f"/proc/{pid}/fd").iterdir()))


def comes_down_to(count: int, pid: int) -> bool:
    """Wait until all connections that were closed are forgotten."""
    deadline = time.monotonic() + 100
    while descriptors_of(pid) > count and time.monotonic() < deadline:
        time.sleep(0.01)
    return descriptors_of(pid) <= count


def test_a_crowd_is_turned_away_and_nobody_inside_notices(tank: Any) -> None:
    pid = tank.service_pid
    before_kib = resident_kib(pid)
    open_before = descriptors_of(pid) + WORKERS
    workers = [Worker(tank.port) for _ in range(WORKERS)]
    try:
        for _ in range(3):
            crowd = connections(tank.port)
            assert outcomes(crowd) == {
                "answered": LIMIT - WORKERS,
                "closed": CROWD - LIMIT + WORKERS,
            }
            assert all(worker.goes_on() for worker in workers)
            for one in crowd:
                one.close()
            assert is_served(tank.port)
            assert comes_down_to(open_before, pid)
    finally:
        for worker in workers:
            worker.stop()
    assert all(worker.is_well for worker in workers)
    assert resident_kib(pid) - before_kib < 8 * 1024
    assert tank.stop() == 0
    report = tank.report()
    (scanned,) = report["task_classes"]
    assert report["state"] == "STOPPED"
    assert scanned["violations"]["program"] == scanned["violations"]["preempted"] == 0


def is_served(port: int) -> bool:
    """Ask, on connection after connection, until one is answered: there is room again."""
    deadline = time.monotonic() + 100
    while time.monotonic() < deadline:
        with (
            contextlib.suppress(OSError),
            socket.create_connection(("127.0.0.1", port), 100) as one,
        ):
            one.sendall(REQUEST)
            if one.recv(260)[7:8] == b"\x03":
                return True
        time.sleep(0.01)
    return False
