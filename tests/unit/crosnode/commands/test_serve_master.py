"""``plcsim master``: what it says where it cannot start, and that it ends when asked."""

import signal
import socket
import subprocess
import sys
import xmlrpc.client
from collections.abc import Iterator

import pytest

from crosnode.master import process as master_process
from plcsim.cli.main import main
from plcsim.library.astcp import tcpERR_SOCKET_BIND, tcpERR_SYSTEM
from tests.ports import free_port


@pytest.fixture(autouse=True)
def signals() -> Iterator[None]:
    numbers = (signal.SIGINT, signal.SIGTERM)
    before = [signal.getsignal(number) for number in numbers]
    yield
    for number, handler in zip(numbers, before, strict=True):
        signal.signal(number, handler)


@pytest.fixture
def taken() -> Iterator[int]:
    with socket.create_server(("127.0.0.1", 0)) as other:
        yield other.getsockname()[1]


def said(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert main(["master", "--for", "0s", *arguments]) == 1
    return capsys.readouterr().err


def test_a_port_in_use(taken: int, capsys: pytest.CaptureFixture[str]) -> None:
    assert said(capsys, "-p", str(taken)) == f"plcsim: --port: {taken} is in use\n"


def test_an_interface_of_another_host(capsys: pytest.CaptureFixture[str]) -> None:
    text = "plcsim: --bind: '192.0.2.1' is no address of this host\n"
    assert said(capsys, "--bind", "192.0.2.1") == text


@pytest.mark.parametrize(
    ("status", "text"),
    [
        (tcpERR_SOCKET_BIND, "80 needs root or CAP_NET_BIND_SERVICE, which are not given"),
        (tcpERR_SYSTEM, f"80 cannot be opened: AsTCP status {tcpERR_SYSTEM}"),
    ],
)
def test_other_reasons(
    status: int, text: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    class Refused(master_process.MasterServer):
        is_open = False  # type: ignore[assignment]  # as a port is that nobody may open

        def step(self) -> None:
            pass

    monkeypatch.setattr(Refused, "status", status)
    monkeypatch.setattr(master_process, "MasterServer", Refused)
    assert said(capsys, "-p", "80") == f"plcsim: --port: {text}\n"


def test_a_host_that_is_none(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    text = "'a b' is no name or number of a host\n"
    assert said(capsys, "--host", "a b") == f"plcsim: --host: {text}"
    monkeypatch.setenv("ROS_HOSTNAME", "a b")
    assert said(capsys) == f"plcsim: ROS_HOSTNAME: {text}"


def test_it_serves_until_it_is_asked_to_end() -> None:
    port = free_port()
    command = [sys.executable, "-m", "plcsim.cli.main", "master", "-p", str(port)]
    process = subprocess.Popen([*command, "--host", "::1"], stdout=subprocess.PIPE, text=True)
    with process:
        assert process.stdout
        assert process.stdout.readline() == f"ROS_MASTER_URI=http://[::1]:{port}/\n"
        with xmlrpc.client.ServerProxy(f"http://[::1]:{port}/") as master:
            assert master.getPid("/test") == [1, "", process.pid]
            assert master.getParam("/test", "/rosversion")[2] == "1.15.15\n"
        process.terminate()
        assert process.wait(100) == 0
