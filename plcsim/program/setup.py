"""A controller as configured: which programs run in which task class, and the controller of it."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice
from typing import TYPE_CHECKING, Any

from plcsim.core.context import Context
from plcsim.core.controller import Controller
from plcsim.core.memory import DEFAULT_SIZE, Memory
from plcsim.core.tag import CHANNELS, Tag
from plcsim.core.task import Policy, TaskClass
from plcsim.host.helper_process import share
from plcsim.program.loader import installed_catalogue
from plcsim.program.site import Site
from st_types.types.views import view_class

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from plcsim.core.clock import Clock
    from plcsim.core.controller import Heartbeat
    from plcsim.core.task import Task
    from plcsim.library.catalogue import Catalogue
    from plcsim.machine import Frame
    from plcsim.network import Network
    from plcsim.program.language import PlacedProgram, ProgramCode
    from plcsim.program.variables import DeclaredVariables
    from st_types.types.derived import StructType


@dataclass(frozen=True)
class ProgramSetup:
    """A program and the name it runs under; ``source`` is where it comes from, for messages."""

    name: str
    code: ProgramCode
    source: str = ""


@dataclass(frozen=True)
class TaskClassSetup:
    """A task class as configured; for the fields see `plcsim.core.task.TaskClass`."""

    number: int
    cycle_ns: int
    programs: Sequence[ProgramSetup]
    tolerance_ns: int = 0
    first_release_ns: int | None = None
    policy: Policy = Policy.SERVICE
    host_policy: Policy = Policy.LOG


@dataclass(frozen=True)
class Setup:
    """A controller as configured.

    Attributes:
        classes: the task classes.
        memory_size: bytes of PLC memory.
        exception_program: runs once for each violation under the policy "exception".
        settings: what libraries find by `Context.settings`.
        shared: the global variables, None where there are none.
        catalogue: the libraries that programs see; by default those that are installed.
        channels: those of its simulated I/O modules, None for none.
        start_date_ns: date of the controller at its start, nanoseconds since 1970; None for that of
            its clock.
    """

    classes: Sequence[TaskClassSetup]
    memory_size: int = DEFAULT_SIZE
    exception_program: ProgramSetup | None = None
    settings: Sequence[object] = ()
    shared: DeclaredVariables | None = None
    catalogue: Catalogue | None = None
    channels: StructType[Any] | None = None
    start_date_ns: int | None = None


def make_controller(
    setup: Setup,
    *,
    network: Network | None = None,
    clock: Clock | None = None,
    heartbeat: Heartbeat | None = None,
    idle: Callable[[int], None] = lambda _idle_ns: None,
    system_fd: int | None = None,
    watch: Callable[[Frame], None] | None = None,
) -> Controller:
    """Return the controller of a setup, its variables allocated, not booted.

    Args:
        setup: what runs on it.
        network: what its blocks talk over; None where no block does.
        clock: see `plcsim.core.controller.Controller`, as for the rest.
        heartbeat: likewise.
        idle: likewise.
        system_fd: file of the system area, see `plcsim.core.memory.Memory`.
        watch: told of the stores of compiled programs, see `plcsim.machine.Machine`.

    Raises:
        ConfigurationError: the variables do not fit into the memory.
    """
    context = Context(Memory(setup.memory_size, system_fd), network, setup.settings)
    shared = _shared(setup, context)
    site = Site(
        context,
        setup.catalogue or installed_catalogue(),
        shared,
        counts_instructions=clock is not None and clock.is_virtual,
        watch=watch,
    )
    exception = [setup.exception_program] if setup.exception_program else []
    ordered = sorted(setup.classes, key=lambda c: c.number)
    programs = [*(program for each in ordered for program in each.programs), *exception]
    placed = [program.code.place(program.name, site) for program in programs]
    _compile(placed, site)
    tasks = iter([each.task() for each in placed])
    classes = [_task_class(each, tasks) for each in ordered]
    return Controller(
        classes,
        context,
        shared=[*shared, *_channels(setup, context)],
        exception_task=next(tasks, None),
        clock=clock,
        start_date_ns=setup.start_date_ns,
        heartbeat=heartbeat,
        idle=idle,
    )


def _shared(setup: Setup, context: Context) -> list[Tag]:
    """Reserve the global variables and give programs in Python their view."""
    if setup.shared is None:
        return []
    areas = [tag for tag in setup.shared.allocate(context.memory, "") if tag is not None]
    view = view_class(setup.shared.variables)
    context.globals = context.memory.access(view, areas[0].address, context)
    return areas


def _channels(setup: Setup, context: Context) -> list[Tag]:
    """Reserve the channels of I/O modules."""
    kind = setup.channels
    if kind is None:
        return []
    return [Tag(CHANNELS, kind, context.memory.allocate(kind.size, kind.alignment))]


def _compile(placed: Sequence[PlacedProgram], site: Site) -> None:
    """Compile programs, in two processes where there is much that no cache knows."""
    own = [each.compile for each in placed]
    # a program first, for the second process begins after the first job, and that is a short one
    jobs = [*own[:1], *site.compile_shared, *own[1:]]
    share(len(jobs), lambda number: jobs[number](), lambda _done: None)


def _task_class(setup: TaskClassSetup, tasks: Iterator[Task]) -> TaskClass:
    return TaskClass(
        setup.number,
        setup.cycle_ns,
        setup.tolerance_ns,
        [*islice(tasks, len(setup.programs))],
        first_release_ns=setup.first_release_ns,
        policy=setup.policy,
        host_policy=setup.host_policy,
    )
