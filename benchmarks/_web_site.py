"""The project of web.py under ``plcsim run``, its clients, and each of its cycles."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple, Self

from _browsers import TAGS
from _children import Children
from _cycle_watch import Cycles, CycleWatch
from _modbus_site import child_with
from _opcua_subscriber import ITEMS, SUBSCRIPTIONS
from _ports import free_port

from plcsim.cli.running import open_as_guest
from plcsim.process.run_file import find_run

if TYPE_CHECKING:
    from collections.abc import Callable

HERE: Final = Path(__file__).parent
ALL_CPUS: Final = os.sched_getaffinity(0)
CYCLE_NS: Final = 1_000_000
REGISTERS: Final = 125
MODBUS_CLIENTS: Final = 4
SERVICES: Final = ("web", "opcua", "modbus")
LOOK_S: Final = 0.05
"""The cycles of a second fit into the stream in which they come."""

MARGIN_S: Final = 2
"""So long the clients of Modbus go on after what they are measured beside."""

PATIENCE_S: Final = 120

PROJECT = """
[task_class.1]
cycle = "1ms"
tolerance = "1us"
on_violation = "log"
programs = ["line"]

[web]
port = {web}

[opcua]
port = {opcua}
tags = ["line.values"]

[modbus]
port = {modbus}
audit = ""
"""
TYPES = "TYPE Cell : STRUCT v : UDINT; END_STRUCT; END_TYPE\n"
VARIABLES = f"""
VAR
    cycle : UDINT;
    at : UINT;
    fast : ARRAY[0..{TAGS - 1}] OF REAL;
    values : ARRAY[0..{SUBSCRIPTIONS * ITEMS - 1}] OF Cell;
    registers : ARRAY[1..{REGISTERS}] OF UINT;
END_VAR
"""
PROGRAM = f"""
PROGRAM _CYCLIC
    cycle := cycle + 1;
    FOR at := 0 TO {TAGS - 1} DO
        fast[at] := fast[at] + 0.5;
    END_FOR
    FOR at := 1 TO {REGISTERS} DO
        registers[at] := UDINT_TO_UINT(cycle);
    END_FOR
    IF cycle MOD 500 = 0 THEN
        FOR at := 0 TO {SUBSCRIPTIONS * ITEMS - 1} DO
            values[at].v := values[at].v + 1;
        END_FOR
    END_IF
