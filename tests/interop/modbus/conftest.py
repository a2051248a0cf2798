"""programs/tank as a user runs it, on a port of its own, for every client here."""

import json
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.ports import free_port

HERE = Path(__file__).parent
TANK = HERE.parents[2] / "programs" / "tank"
TIMEOUT_S = 100.0


class Running:
    """The tank under ``plcsim run``."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.port = free_port()
        file = folder / "plc.toml"
        text, changes = re.subn(r"^port = \d+", f"port = {self.port}", file.read_text(), flags=re.M)
        assert changes == 1
        file.write_text(text)
        self._report = folder / "report.json"
        command = [sys.executable, "-m", "plcsim.cli.main", "run", "--quiet",
                   "--report", str(self._report), str(folder)]  # fmt: skip
        self._process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
        self._wait()

    def _wait(self) -> None:
        """Wait until the first snapshot can be read."""
        deadline = time.monotonic() + TIMEOUT_S
        request = bytes.fromhex("000100000006010300000001")
        while time.monotonic() < deadline:
            try:
                with socket.create_connection(("127.0.0.1", self.port), 1) as probe:
                    probe.sendall(request)
                    if probe.recv(260)[7:8] == b"\x03":
                        return
            except OSError:
                pass
            time.sleep(0.05)
        raise AssertionError("programs/tank does not serve")

    @property
    def service_pid(self) -> int:
        """The process that serves Modbus."""
        tasks = Path(f"/proc/{self._process.pid}/task").glob("*/children")
        children = " ".join(task.read_text() for task in tasks).split()
        (found,) = [
            child
            for child in children
            if "plcsim.modbus.service" in Path(f"/proc/{child}/cmdline").read_text()
        ]
        return int(found)

    def report(self) -> dict[str, Any]:
        """Return the report of the run, after `stop`."""
        found: dict[str, Any] = json.loads(self._report.read_text())
        return found

    def stop(self) -> int:
        self._process.send_signal(signal.SIGINT)
        return self._process.wait(TIMEOUT_S)


@pytest.fixture
def tank(tmp_path: Path) -> Iterator[Running]:
    folder = tmp_path / "tank"
    shutil.copytree(TANK, folder, ignore=shutil.ignore_patterns("__pycache__", ".*"))
    running = Running(folder)
    yield running
    assert running.stop() == 0
