"""The pages as a process beside a real scan: peers that mean no good, kill -9, TLS."""

import asyncio
import json
import os
import signal
import socket
import ssl
import subprocess
import threading
import time
import urllib.error
import urllib.request
from contextlib import ExitStack
from pathlib import Path

import pytest
from websockets.asyncio import client as asyncio_client
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from plcsim.cli.main import main
from plcsim.process.supervisor import Supervisor
from plcsim.project.plc_toml import read_project
from tests.ports import free_port

PROGRAM = """
from plcsim import Program
from st_types import REAL, UDINT, var

class Echo(Program):
    wanted = var(REAL)
    seen = var(REAL)
    cycles = var(UDINT)
    total = var(UDINT, retain=True)

    def cyclic(self):
        self.seen = self.wanted
        self.cycles += 1
        self.total += 1
"""


class Site:
    """A project that runs under its supervisor in a thread."""

    def __init__(self, folder, web=""):
        self.port = free_port()
        (folder / "echo").mkdir()
        (folder / "echo" / "main.py").write_text(PROGRAM)
        (folder / "plc.toml").write_text(
            f'[plc]\nrealtime = "off"\nwatchdog = "100s"\n'
            f'[task_class.1]\ncycle = "2ms"\ntolerance = "10s"\n'
            f'programs = ["echo"]\n[web]\nport = {self.port}\nconnections = 20\n{web}[retain]\n'
        )
        self.folder = folder
        self.supervisor = Supervisor(read_project(folder), quiet=True)
        self._thread = threading.Thread(target=self.supervisor.wait)
        self._thread.start()

    def stop(self):
        self.supervisor.stop()
        self._thread.join(100)

    def ask(self, act, **values):
        asked = urllib.request.Request(
            f"http://127.0.0.1:{self.port}/api/{act}",
            json.dumps(values).encode(),
            {"Content-Type": "application/json"},
        )
        with urllib.request.urlopen(asked, timeout=100) as answer:
            return json.load(answer)

    def await_pages(self, ask=None):
        """Ask until there is an answer; a service takes a moment to start."""
        deadline = time.monotonic() + 100
        while True:
            try:
                return ask() if ask else self.ask("read", tags=["echo.cycles"])["values"][0]
            except (OSError, urllib.error.URLError):
                assert self._thread.is_alive(), "the run has ended"
                assert time.monotonic() < deadline
                time.sleep(0.02)

    def go_on_from(self, cycles):
        """Ask until the scan has done more cycles; its processor may be somebody else's now."""
        _await(lambda: self.await_pages() > cycles)

    def live(self):
        url = f"ws://127.0.0.1:{self.port}/live"
        origin = f"http://127.0.0.1:{self.port}"
        return connect(url, origin=origin, open_timeout=100, close_timeout=0.2)

    @property
    def process(self):
        return self.supervisor.services._services[0]._process


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    made = Site(tmp_path_factory.mktemp("site"))
    with made.supervisor:
        made.await_pages()
        yield made
        made.stop()


def test_a_write_goes_through_the_program_and_back(site):
    assert site.ask("write", tag="echo.wanted", value="2.5")["before"] == "0.0"
    assert site.ask("read", tags=["echo.wanted"])["values"] == [2.5]
    while site.ask("read", tags=["echo.seen"])["values"] != [2.5]:
        pass
    names = [process["name"] for process in _system(site)["processes"]]
    assert {"supervisor", "scan", "web"} <= set(names)


def _system(site):
    with site.live() as socket_:
        socket_.send(json.dumps({"id": 1, "do": "follow", "topics": ["system"]}))
        while True:
            told = json.loads(socket_.recv(timeout=100))
            if told.get("push") == "system":
                return told


def test_a_message_of_100_mb_is_refused_before_it_has_come(site):
    with site.live() as socket_:
        masked_text = b"\x81\xff" + (100_000_000).to_bytes(8, "big") + b"mask"  # RFC 6455, 5.2
        socket_.socket.sendall(masked_text)
        with pytest.raises(ConnectionClosed) as told:
            _read_all(socket_)
        assert told.value.rcvd.code == 1009
    assert site.await_pages()


def test_a_message_that_is_sent_all_the_same_ends_its_connection_and_nothing_else(site):
    with site.live() as socket_, pytest.raises(ConnectionClosed):
        socket_.send(iter(["x" * (1 << 20)] * 100))
    assert site.await_pages()


