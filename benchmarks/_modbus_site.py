"""What all parts of modbus_load.py share: the project under load, servers, the client in C."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import time
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from _ports import free_port

if TYPE_CHECKING:
    from collections.abc import Iterator

HERE = Path(__file__).parent

PROGRAM = """
from plcsim import Program
from st_types import ARRAY, UINT, var


class Load(Program):
    echo_in = var(UINT)
    echo_out = var(UINT)
    block = var(ARRAY(UINT, (1, 125)))
    count = var(UINT)
    written = var(ARRAY(UINT, (1, 120)))
    torn = var(UINT)

    def cyclic(self) -> None:
        self.echo_out = self.echo_in
        self.count += 1
        self.block.write(self.count.to_bytes(2, "little") * 125)
        data = bytes(self.written)
        self.torn += data != data[:2] * 120
"""

BLOCK = [f"load.block[{i}],hr,{i - 1}" for i in range(1, 126)]
ECHO = ["load.echo_in,hr,0", "load.echo_out,hr,1"]
WRITTEN_AT, TORN_AT = 200, 400
WRITTEN = [f"load.written[{i}],hr,{i + WRITTEN_AT - 1}" for i in range(1, 121)]
TORN = [f"load.torn,hr,{TORN_AT}"]


def build(folder: Path, name: str, *flags: str) -> Path | None:
    """Compile one of the C programs here; None where its library is missing."""
    target = folder / name
    command = ["gcc", "-O2", "-o", str(target), str(HERE / f"{name}.c"), *flags]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return target if done.returncode == 0 else None


def make_project(folder: Path, port: int, rows: list[str]) -> Path:
    project = folder / f"project{port}"
    (project / "load").mkdir(parents=True)
    (project / "load" / "main.py").write_text(PROGRAM)
    (project / "tags.csv").write_text("\n".join(["tag,area,offset", *rows]) + "\n")
    (project / "plc.toml").write_text(
        f'[task_class.1]\ncycle = "1ms"\ntolerance = "1s"\nprograms = ["load"]\n'
        f'[modbus]\nport = {port}\naudit = ""\n'
    )
    return project


def registers(port: int, first: int) -> bytes:
    """Return one holding register, b"" where the answer is none."""
    with socket.create_connection(("127.0.0.1", port), 1) as probe:
        probe.sendall(bytes.fromhex("000100000006 01 03") + first.to_bytes(2, "big") + b"\0\1")
        answer = probe.recv(260)
        return answer[9:] if answer[7:8] == b"\x03" else b""


def wait_for(port: int, process: subprocess.Popen[bytes]) -> None:
    deadline = time.monotonic() + 20
    while time.monotonic() < deadline:
        try:
            if registers(port, 0):
                return
        except OSError:
            pass
        if process.poll() is not None:
            raise SystemExit(f"{process.args!r} ended")
        time.sleep(0.05)
    raise SystemExit(f"nothing serves port {port}")


@contextmanager
def running(command: list[str], port: int, cpu: int | None) -> Iterator[subprocess.Popen[bytes]]:
    """Run a server; where a processor is given, it stays on it."""
    pinned = command if cpu is None else ["taskset", "-c", str(cpu), *command]
    process = subprocess.Popen(pinned, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        wait_for(port, process)
        yield process
    finally:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


class Site:
    """A project with a 1 ms scan under ``plcsim run``, as long as the block lasts.

    Attributes:
        port: where Modbus is served.
        project: its folder.
        process: the supervisor.
        figures: cycles, missed grid points and lateness of the scan, once the block has ended.
    """

    def __init__(self, folder: Path, rows: list[str]) -> None:
        self.port = free_port()
        self.project = make_project(folder, self.port, rows)
        self.figures: dict[str, Any] = {}
        self._report = folder / f"report{self.port}.json"
        self._stack = ExitStack()

    def __enter__(self) -> Self:
        command = [sys.executable, "-m", "plcsim.cli.main", "run", "--quiet",
                   "--report", str(self._report), str(self.project)]  # fmt: skip
        self.process = self._stack.enter_context(running(command, self.port, None))
        return self

    def __exit__(self, *_: object) -> None:
        self._stack.close()
        (scanned,) = json.loads(self._report.read_text())["task_classes"]
        self.figures = {
            "cycles": scanned["cycles"],
            "missed": scanned["missed_grid_points"],
            "lateness_ns": scanned["lateness_ns"],
        }

    @property
    def service(self) -> int:
        """Process id of the Modbus service."""
        return child_with(self.process.pid, "plcsim.modbus.service")

    def resident_kib(self) -> list[int]:
        """Return the resident memory of the scan and of the service process."""
        return [
            resident_kib(child_with(self.process.pid, "plcsim.process.scan_process")),
            resident_kib(self.service),
        ]


def cpu_s(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def resident_kib(pid: int) -> int:
    text = Path(f"/proc/{pid}/status").read_text()
    return int(text.split("VmRSS:")[1].split()[0])


def child_with(pid: int, module: str) -> int:
    """Return the child process that runs a module."""
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            parent = int((folder / "stat").read_text().rsplit(")", 1)[1].split()[1])
            if parent == pid and module in (folder / "cmdline").read_text():
                return int(folder.name)
        except (OSError, ValueError):
            continue
    raise SystemExit(f"no process runs {module}")


def start_client(client: Path, *arguments: object, cpu: int | None = None) -> subprocess.Popen[str]:
    command = [str(client), *map(str, arguments)]
    if cpu is not None:
        command = ["taskset", "-c", str(cpu), *command]
    return subprocess.Popen(command, stdout=subprocess.PIPE, text=True)


def result_of(client: subprocess.Popen[str]) -> dict[str, Any]:
    """Return what a client prints at its end."""
    text, _ = client.communicate()
    if client.returncode:
        raise SystemExit(f"{client.args!r} ended with {client.returncode}")
    result: dict[str, Any] = json.loads(text)
    return result


def run_client(client: Path, *arguments: object, cpu: int | None = None) -> dict[str, Any]:
    return result_of(start_client(client, *arguments, cpu=cpu))
