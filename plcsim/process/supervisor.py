"""The parent of the scan process: starts it, watches it, ends what does not go on.

The watchdog (`plcsim.process.watchdog`) is in a process of its own because a stuck program holds
the scan's thread, and with real-time rights its processor too. What it judges is on the status
page. A program that does not return is ended by a signal, which becomes an exception there;
compiled code, where no signal handler of Python runs, polls a budget in shared memory, which is
written here. Before a scan process is killed, its Python stack is taken.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import sys
import time
from typing import TYPE_CHECKING, Any, Final, Self

from plcsim.core import system_area
from plcsim.core.duration import format_duration
from plcsim.core.errors import Fault, PlcError, ProgramError
from plcsim.core.logbook import LENGTH
from plcsim.core.system import State
from plcsim.core.system_area import SystemArea
from plcsim.core.task import Unit
from plcsim.host.processors import keep_off
from plcsim.host.scheduling import processor_ns
from plcsim.host.signals import held_back
from plcsim.host.stack_reader import location_in
from plcsim.process import watchdog
from plcsim.process.orphans import Orphans, end_group
from plcsim.process.output import Output
from plcsim.process.report import SCHEMA, entry_report, fault_report
from plcsim.process.run_file import Run, announce, withdraw
from plcsim.process.scan_process import DUMP, HELD_BACK, STALLED, RunOrder, file_of
from plcsim.process.service_processes import ServiceProcesses
from plcsim.process.watchdog import Sight, Sign, Watch, Watchdog
from plcsim.project.assembly import VIRTUAL_IP, not_loaded
from plcsim.project.extension import in_process
from plcsim.shared_image import ImageNotReady, ImageReader
from plcsim.shared_image.status_page import StatusPage

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from plcsim.core.logbook import Entry
    from plcsim.process.output import ChildOutput
    from plcsim.project.plc_toml import Project
    from plcsim.project.tables import TaskClassEntry
    from plcsim.shared_image.stream import StreamReader

POLL_S = 0.02
"""The watchdog looks this often."""

REAP_NS = 1_000_000_000
"""Between two looks for orphans that have ended."""

DUMP_POLLS = 100
"""How often the watchdog looks for the stack of a program before it kills."""

_STACK = b"(most recent call first)"
"""Stands above each stack that ``faulthandler`` writes."""

START_NS = 60_000_000_000
"""Until it loads the programs; Python imports us, which takes its time on a busy host."""

ONE_THREAD: Final = {"OPENBLAS_NUM_THREADS": "1"}
"""Numpy's library takes 32 MB for each processor, all of them real where memory is locked, and its
threads would compete with the scan; who wants them sets the variable."""


class Supervisor:
    """Runs a project in a scan process of its own.

    Use as a context manager; `wait` returns the result.

    Args:
        project: what plc.toml says.
        virtual: run on the virtual clock and network.
        for_ns: stop after this time of the controller's clock.
        cycles: stop after as many cycles of the first class.
        stays: STOPPED and SERVICE do not end the run: the scan waits for a restart.
        serves: tables whose services run beside the virtual clock as well: their peers are people
            or others who have no part in the time of the controller.
        output: carries what the processes print; by default to this process' stdout and stderr.
        quiet: the services print nothing but errors.
        cold: retained variables begin with their initial values.

    Attributes:
        page: the status page.
        services: the service processes.
    """

    def __init__(  # noqa: PLR0913  # a run has so many choices, each by its name
        self,
        project: Project,
        *,
        virtual: bool = False,
        for_ns: int | None = None,
        cycles: int | None = None,
        stays: bool = False,
        serves: Collection[str] = (),
        output: Output | None = None,
        quiet: bool = False,
        cold: bool = False,
    ) -> None:
        self.page = StatusPage()
        self._project = project
        self._output = output or Output(patient=virtual)
        self._orphans = Orphans()
        self._reaped_ns = 0
        self._classes = self._class_of_each_task(project)
        self._result_fd = os.memfd_create("plcsim-result")
        self._dump_fd = os.memfd_create("plcsim-dump")
        self._system_fd = SystemArea.shared_file()
        self._system = SystemArea.of_file(self._system_fd)
        given = project.extensions
        self.services = ServiceProcesses(
            in_process(given, VIRTUAL_IP) if virtual else given,
            self.page,
            self._output,
            quiet=quiet,
            only=serves if virtual else None,
        )
        self._run = Run(os.getpid(), self.services.image_fd, self.page.fd)
        files = self.page.fd, self._result_fd, self._dump_fd, self.services.image_fd
        fds = (*files, self._system_fd)
        project_fd = file_of(project)
        self._process = _start(
            RunOrder(
                os.getpid(),
                project_fd,
                virtual,
                for_ns,
                cycles,
                stays,
                *fds,
                self.services.wake_fds,
                cold,
            ),
            (project_fd, *fds, *self.services.wake_fds),
            self._output.child(),
        )
        os.close(project_fd)
        with contextlib.suppress(OSError, PlcError):  # only `plcsim watch` needs it
            announce(project.folder, self._run)
        self._virtual = virtual
        self._for_ns = for_ns
        self._running_since_ns: int | None = None
        self._stops = 0
        self._watchdog = Watchdog()
        self._kill_reason = ""
        self._stopped_while_loading = False
        self._keeps_off = False
        self._cpus = os.sched_getaffinity(0)

    @staticmethod
    def _class_of_each_task(project: Project) -> list[TaskClassEntry | None]:
        classes: list[TaskClassEntry | None] = [c for c in project.classes for _ in c.programs]
        return [*classes, None] if project.plc.exception_program else classes

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._reap()
        withdraw(self._project.folder, self._run)
        self.services.close()
        self._orphans.end()
        self._output.flush()
        self._output.close()
        self.page.close()
        os.close(self._result_fd)
        os.close(self._dump_fd)
        os.close(self._system_fd)
        os.sched_setaffinity(0, self._cpus)

    def stop(self) -> None:
        """Ask the scan to stop; the EXITs run.

        A second request ends a program that hangs. A third one, or one while the programs are still
        being loaded, kills the scan process.
        """
        self._stops += 1
        if self._has_ended:
            return
        if self._is_loading:
            self._stopped_while_loading = True
            self._process.kill()
        elif self._stops > 2:
            self._act(self._watchdog.give_up())
        else:
            if self._stops > 1:
                self._system.end_program(system_area.STOPPED)
            self._process.send_signal(signal.SIGINT)

    @property
    def is_asked_to_stop(self) -> bool:
        """Somebody called `stop`."""
        return bool(self._stops)

    @property
    def _is_loading(self) -> bool:
        """The programs are being loaded: nothing of them has run."""
        return not self.page.heartbeat

    def wait(self, look: Callable[[], None] = lambda: None) -> dict[str, Any]:
        """Wait for the end of the run, watching over it.

        Args:
            look: called about every `POLL_S` seconds.

        Returns:
            the report (see `plcsim.process.report`), or {"error": text} where the project is wrong.
        """
        while not self._has_ended:
            now_ns = time.monotonic_ns()
            self._act(self._watchdog.look(self._sight(now_ns)))
            self._tend(now_ns)
            look()
            time.sleep(POLL_S)  # Popen.wait(timeout) would wake five times as often
        self._reap()
        look()
        outcome = self._outcome()
        lost = self._output.flush(lambda: self._virtual and not self._stops)
        if "error" not in outcome:
            outcome["output_lost_bytes"] = lost + self.page.lost_output
        return outcome

    def _tend(self, now_ns: int) -> None:
        """Do what is due beside the scan."""
        if self.page.cpu is not None and not self._keeps_off:
            keep_off(self.page.cpu)  # before services are started: they run where we do
            self._keeps_off = True
        self.services.tend(now_ns)
        self._output.carry()
        if now_ns - self._reaped_ns > REAP_NS:
            self._orphans.reap()
            self._reaped_ns = now_ns

    @property
    def _has_ended(self) -> bool:
        """The scan process has ended; it is not waited for yet, so that its id stays its own."""
        options = os.WEXITED | os.WNOHANG | os.WNOWAIT
        return (
            self._process.returncode is not None
            or os.waitid(os.P_PID, self._process.pid, options) is not None
        )

    def _reap(self) -> None:
        """End the scan process where it has not ended, and what its programs have started."""
        if self._process.returncode is None:
            end_group(self._process.pid)
            self._process.wait()

    def events(self) -> StreamReader | None:
        """Return a reader of all that has happened in the scan, None before its image is there."""
        try:
            return ImageReader(self.services.image_fd).events(from_oldest=True)
        except ImageNotReady:
            return None

    def stay(self, look: Callable[[], None] = lambda: None) -> None:
        """Stay up in SERVICE until `stop` is called: services and watchers read the last snapshot.

        It lies in memory that this process holds.

        Args:
            look: called about every `POLL_S` seconds.
        """
        while not self._stops:
            self._tend(time.monotonic_ns())
            look()
            time.sleep(POLL_S)

    def _sight(self, now_ns: int) -> Sight:
        """Return what is to be seen of the scan process now."""
        active = self.page.active  # before the heartbeat, which grows first
        if self.page.state is State.RUN and self._running_since_ns is None:
            self._running_since_ns = now_ns
        return Sight(
            now_ns=now_ns,
            heartbeat=self.page.heartbeat,
            has_started=self.page.has_started,
            limit_ns=self._limit_ns(active, now_ns),
            has_result=bool(os.fstat(self._result_fd).st_size),
            waits_for_reader=self._output.waits_for_reader,
            processor_ns=processor_ns(self._process.pid),
        )

    def _limit_ns(self, active: int | None, now_ns: int) -> int:
        """Return how long it may take what the scan process does now."""
        if not self.page.has_started:
            return START_NS
        if self._is_loading:
            return self._project.load_timeout_ns
        if self.page.state is not State.RUN:
            return self._project.plc.init_timeout_ns
        if active is None:
            return self._limit_outside_ns(now_ns)
        task_class = self._classes[active]
        if task_class is None:
            return self._project.plc.init_timeout_ns
        return max(self._project.plc.watchdog_ns, task_class.cycle_ns + task_class.tolerance_ns)

    def _limit_outside_ns(self, now_ns: int) -> int:
        """Return how long no program may run: the longest sleep, and some more for the host."""
        sleep_ns = min(max(c.cycle_ns, c.first_release_ns) for c in self._project.classes)
        ran_ns = now_ns - (self._running_since_ns or now_ns)
        patience_ns = watchdog.PATIENCE_NS
        if self._for_ns is not None and not self._virtual and ran_ns > self._for_ns + patience_ns:
            return patience_ns  # it should have ended
        return sleep_ns + self._project.plc.init_timeout_ns

    def _act(self, sign: Sign | None) -> None:
        """Do what the watchdog says."""
        if sign is None:
            return
        if self._watchdog.watch is Watch.STALLED:
            self._system.end_program(system_area.STALLED)
            self._process.send_signal(STALLED)
        elif self._watchdog.watch is Watch.KILLED:
            self._kill(self._reason(sign))

    def _reason(self, sign: Sign) -> str:
        """Return why the scan process is killed, "" where it has left its result."""
        limit = format_duration(self._watchdog.limit_ns)
        match sign:
            case Sign.OVERDUE if not self.page.has_started:
                return f"the scan process did not start within {limit}"
            case Sign.OVERDUE:
                return not_loaded(self._project)
            case Sign.DEAF if self.page.active is None:
                return f"the scan did not go on for {limit}; no program was active"
            case Sign.DEAF:
                return f"did not return within {limit} and could not be interrupted"
            case Sign.GIVEN_UP:
                return "killed because it did not stop"
        return ""

    def _kill(self, reason: str) -> None:
        """End a scan process that does not hear; keep where it is stuck."""
        if reason:
            self._kill_reason = reason
            self._take_stack()
        self._process.kill()

    def _take_stack(self) -> None:
        """Let the scan process write its stack; on a busy host that takes a moment.

        It is whole where a second one begins: the signal is held back while the first is written.
        """
        for wanted in (1, 2):
            self._process.send_signal(DUMP)
            for _ in range(DUMP_POLLS):
                if _read_all(self._dump_fd).count(_STACK) >= wanted:
                    break
                time.sleep(POLL_S)
            else:
                return

    def _outcome(self) -> dict[str, Any]:
        try:
            result: dict[str, Any] = json.loads(_read_all(self._result_fd))
        except ValueError:  # the scan process has left nothing, or not all
            return self._outcome_of_death()
        return result

    def _outcome_of_death(self) -> dict[str, Any]:
        """Return what is known of a scan process that could leave no report itself."""
        reason = self._kill_reason or (
            f"the scan process ended with {_code_name(self._process.returncode)}"
        )
        location = self._location_of_death()
        if self._stopped_while_loading:
            return self._report_of_death(None)
        if self._is_loading:
            return {"error": f"{location or self._project.folder}: {reason}"}
        return self._report_of_death(self._fault(reason, location))

    def _fault(self, reason: str, location: str) -> ProgramError:
        """Return the program and the unit that were active, as the fault."""
        active = self.page.active
        if active is None:
            return ProgramError("scan", "", Fault(location, reason))
        unit = {State.BOOT: Unit.INIT, State.RUN: Unit.CYCLIC}.get(self.page.state, Unit.EXIT)
        name = self._project.programs[active].name
        return ProgramError(name, unit.value, Fault(location, reason))

    def _report_of_death(self, fault: ProgramError | None) -> dict[str, Any]:
        state = State.SERVICE if fault else State.STOPPED
        self.page.changed(state)  # the scan process could not say so itself
        entry = {
            "time_ns": self.page.elapsed_ns,
            "severity": "error" if fault else "information",
            "source": fault.program if fault else "system",
            "text": str(fault) if fault else "stopped while the programs were being loaded",
        }
        entries, dropped = self._last_entries()
        return {
            "schema": SCHEMA,
            "project": self._project.name,
            "clock": "virtual" if self._virtual else "monotonic",
            "realtime_rights": [],
            "state": state.name,
            "fault": fault_report(fault),
            "elapsed_ns": self.page.elapsed_ns,
            "memory_bytes": 0,
            "heaps": [],
            "task_classes": [],
            "violations": [],
            "logbook": [*map(entry_report, entries), entry],
            "logbook_dropped": dropped,
            "output_lost_bytes": 0,
        }

    def _last_entries(self) -> tuple[list[Entry], int]:
        """Return what the scan process wrote into the logbook, and how many entries are missing."""
        image = self.services.image
        if image is None:
            return [], 0
        logbook = image.logbook()
        entries = logbook.read()
        return entries[-LENGTH:], logbook.lost + len(entries[:-LENGTH])

    def _location_of_death(self) -> str:
        """Return "file:line" of the innermost frame of the project's own files."""
        stack = _read_all(self._dump_fd).decode("utf-8", "replace")
        return location_in(stack.splitlines(), str(self._project.folder.resolve()))


def _start(order: RunOrder, fds: tuple[int, ...], output: ChildOutput) -> subprocess.Popen[bytes]:
    """Start the scan process, in a group of its own so that Ctrl-C reaches it through us only."""
    with held_back(HELD_BACK):
        return subprocess.Popen(  # noqa: S603  # our own module
            [sys.executable, "-P", "-m", "plcsim.process.scan_process", order.to_json()],
            pass_fds=fds,
            process_group=0,
            stdin=subprocess.DEVNULL,
            stdout=output.fds[0],
            stderr=output.fds[1],
            env={**ONE_THREAD, **os.environ},
        )


def _read_all(fd: int) -> bytes:
    return os.pread(fd, os.fstat(fd).st_size, 0)


def _code_name(code: int) -> str:
    if code >= 0:
        return f"exit code {code}"
    return next((s.name for s in signal.Signals if s == -code), f"signal {-code}")
