"""What `ros_fuzz.py` attacks: processes run as a user runs them, watched from outside."""

from __future__ import annotations

import http.client
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import xmlrpc.client
from pathlib import Path
from typing import Any

from _modbus_site import child_with

from crosnode.tcpros.header import encode_header
from crosnode.testing import AttackedPort, Speaks
from plcsim.core.errors import PlcError
from plcsim.network import Address
from plcsim.process.run_file import find_run
from plcsim.shared_image import ImageNotReady, ImageReader
from st_types.types.values import decode

HOST = "127.0.0.1"
PROGRAMS = Path(__file__).parents[1] / "programs"
PLCSIM = [sys.executable, "-m", "plcsim.cli.main"]
PATIENCE_S = 3.0
LISTEN = "0A"
"""State of a listening socket in /proc/net/tcp."""


class Process:
    """A process that listens.

    Args:
        name: for tables.
        command: starts it.
        log: takes what it says.
    """

    def __init__(self, name: str, command: list[str], log: Path) -> None:
        self.name = name
        self._command = command
        self.log = log
        self._popen: subprocess.Popen[bytes] | None = None

    def start(self, master_uri: str) -> None:
        """Start it with this ROS_MASTER_URI."""
        environment = {**os.environ, "ROS_MASTER_URI": master_uri, "ROS_IP": HOST}
        with self.log.open("wb") as log:
            self._popen = subprocess.Popen(self._command, env=environment, stdout=log, stderr=log)

    @property
    def parent(self) -> subprocess.Popen[bytes]:
        """The process that was started."""
        assert self._popen is not None
        return self._popen

    @property
    def pid(self) -> int:
        """Number of the process that listens."""
        return self.parent.pid

    @property
    def is_running(self) -> bool:
        """Whether it has not ended."""
        return self.parent.poll() is None

    @property
    def said(self) -> str:
        """What it printed last."""
        return self.log.read_text(errors="replace")[-1000:]

    def memory_kib(self, field: str = "VmRSS") -> int:
        """Return its resident memory, or the peak of that (VmHWM); 0 where it has gone."""
        try:
            text = Path(f"/proc/{self.pid}/status").read_text()
        except FileNotFoundError:
            return 0
        return int(text.partition(f"{field}:")[2].split()[0]) if field in text else 0

    def doors(self) -> list[AttackedPort]:
        """Return the ports that it listens at, with what they speak."""
        return [
            AttackedPort(Address(HOST, port), Speaks.XMLRPC if answers(port) else Speaks.TCPROS)
            for port in listening_ports(self.pid)
        ]

    def stop(self) -> None:
        """End it as Ctrl-C does."""
        if self._popen is None:
            return
        if self.is_running:
            self._popen.send_signal(signal.SIGINT)
        try:
            self._popen.wait(15)
        except subprocess.TimeoutExpired:
            self._popen.kill()
            self._popen.wait()


class Project(Process):
    """A copy of an example project in its own scan process; its tags and its report can be read.

    Args:
        name: of the example.
        folder: takes the copy.
    """

    def __init__(self, name: str, folder: Path) -> None:
        self.folder = folder / name
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(PROGRAMS / name, self.folder, ignore=ignored)
        self._report = folder / f"{name}.json"
        command = [*PLCSIM, "run", "--quiet", "--report", str(self._report), str(self.folder)]
        super().__init__(name, command, folder / f"{name}.log")
        self._scan_pid = 0

    @property
    def pid(self) -> int:
        """Number of the scan process."""
        self._scan_pid = self._scan_pid or child_with(
            self.parent.pid, "plcsim.process.scan_process"
        )
        return self._scan_pid

    def change(self, file: str, old: str, new: str) -> None:
        """Replace a text in a file of the copy."""
        path = self.folder / file
        text = path.read_text()
        if old not in text:
            raise SystemExit(f"{file} of {self.name} has no {old!r} any more")
        path.write_text(text.replace(old, new))

    def is_readable(self) -> bool:
        """Return whether its tags can be read by now; if so, they are from now on."""
        try:
            run = find_run(self.folder)
            self._reader = ImageReader(run.open(run.image_fd))
            self._reader.copy(0, 0)
        except (PlcError, ImageNotReady):
            return False
        return True

    def tag(self, path: str) -> int:
        """Return a whole number's tag of the latest snapshot."""
        found = self._reader.directory.find(path)
        place = self._reader.directory.offset_of(found.address, found.data_type.size)
        _, data = self._reader.copy(place, place + found.data_type.size)
        value: int = decode(found.data_type, data)
        return value

    def report(self) -> dict[str, Any]:
        """Return its report, after it has ended."""
        report: dict[str, Any] = json.loads(self._report.read_text())
        return report


class ServiceProcess(Process):
    """A process that a project's supervisor starts beside the scan, and stops with it.

    Args:
        name: for tables.
        project: whose service it is.
        module: that it runs.
    """

    def __init__(self, name: str, project: Project, module: str) -> None:
        super().__init__(name, [], project.log)
        self._project = project
        self._module = module
        self._service_pid = 0

    @property
    def pid(self) -> int:
        """Number of the process that ran at the first look; another one after it is an end."""
        self._service_pid = self._service_pid or child_with(self._project.parent.pid, self._module)
        return self._service_pid

    @property
    def is_running(self) -> bool:
        """Whether it has not ended."""
        return Path(f"/proc/{self.pid}").exists()


def listening_ports(pid: int) -> list[int]:
    """Return the TCP ports (IPv4) at which a process listens."""
    own = {str(entry.readlink()) for entry in Path(f"/proc/{pid}/fd").iterdir()}
    rows = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
    return sorted(
        int(row[1].partition(":")[2], 16)
        for row in rows
        if row[3] == LISTEN and f"socket:[{row[9]}]" in own
    )


def answers(port: int) -> bool:
    """Return whether a port answers an XML-RPC call."""
    connection = http.client.HTTPConnection(HOST, port, timeout=PATIENCE_S)
    try:
        connection.request("POST", "/RPC2", xmlrpc.client.dumps(("/fuzz",), "getPid"))
        xmlrpc.client.loads(connection.getresponse().read())
    except (OSError, http.client.HTTPException, ValueError):
        return False
    finally:
        connection.close()
    return True


def refuses(port: int) -> bool:
    """Return whether a port answers a TCPROS header that asks for nothing."""
    try:
        with socket.create_connection((HOST, port), PATIENCE_S) as peer:
            peer.sendall(encode_header({"callerid": "/fuzz"}))
            return b"error=" in peer.recv(4096)
    except OSError:
        return False


def still_answers(door: AttackedPort) -> bool:
    """Return whether a port still does what it is there for."""
    ask = answers if door.speaks is Speaks.XMLRPC else refuses
    return ask(door.address.port)
