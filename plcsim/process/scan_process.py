"""The scan process: loads a project, runs it, leaves a result.

`plcsim.process.supervisor` starts it.

``python -m plcsim.process.scan_process ORDER`` where ORDER is a `RunOrder` as JSON.
"""

from __future__ import annotations

import faulthandler
import io
import json
import os
import pickle
import signal
import sys
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, NoReturn

from plcsim.core.clock import MonotonicClock, VirtualClock
from plcsim.core.errors import ConfigurationError, ExtensionError, PlcError
from plcsim.core.logbook import Severity
from plcsim.core.system_area import REASONS, STOPPED
from plcsim.host import realtime, running_time
from plcsim.network import OsNetwork, VirtualNetwork
from plcsim.process import printing
from plcsim.process.operation import Operation
from plcsim.process.report import report
from plcsim.project.assembly import VIRTUAL_IP, ImageFile, assemble, load
from plcsim.project.project_file import FILE_NAME
from plcsim.shared_image.status_page import StatusPage
from st_types.errors import TypeSystemError

if TYPE_CHECKING:
    from types import FrameType

    from plcsim.core.clock import Clock
    from plcsim.core.controller import Controller
    from plcsim.core.task import TaskClass
    from plcsim.network import Network
    from plcsim.project.plc_toml import Project

STALLED = signal.SIGUSR1
"""The supervisor sends this when a program does not return: it is ended by an exception."""

HELD_BACK = (signal.SIGINT, signal.SIGTERM, STALLED)
"""The supervisor starts this process with these signals blocked, until it can handle them."""

DUMP = signal.SIGUSR2
"""The supervisor sends this before it kills: the Python stack goes to the dump file."""

RETAIN = "retain"
"""The table of plc.toml by which retained variables outlive this process."""

KEPT_IN_MEMORY = (
    "RETAIN variables are kept over a warm restart only: plc.toml has no table [retain]"
)


@dataclass(frozen=True)
class RunOrder:
    """What the supervisor wants run.

    Attributes:
        parent: process id of the supervisor.
        project_fd: a file with the project as its parent read it, pickled.
        virtual: on the virtual clock and network.
        for_ns: how long, None for ever.
        cycles: how many cycles of the first class, None for ever.
        stays: STOPPED and SERVICE do not end the run.
        status_fd: the status page.
        result_fd: a file for the result, a JSON object.
        dump_fd: a file for the Python stack of a program that cannot be interrupted.
        image_fd: an empty file for the shared image.
        system_fd: the system area of the PLC memory, by which compiled programs are ended.
        wake_fds: an eventfd for each service of the project.
        cold: retained variables begin with their initial values.
    """

    parent: int
    project_fd: int
    virtual: bool
    for_ns: int | None
    cycles: int | None
    stays: bool
    status_fd: int
    result_fd: int
    dump_fd: int
    image_fd: int
    system_fd: int
    wake_fds: list[int]
    cold: bool = False

    def to_json(self) -> str:
        """Return the order as the argument of this process."""
        return json.dumps(asdict(self))


def file_of(project: Project) -> int:
    """Return a file for `project_of`; the caller closes it."""
    fd = os.memfd_create("plcsim-project")
    os.write(fd, pickle.dumps(project))
    return fd


def project_of(fd: int) -> Project:
    """Return the project in a file of `file_of`, which is closed."""
    with os.fdopen(fd, "rb") as file:
        file.seek(0)
        project: Project = pickle.load(file)  # noqa: S301  # from the parent, through its own memory
    return project


class _PageHeartbeat(StatusPage):
    """The status page, told the time as well."""

    clock: Clock
    origin_ns = 0

    def finished(self, task_class: TaskClass) -> None:
        super().finished(task_class)
        self.ticked(self.clock.now_ns() - self.origin_ns)


def _no_debugger(*_args: object, **_options: object) -> NoReturn:
    """What ``breakpoint()`` does in a program that runs on its clock."""
    raise PlcError(
        "breakpoint(): a controller that runs cannot be stopped in the middle of a cycle; "
        "in a test it can, python3 -m pytest -s"
    )


