"""The service as a process beside a real scan: writes, kill -9, bad orders of the world."""

import itertools
import os
import signal
import socket
import struct
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from plcsim.core.system import State
from plcsim.process.run_file import find_run
from plcsim.process.supervisor import Supervisor
from plcsim.project.plc_toml import Project, read_project
from tests.ports import free_port

from ..site import frame

PROGRAM = """
from plcsim import Program
from st_types import ARRAY, UDINT, UINT, var

class Echo(Program):
    wanted = var(UINT)
    seen = var(UINT)
    block = var(ARRAY(UINT, (1, 120)))
    cycles = var(UDINT)

    def cyclic(self):
        if self.wanted == 666:
            raise RuntimeError("as told")
        self.seen = self.wanted
        self.cycles += 1
"""

KILLS = 3
WRITES = 20
"""So many are acknowledged before each kill."""

PATIENCE_S = 100.0
"""So long what should come is waited for, however busy the host is."""


class Site:
    """A project that runs under its supervisor in a thread."""

    def __init__(self, folder: Path, port: int = 0) -> None:
        self.port = port or free_port()
        (folder / "echo").mkdir()
        (folder / "echo" / "main.py").write_text(PROGRAM)
        rows = ["echo.wanted,hr,0", "echo.seen,hr,1", "echo.cycles,hr,2"]
        rows += [f"echo.block[{i}],hr,{i + 9}" for i in range(1, 121)]
        (folder / "tags.csv").write_text("\n".join(["tag,area,offset", *rows]))
        (folder / "plc.toml").write_text(
            f'[plc]\nrealtime = "off"\nwatchdog = "100s"\n'
            f'[task_class.1]\ncycle = "2ms"\ntolerance = "10s"\n'
            f'programs = ["echo"]\n[modbus]\nport = {self.port}\n'
        )
        self.project: Project = read_project(folder)
        self.supervisor = Supervisor(self.project)
        self.result: dict[str, object] = {}
        self.stays = False
        self._thread = threading.Thread(target=self._wait)
        self._thread.start()

    def _wait(self) -> None:
        self.result = self.supervisor.wait()
        if self.stays:
            self.supervisor.stay()

    def stop(self) -> None:
        self.supervisor.stop()
        self._thread.join(PATIENCE_S)

    def connect(self) -> socket.socket:
        """Return a connection that is answered; a service that is dying still takes some."""
        deadline = time.monotonic() + PATIENCE_S
        while True:
            try:
                client = socket.create_connection(("127.0.0.1", self.port), PATIENCE_S)
            except ConnectionError:
                client = None
            if client is not None:
                client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                if ask(client, bytes.fromhex("03 0000 0001"))[:1] == b"\x03":
                    return client
                client.close()
            assert time.monotonic() < deadline
            time.sleep(0.005)

    def service_pid(self) -> int:
        process = self.supervisor.services._services[0]._process
        assert process is not None
        return process.pid


@pytest.fixture
def site(tmp_path: Path) -> Iterator[Site]:
    made = Site(tmp_path)
    with made.supervisor:
        yield made
        made.stop()


def ask(client: socket.socket, pdu: bytes) -> bytes:
    """Return the PDU of the answer, "" where the connection ends."""
    try:
        client.sendall(frame(pdu))
        header = b""
        while len(header) < 7:
            piece = client.recv(7 - len(header))
            if not piece:
                return b""
            header += piece
        rest, body = int.from_bytes(header[4:6], "big") - 1, b""
        while len(body) < rest:
            body += client.recv(rest - len(body))
    except ConnectionError:
        return b""
    return body


def ask_on(client: socket.socket, pdu: bytes) -> bytes:
    """Ask again where it is a failure of the device: the host may stop the scan for a moment."""
    deadline = time.monotonic() + PATIENCE_S
    while (answer := ask(client, pdu))[1:] == b"\x04":
        assert time.monotonic() < deadline
    return answer


def test_a_write_goes_through_the_program_and_back(site: Site) -> None:
    with site.connect() as client:
        for value in range(1, 50):
            written = b"\x06\0\0" + struct.pack(">H", value)
            assert ask_on(client, written) == written
            assert ask_on(client, bytes.fromhex("03 0000 0002"))[2:] == struct.pack(
                ">HH", value, value
            )