def test_a_body_of_100_mb_is_refused_before_it_has_come(site):
    with socket.create_connection(("127.0.0.1", site.port), 100) as client:
        client.settimeout(5)
        head = "POST /api/read HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
        client.sendall(f"{head}Content-Length: 100000000\r\n\r\n".encode())
        sent = 0
        try:
            for _ in range(100):
                sent += client.send(b" " * (1 << 20))
        except OSError:
            pass
        assert sent < 20_000_000
    assert site.await_pages()


def test_of_a_thousand_connections_those_beyond_the_limit_are_told_so(site):
    before, rss = site.await_pages(), _rss(site.process.pid)
    late = site.ask("status")["cycles"]["1"]
    with ExitStack() as stack:
        clients = [
            stack.enter_context(socket.create_connection(("127.0.0.1", site.port), 100))
            for _ in range(1000)
        ]
        for client in clients[100:]:
            assert b"503" in client.recv(100)
        _await(lambda: _descriptors(site.process.pid) < 20 + 40)
        assert _rss(site.process.pid) - rss < 20_000_000
    site.go_on_from(before)
    for cause in ("by_program", "by_controller"):
        assert site.ask("status")["cycles"]["1"][cause] == late[cause]


def _read_all(socket_):
    while socket_.recv(timeout=100):
        pass


def _await(act):
    deadline = time.monotonic() + 100
    while not act():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def _descriptors(pid):
    return len(list(Path(f"/proc/{pid}/fd").iterdir()))


def _rss(pid):
    return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_what_is_no_http_is_refused(site):
    for data in (b"\x16\x03\x01\0\0", b"GET / HTTP/9\r\n\r\n", b"\r\n\r\n" + b"A" * 100_000):
        with socket.create_connection(("127.0.0.1", site.port), 100) as client:
            client.sendall(data)
            client.settimeout(5)
            try:
                while client.recv(1000):
                    pass
            except OSError:
                pass
    assert site.await_pages()


def test_a_browser_that_reads_nothing_does_not_hold_up_others(site):
    with site.live() as slow:
        slow.send(json.dumps({"id": 1, "do": "watch", "tags": ["echo.cycles"]}))
        for number in range(300):
            slow.send(json.dumps({"id": number, "do": "children", "path": "echo"}))
        site.go_on_from(site.await_pages())


def test_a_service_that_is_killed_comes_back_and_the_scan_goes_on(site):
    before = site.await_pages()
    site.ask("force", tag="echo.wanted", value="8.0")
    os.kill(site.process.pid, signal.SIGKILL)
    site.go_on_from(before)
    (force,) = site.ask("status")["forces"]
    assert force == {"path": "echo.wanted", "value": "8.0", "by": "web: local"}
    site.ask("release", tag="")
    assert site.ask("status")["cycles"]["1"]["by_program"] == 0


def test_a_warm_start_keeps_what_is_retained_and_a_cold_start_does_not(site):
    def earlier():
        """Return the cycles that are counted in total and not in those of this start."""
        cycles, total = site.ask("read", tags=["echo.cycles", "echo.total"])["values"]
        return total - cycles

    site.ask("warm_restart")
    _await(lambda: earlier() > 0)
    site.ask("cold_restart")
    _await(lambda: earlier() == 0)
    values = site.folder / "values.json"
    _await(lambda: main(["retain", "export", str(site.folder), "-o", str(values)]) == 0)
    assert json.loads(values.read_text()).keys() == {"echo.total"}


async def first_message(port, context):
    """Return what a browser is told first; by one thread: two may not share a socket of TLS."""
    url, origin = f"wss://localhost:{port}/live", f"https://localhost:{port}"
    async with asyncio_client.connect(url, origin=origin, ssl=context, open_timeout=100) as live:
        return json.loads(await asyncio.wait_for(live.recv(), 100))


def test_pages_over_tls(tmp_path):
    command = ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt",
               "ec_paramgen_curve:prime256v1", "-nodes", "-days", "1", "-subj", "/CN=localhost",
               "-addext", "subjectAltName=DNS:localhost,IP:127.0.0.1",
               "-keyout", tmp_path / "key.pem", "-out", tmp_path / "cert.pem"]  # fmt: skip
    subprocess.run(command, check=True, capture_output=True)
    site = Site(tmp_path, '[web.tls]\ncertificate = "cert.pem"\nkey = "key.pem"\n')
    with site.supervisor:
        context = ssl.create_default_context(cafile=tmp_path / "cert.pem")

        def first_page():
            url = f"https://localhost:{site.port}/"
            with urllib.request.urlopen(url, timeout=100, context=context) as answer:
                return answer.read()

        assert b"plcsim" in site.await_pages(first_page)
        assert asyncio.run(first_message(site.port, context))["push"] == "hello"
        site.stop()