END_PROGRAM
"""


class Clients(NamedTuple):
    """Who asks something of the services.

    Attributes:
        busy: a process that does nothing but keep their processor busy, for comparison.
        modbus: 4 clients that ask as fast as they can, behind everybody else (nice 19).
        browsers: how many; with OPC UA.
    """

    busy: bool = False
    modbus: bool = False
    browsers: int = 0


class Site:
    """A run of the project, as long as the block lasts.

    Args:
        folder: for its files.
        client: of Modbus, in C.

    Attributes:
        ports: of the services.
        joining: cycles while clients came and went.
    """

    def __init__(self, folder: Path, client: Path) -> None:
        self.ports = {table: free_port() for table in SERVICES}
        self.joining = Cycles()
        self._client = client
        self._project = Path(tempfile.mkdtemp(dir=folder, prefix="line"))
        self._report = self._project / "report.json"
        self._children = Children()
        files = {
            "plc.toml": PROJECT.format(**self.ports),
            "Global.typ": TYPES,
            "line/Variables.var": VARIABLES,
            "line/cyclic.st": PROGRAM,
            "tags.csv": "tag,area,offset\n"
            + "".join(f"line.registers[{i}],hr,{i - 1}\n" for i in range(1, REGISTERS + 1)),
        }
        for name, text in files.items():
            file = self._project / name
            file.parent.mkdir(exist_ok=True)
            file.write_text(text)

    def __enter__(self) -> Self:
        command = [sys.executable, "-m", "plcsim", "run", "--report", self._report, self._project]
        told = self._project / "told.txt"  # a pipe that nobody reads would hold up the logbook
        with told.open("w") as file:
            self._process = self._children.start(command, stdout=file, stderr=file)
        try:
            self._await_services(told)
            scan = child_with(self._process.pid, "plcsim.process.scan_process")
            self._follow(os.sched_getaffinity(scan))
        except BaseException:
            self._children.close()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        os.sched_setaffinity(0, ALL_CPUS)
        self._children.close()

    def _await_services(self, told: Path) -> None:
        deadline_s = time.monotonic() + PATIENCE_S
        while not all(f"\n{table}: " in f"\n{told.read_text()}" for table in SERVICES):
            if self._process.poll() is not None or time.monotonic() > deadline_s:
                raise SystemExit(f"the project does not run: {told.read_text()[-2000:]}")
            time.sleep(0.1)  # the next look at the file

    def _follow(self, scan: set[int]) -> None:
        """Follow the cycles, with all others on one processor that is not the scan's."""
        # without rights the scan may run anywhere
        cpu = min(ALL_CPUS - scan or ALL_CPUS)
        os.sched_setaffinity(0, {cpu})  # the clients begin where this process is
        for table in SERVICES:
            os.sched_setaffinity(child_with(self._process.pid, f"plcsim.{table}.service"), {cpu})
        image = self._children.enter_context(open_as_guest(find_run(self._project)))
        self._watch = CycleWatch(image, CYCLE_NS, max(scan))

    def leg(
        self, seconds: float, clients: Clients, meanwhile: Callable[[], dict[str, Any]] = dict
    ) -> tuple[Cycles, dict[str, Any]]:
        """Return the cycles of so many seconds beside clients, and what these saw.

        Args:
            seconds: without those in which the clients come and go.
            clients: who is there.
            meanwhile: called in the middle; what it returns is added.
        """
        found: dict[str, Any] = {}
        with Children() as children:
            started = self._start(children, seconds, clients)
            self.joining.add(self._watch.take())
            self._look_until(time.monotonic() + seconds / 2)
            found |= meanwhile()
            self._look_until(time.monotonic() + seconds / 2)
            cycles = self._watch.take()
            for client, output in started:
                found |= self._ended(client, output)
        self.joining.add(self._watch.take())
        return cycles, found

    def _look_until(self, end_s: float) -> None:
        while time.monotonic() < end_s:
            time.sleep(LOOK_S)
            self._watch.look()

    def _start(
        self, children: Children, seconds: float, clients: Clients
    ) -> list[tuple[subprocess.Popen[str], Path]]:
        """Start clients, and wait until they are there."""
        port, python = self.ports, sys.executable
        commands: list[list[Any]] = []
        if clients.browsers:
            commands += [
                [python, HERE / "_opcua_subscriber.py", port["opcua"], self._project.name],
                [python, HERE / "_browsers.py", port["web"], clients.browsers],
            ]
        started = [self._client_of(children, command) for command in commands]
        deadline_s = time.monotonic() + PATIENCE_S
        while not all("ready" in output.read_text() for _, output in started):
            if time.monotonic() > deadline_s or any(c.poll() is not None for c, _ in started):
                raise SystemExit("the clients do not come")
            self._look_until(time.monotonic() + LOOK_S)
        if clients.modbus:
            load = [self._client, "load", port["modbus"], MODBUS_CLIENTS, REGISTERS]
            started.append(
                self._client_of(children, ["nice", "-n", "19", *load, seconds + MARGIN_S])
            )
        if clients.busy:
            children.start([python, "-c", "while True: pass"])
        return started

    def _client_of(
        self, children: Children, command: list[Any]
    ) -> tuple[subprocess.Popen[str], Path]:
        number, name = tempfile.mkstemp(dir=self._project, suffix=".txt")
        with os.fdopen(number, "w") as file:
            return children.start(command, stdin=subprocess.PIPE, stdout=file), Path(name)

    def _ended(self, client: subprocess.Popen[str], output: Path) -> dict[str, Any]:
        """Return what a client printed at its end, without what all of them print."""
        if client.stdin is not None:
            client.stdin.close()
        while client.poll() is None:
            self._look_until(time.monotonic() + LOOK_S)
        if client.returncode:
            raise SystemExit(f"{client.args!r} ended with {client.returncode}")
        told: dict[str, Any] = json.loads(output.read_text().splitlines()[-1])
        if "requests" in told:  # the one of Modbus
            return {"requests_per_s": told["requests"] / told["seconds"], "torn": told["torn"]}
        return told

    def stop(self) -> dict[str, Any]:
        """End the run; return its report."""
        self._process.send_signal(signal.SIGINT)
        self._process.wait(timeout=PATIENCE_S)
        report: dict[str, Any] = json.loads(self._report.read_text())
        return report