def test_a_killed_service_is_back_and_has_lost_no_acknowledged_write(site: Site) -> None:
    acknowledged = 0
    for kill in range(KILLS):
        with site.connect() as client:
            block = ask_on(client, bytes.fromhex("03 000a 0078"))[2:]
            values = set(struct.unpack(">120H", block))
            assert len(values) == 1  # whole or not at all
            assert values.pop() in (acknowledged, acknowledged + 1)
            killer = threading.Timer(0.001 * kill, os.kill, (site.service_pid(), signal.SIGKILL))
            for value in itertools.count(acknowledged + 1):
                if value - acknowledged > WRITES and not killer.ident:
                    killer.start()  # at any moment of the following writes
                data = struct.pack(">H", value) * 120
                answer = ask_on(client, bytes.fromhex("10 000a 0078 f0") + data)
                if not answer:
                    break
                assert answer.hex() == "10000a0078"
                last = value
            acknowledged = last
    with site.connect():
        assert site.supervisor.services.starts["modbus"] == 1 + KILLS
    site.stop()
    assert site.result["state"] == "STOPPED"


def answered(client: socket.socket, expected: str, pdu: str = "03 0000 0001") -> bool:
    """Ask until the answer starts as expected."""
    deadline = time.monotonic() + PATIENCE_S
    while time.monotonic() < deadline:
        if ask(client, bytes.fromhex(pdu)).hex().startswith(expected):
            return True
        time.sleep(0.01)
    return False


def test_a_scan_that_stands_still_is_a_failure_of_the_device_until_it_goes_on(site: Site) -> None:
    scan = site.supervisor._process.pid
    with site.connect() as client:
        os.kill(scan, signal.SIGSTOP)
        try:
            assert answered(client, "8304")
            assert ask(client, bytes.fromhex("06 0000 0001")).hex() == "8604"
        finally:
            os.kill(scan, signal.SIGCONT)
        assert answered(client, "0302")
        assert answered(client, "0600000001", "06 0000 0001")  # the host may stop it once more


def test_a_killed_scan_takes_its_service_with_it(site: Site) -> None:
    with site.connect() as client:
        service = site.service_pid()
        os.kill(site.supervisor._process.pid, signal.SIGKILL)
        site._thread.join(PATIENCE_S)
        assert site.result["state"] == "SERVICE"
        site.supervisor.services._services[0].stop()
        assert not Path(f"/proc/{service}").exists()
        assert ask(client, bytes.fromhex("03 0000 0001")) == b""


def test_in_service_the_last_cycle_is_still_read_until_the_stop(site: Site) -> None:
    site.stays = True
    with site.connect() as client:
        assert ask_on(client, bytes.fromhex("06 0000 0007")).hex() == "0600000007"
        while site.supervisor.page.state is not State.SERVICE:  # the host may stop the scan
            assert ask(client, bytes.fromhex("06 0000 029a")).hex() in ("060000029a", "8604")
        assert answered(client, "8604", "06 0000 0001")
        assert ask(client, bytes.fromhex("03 0000 0002")).hex() == "0304029a0007"
        assert ask(client, bytes.fromhex("04 fdf2 0001")).hex() == "04020003"
        os.kill(site.service_pid(), signal.SIGKILL)
    with site.connect() as client:
        assert ask(client, bytes.fromhex("03 0000 0002")).hex() == "0304029a0007"
    site.stop()
    assert not site._thread.is_alive()
    assert site.result["state"] == "SERVICE"


def test_a_run_is_found_by_its_folder(site: Site) -> None:
    with site.connect():
        run = find_run(site.project.folder)
        assert run.pid == os.getpid()


def test_a_stopped_run_leaves_neither_process_nor_port(site: Site) -> None:
    with site.connect():
        pid = site.service_pid()
        site.stop()
    site.supervisor.services._services[0].stop()
    assert not Path(f"/proc/{pid}").exists()
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection(("127.0.0.1", site.port), 5)


def test_a_run_whose_service_never_served_is_an_error(tmp_path: Path) -> None:
    port = free_port()
    with socket.create_server(("127.0.0.1", port)):
        made = Site(tmp_path, port)
        with made.supervisor:
            deadline = time.monotonic() + PATIENCE_S
            while not made.supervisor.services.never_served:
                assert time.monotonic() < deadline
                time.sleep(0.01)
            made.stop()
            assert made.supervisor.services.never_served == ["modbus"]