def main() -> int:
    """Run the order given as the only argument; the result goes to its file."""
    order = RunOrder(**json.loads(sys.argv[1]))
    realtime.die_with_parent(signal.SIGKILL, order.parent)
    page = _PageHeartbeat(order.status_fd)
    if order.virtual and isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(line_buffering=True)  # what was printed before a crash is seen
    elif not order.virtual:
        printing.never_wait(page.lost)
    sys.breakpointhook = _no_debugger
    faulthandler.enable(file=order.dump_fd, all_threads=False)
    faulthandler.register(DUMP, file=order.dump_fd, all_threads=False)
    try:
        result = _run(order, page)
    except ExtensionError as err:
        result = {"error": str(err), "is_of_extension": True}
    except (PlcError, TypeSystemError) as err:
        result = {"error": str(err)}
    with os.fdopen(order.result_fd, "w", encoding="utf-8") as file:
        json.dump(result, file)
    return 0


def _run(order: RunOrder, page: _PageHeartbeat) -> dict[str, Any]:
    project = project_of(order.project_fd)
    clock: Clock = VirtualClock() if order.virtual else MonotonicClock(running_time.cpu_time())
    network: Network = (
        VirtualNetwork(clock.now_ns).host(VIRTUAL_IP) if order.virtual else OsNetwork()
    )
    page.clock = clock
    if order.stays:
        page.will_stay()
    page.loads()
    application = load(project, watched=True)
    rights = _take_rights(project, order)
    if rights.cpu is not None:
        page.pinned(rights.cpu)  # before services are started, which keep off it
    controller = assemble(
        application.in_process(VIRTUAL_IP) if order.virtual else application,
        clock=clock,
        network=network,
        heartbeat=page,
        image=ImageFile(order.image_fd, order.wake_fds),
        system_fd=order.system_fd,
    )
    _handle_signals(controller)
    for right in rights.refused:
        controller.log(Severity.WARNING, "system", f"no real-time right: {right}")
    if controller.retained.tags and RETAIN not in application.extensions:
        controller.log(Severity.WARNING, "system", KEPT_IN_MEMORY)
    controller.boot(cold=order.cold)
    if rights.complete:
        realtime.settle(rights)
    controller.start()
    origin_ns = page.origin_ns = controller.scan.origin_ns
    operation = Operation(
        controller,
        pacer=clock if isinstance(clock, VirtualClock) else None,
        stays=order.stays,
        beat=page.beat,
        show_paused=page.paused,
    )
    operation.run(None if order.for_ns is None else origin_ns + order.for_ns, order.cycles)
    elapsed_ns = clock.now_ns() - origin_ns
    controller.shutdown()
    controller.close()
    return report(controller, project.name, elapsed_ns, list(rights.granted))


def _take_rights(project: Project, order: RunOrder) -> realtime.Rights:
    if order.virtual or project.plc.realtime == "off":
        realtime.sharpen_timers()
        return realtime.Rights((), ())
    rights = realtime.acquire(project.plc.priority, project.plc.pinned_cpu)
    if project.plc.realtime == "require" and not rights.complete:
        file = project.folder / FILE_NAME
        raise ConfigurationError(
            f"{file}: plc.realtime: required, but not given: {'; '.join(rights.refused)}"
        )
    return rights


def _handle_signals(controller: Controller) -> None:
    """Stop at SIGINT and SIGTERM; at a second SIGINT, or when stalled, end the running program.

    SIGINT comes from the supervisor only. SIGTERM may come besides, from whoever ends all processes
    of a service at once, and that is no second request.

    While compiled code runs no handler does. The supervisor has then ended it through the system
    area, and what is pending is handled on the return from it; several SIGINT have become one.
    """
    interrupts = 0
    system = controller.memory.system

    def stop(number: int, _frame: FrameType | None) -> None:
        nonlocal interrupts
        interrupts += number == signal.SIGINT
        controller.stop()
        if interrupts > 1 or system.verdict:
            controller.abort_program(REASONS[STOPPED])

    def stalled(_number: int, _frame: FrameType | None) -> None:
        if system.verdict:  # otherwise it has been ended meanwhile
            controller.abort_program(system.verdict)

    signal.signal(signal.SIGINT, stop)
    signal.signal(signal.SIGTERM, stop)
    signal.signal(STALLED, stalled)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, HELD_BACK)


if __name__ == "__main__":
    sys.exit(main())
