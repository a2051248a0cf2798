"""`plcsim run programs/tcp_server` as a user runs it, against real TCP clients."""

import re
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from tests.ports import free_port

PROGRAMS = Path(__file__).parents[2] / "programs"
TIMEOUT_S = 100.0


class Running:
    """The example on ports of its own."""

    def __init__(self, folder: Path, echo_port: int = 0) -> None:
        self.thesis_port = self._set_port(folder / "thesis_server" / "variables.py", free_port())
        echo_port = echo_port or free_port()
        self.echo_port = self._set_port(folder / "echo_server" / "main.py", echo_port)
        command = [sys.executable, "-m", "plcsim.cli.main", "run", str(folder)]
        self.process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)

    @staticmethod
    def _set_port(file: Path, port: int) -> int:
        text, changes = re.subn(r"^PORT = \d+$", f"PORT = {port}", file.read_text(), flags=re.M)
        assert changes == 1
        file.write_text(text)
        return port

    def connect(self, port: int) -> socket.socket:
        deadline = time.monotonic() + TIMEOUT_S
        while True:
            try:
                client = socket.create_connection(("127.0.0.1", port), TIMEOUT_S)
            except ConnectionRefusedError:
                assert self.process.poll() is None, self.process.communicate()[1]
                assert time.monotonic() < deadline
            else:
                client.settimeout(TIMEOUT_S)
                return client

    def echo(self, data: bytes) -> bytes:
        """Send ``data``, end, and return all that comes back."""
        with self.connect(self.echo_port) as client:
            client.sendall(data)
            client.shutdown(socket.SHUT_WR)
            return b"".join(iter(lambda: client.recv(65536), b""))

    def stop(self) -> tuple[int, str]:
        self.process.send_signal(signal.SIGINT)
        errors = self.process.communicate(timeout=TIMEOUT_S)[1]
        return self.process.returncode, errors


@pytest.fixture
def running(tmp_path: Path) -> Iterator[Running]:
    folder = tmp_path / "tcp_server"
    shutil.copytree(PROGRAMS / "tcp_server", folder)
    server = Running(folder)
    yield server
    server.process.kill()
    server.process.communicate()


@pytest.mark.skipif(shutil.which("nc") is None, reason="nc (netcat-openbsd) is not installed")
def test_netcat_gets_its_echo_from_both_servers_and_ctrl_c_ends_with_0(running: Running) -> None:
    for port in (running.echo_port, running.thesis_port):
        running.connect(running.echo_port).close()  # both are listening from then on
        command = ["nc", "-q", "1", "127.0.0.1", str(port)]
        answer = subprocess.run(
            command, input=b"hello", capture_output=True, timeout=TIMEOUT_S, check=True
        )
        assert answer.stdout.rstrip(b"\0") == b"hello"
    code, errors = running.stop()
    assert code == 0, errors
    assert "STOPPED" in errors


def test_a_thousand_clients_one_after_another_and_fifty_at_once(running: Running) -> None:
    for number in range(1000):
        assert running.echo(b"client %d" % number) == b"client %d" % number
    payloads = [bytes([number]) * 50_000 for number in range(50)]
    with ThreadPoolExecutor(50) as pool:
        assert list(pool.map(running.echo, payloads)) == payloads
    code, errors = running.stop()
    assert code == 0, errors


def test_clients_that_flood_reset_or_never_read_do_not_stop_the_others(running: Running) -> None:
    deaf = running.connect(running.echo_port)
    deaf.settimeout(0.2)
    with pytest.raises(TimeoutError):
        deaf.sendall(bytes(100_000_000))
    for _ in range(20):
        rude = running.connect(running.echo_port)
        rude.sendall(b"garbage")
        rude.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")
        rude.close()
    assert running.echo(b"hello") == b"hello"
    deaf.close()
    code, errors = running.stop()
    assert code == 0, errors


def test_a_port_in_use_leaves_the_rest_of_the_controller_running(
    running: Running, tmp_path: Path
) -> None:
    running.connect(running.echo_port).close()
    folder = tmp_path / "second"
    shutil.copytree(PROGRAMS / "tcp_server", folder)
    second = Running(folder, echo_port=running.echo_port)
    try:
        with second.connect(second.thesis_port) as client:
            client.sendall(b"hello")
            assert client.recv(5) == b"hello"
        code, errors = second.stop()
        assert code == 0, errors
    finally:
        second.process.kill()
        second.process.communicate()


def test_the_server_in_structured_text_answers_a_real_client(tmp_path: Path) -> None:
    folder = tmp_path / "tcp_server_st"
    shutil.copytree(PROGRAMS / "tcp_server_st", folder)
    port, file = free_port(), folder / "thesis_server" / "Variables.var"
    file.write_text(file.read_text().replace("22011", str(port)))
    command = [sys.executable, "-m", "plcsim.cli.main", "run", str(folder)]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        deadline = time.monotonic() + TIMEOUT_S
        while True:
            try:
                client = socket.create_connection(("127.0.0.1", port), TIMEOUT_S)
                break
            except ConnectionRefusedError:
                assert process.poll() is None
                assert time.monotonic() < deadline
        with client:
            client.sendall(b"hello")
            assert b"".join(iter(lambda: client.recv(1000), b"")) == b"hello" + bytes(95)
        process.send_signal(signal.SIGINT)
        assert process.wait(TIMEOUT_S) == 0
