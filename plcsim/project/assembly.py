"""The assembly of a controller: programs, extensions and the image that other processes share.

``plcsim run`` on either clock, the pytest plugin, ``plcsim check`` and whoever else needs a
controller of a project gets it here, so that a project is the same thing everywhere.
"""

from __future__ import annotations

import itertools
import sys
import time
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.clock import VirtualClock
from plcsim.core.duration import format_duration
from plcsim.core.errors import ConfigurationError, CycleTimeViolation, ExtensionError, Findings
from plcsim.core.logbook import Severity
from plcsim.host.garbage import collect_while_idle
from plcsim.host.last_resort import last_resort
from plcsim.host.time_limit import time_limit
from plcsim.library.fileio.settings import MadeDevices
from plcsim.network import VirtualNetwork
from plcsim.program.fault import location_of
from plcsim.program.loader import Loaded, ProgramLoader
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from plcsim.project.automation_studio import problems
from plcsim.project.automation_studio.alarms import read_alarms
from plcsim.project.automation_studio.file_devices import file_devices
from plcsim.project.automation_studio.io_channels import (
    channels_type,
    connect,
    variable_type,
)
from plcsim.project.automation_studio.mapping import NO_MAPS, Maps
from plcsim.project.extension import extensions, in_process, services_of
from plcsim.shared_image import ImageWriter

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator, Mapping, Sequence

    from plcsim.core.clock import Clock
    from plcsim.core.controller import Controller, Heartbeat
    from plcsim.library.catalogue import Catalogue
    from plcsim.machine import Frame
    from plcsim.network import Network
    from plcsim.program.language import ProgramCode
    from plcsim.project.plc_toml import Project
    from plcsim.project.tables import ProgramEntry

VIRTUAL_IP: Final = "192.168.0.10"
"""Address of the controller on a virtual network."""


PATIENCE_S: Final = 1.0
"""After this time a person at a terminal is told how many programs are loaded."""


def _nothing() -> None:
    """Forget the modules of program classes: they are not ours."""


@dataclass(frozen=True)
class Application:
    """What runs on a controller, loaded.

    Attributes:
        name: of the project.
        setup: its programs and task classes.
        extensions: settings of the extensions whose table plc.toml has, by table.
        warnings: of its declarations, each with file, line, column and caret.
        left_out: programs that cannot run, and why, by source.
        common: what is wrong in what several programs see; with "keep going" only.
        stubbed: blocks and functions that are looked for and that nothing executes, by library.
        notes: what is not as on the controller: what is left out, what is idle.
        maps: of I/O channels, of variables and of permanent ones.
        unload: forgets its modules, so that the next to load it has them afresh.
    """

    name: str
    setup: Setup
    extensions: Mapping[str, Any] = field(default_factory=dict)
    warnings: Sequence[str] = ()
    left_out: Mapping[str, Sequence[str]] = field(default_factory=dict)
    common: Sequence[str] = ()
    stubbed: Mapping[str, Collection[str]] = field(default_factory=dict)
    notes: Sequence[str] = ()
    maps: Maps = NO_MAPS
    unload: Callable[[], None] = _nothing

    def in_process(self, ip: str, *, is_test: bool = False) -> Application:
        """Return the application as it is where no process runs beside the controller.

        Args:
            ip: see `plcsim.project.extension.Extension.in_process`.
            is_test: see `plcsim.project.extension.Extension.in_test`.
        """
        return replace(self, extensions=in_process(self.extensions, ip, is_test=is_test))


@dataclass(frozen=True)
class ImageFile:
    """The shared image of a controller, as its parent gave it.

    Attributes:
        fd: an empty file of shared memory (`plcsim.shared_image.layout.make_file`).
        wake_fds: an eventfd for each service, raised when the scan acknowledged its commands.
    """

    fd: int
    wake_fds: Sequence[int] = ()


def load(project: Project, *, watched: bool = False, errors_fd: int | None = 2) -> Application:
    """Load the programs of a project.

    Where the project says "keep going", those that can run are loaded.

    Args:
        project: as plc.toml has it.
        watched: another process ends this one when it does not return within the project's
            ``init_timeout``; otherwise loading is ended here.
        errors_fd: where it is told that this process has to be ended, because a program does not
            return from a call into a library in C; None where somebody else sees to that.

    Raises:
        ConfigurationError: programs are missing, cannot be loaded or do not return, or a library
            cannot be told what plc.toml tells it; all findings are told, with file and line.
    """
    wrong = _wrong_before(project)
    layout = project.layout
    usable = {name: place for name, place in layout.programs.items() if name not in wrong}
    loader = ProgramLoader(replace(layout, programs=usable), progress=_Progress())
    try:
        with nullcontext() if watched else _limit(project, errors_fd):
            return _load(project, loader, wrong)
    except CycleTimeViolation as error:
        loader.unload()
        location = location_of(_first(error)) or project.folder
        raise ConfigurationError(f"{location}: {not_loaded(project)}") from None
    except BaseException:
        loader.unload()
        raise


def not_loaded(project: Project) -> str:
    """Return what is told of programs that do not return while they are loaded."""
    return f"the programs were not loaded within {format_duration(project.load_timeout_ns)}"


@contextmanager
def _limit(project: Project, errors_fd: int | None) -> Iterator[None]:
    """End loading after its time: by an exception or, where none comes through, with us."""
    limit_ns, folder = project.load_timeout_ns, project.folder.resolve()
    with last_resort(limit_ns, folder, not_loaded(project), errors_fd), time_limit(limit_ns):
        yield


class _Progress:
    """Says on a terminal how far loading is, where it takes long."""

    def __init__(self) -> None:
        self._start = time.monotonic()
        self._is_shown = False

    def __call__(self, done: int, total: int) -> None:
        is_long = self._is_shown or time.monotonic() - self._start >= PATIENCE_S
        if not is_long or not sys.stderr.isatty():
            return
        self._is_shown = done < total
        end = "" if self._is_shown else "\r\x1b[K"
        sys.stderr.write(f"\r{done} of {total} programs are loaded{end}")
        sys.stderr.flush()


def _first(error: BaseException) -> BaseException:
    """Return the error in whose handling others like it were raised: it knows the line."""
    while isinstance(error.__context__, CycleTimeViolation):
        error = error.__context__
    return error


def placed(application: Application) -> Application:
    """Return an application without the programs that cannot be put on a controller.

    That shows when they are linked: what they call may be nowhere. `Application.left_out` says why.
    """
    return with_controller(application)[0]


def with_controller(application: Application) -> tuple[Application, Controller | None]:
    """Return the same, and a controller of it that nobody runs where nothing was taken out."""
    if not application.setup.classes:
        return application, None
    try:
        return application, still_controller(application)
    except ConfigurationError:
        return _without_unplaced(application), None


def _without_unplaced(application: Application) -> Application:
    setup, left_out = application.setup, dict(application.left_out)
    classes = []
    for task_class in setup.classes:
        good = []
        for program in task_class.programs:
            alone = replace(setup, classes=[replace(task_class, programs=[program])])
            try:
                still_controller(replace(application, setup=alone))
                good.append(program)
            except ConfigurationError as err:
                left_out[program.source] = err.findings
        if good:
            classes.append(replace(task_class, programs=good))
    return replace(application, setup=replace(setup, classes=classes), left_out=left_out)


def runnable(project: Project) -> Project:
    """Return the part of a project that can run, for "keep going".

    Raises:
        ConfigurationError: nothing can.
    """
    project = replace(project, keep_going=True)
    application = load(project)
    try:
        application = placed(application)
        left = project.without(application.left_out, _notes(project, application.left_out))
    finally:
        application.unload()
    if not left.classes:
        raise ConfigurationError(*itertools.chain.from_iterable(application.left_out.values()))
    return left


def _wrong_before(project: Project) -> dict[str, tuple[str, ...]]:
    """Return what is wrong with programs before any is loaded.

    Raises:
        ConfigurationError: something is, and the project does not say "keep going".
    """
    found = project.automation_studio
    if found is None:
        return {}
    used = {entry.source for entry in project.programs}
    wrong = problems.broken(found, [task for task in found.tasks if task.source in used])
    if not project.keep_going:
        errors = [str(each) for each in problems.of_project(found) if not each.missing]
        errors += itertools.chain.from_iterable(wrong.values())
        if errors:
            raise ConfigurationError(*dict.fromkeys(errors))
    return wrong


def _load(
    project: Project, loader: ProgramLoader, wrong: Mapping[str, tuple[str, ...]]
) -> Application:
    findings = Findings()
    settings: list[object] = []
    catalogue = loader.declarations.catalogue
    with findings.gathered():
        settings = [*catalogue.read_settings(project.libraries), *_settings_of(project)]
    loaded = Loaded({}, (), {})
    with findings.gathered():
        loaded = loader.load_each() if project.keep_going else Loaded(loader.load(), (), {})
    findings.check()
    left_out = {**wrong, **loaded.failures}
    maps = project.maps
    sources = {entry.name.upper(): entry.source for entry in project.programs}
    setup = _setup(project, loaded.codes)
    return Application(
        project.name,
        replace(
            setup,
            settings=settings,
            shared=loader.shared if any(kind.members for kind in loader.shared) else None,
            catalogue=catalogue,
            channels=channels_type(
                maps.channels, partial(variable_type, loader.declarations, sources)
            ),
        ),
        project.extensions,
        tuple(loader.warnings),
        left_out,
        loaded.common,
        catalogue.stubbed,
        [*project.left_out, *_notes(project, left_out), *_stub_notes(catalogue)],
        maps,
        loader.unload,
    )


def _settings_of(project: Project) -> list[object]:
    """Return what libraries find in the files of an Automation Studio project."""
    found = project.automation_studio
    if found is None:
        return []
    named = found.configuration.hardware.file_devices
    return [
        MadeDevices(file_devices(named, project.folder.resolve())),
        read_alarms(variable.file for variable in found.mapp_variables),
        found.data_objects,
    ]


def _setup(project: Project, codes: Mapping[str, ProgramCode]) -> Setup:
    """Return the controller that runs programs; classes without any are left out."""

    def setup_of(entry: ProgramEntry) -> ProgramSetup:
        return ProgramSetup(entry.name, codes[entry.source], entry.source)

    exception = project.plc.exception_program
    classes = [
        TaskClassSetup(
            number=c.number,
            cycle_ns=c.cycle_ns,
            programs=[setup_of(p) for p in c.programs if p.source in codes],
            tolerance_ns=c.tolerance_ns,
            first_release_ns=c.first_release_ns,
            policy=c.policy,
            host_policy=c.host_policy,
        )
        for c in project.classes
    ]
    return Setup(
        classes=[each for each in classes if each.programs],
        memory_size=project.plc.memory_size,
        exception_program=setup_of(exception) if exception and exception.source in codes else None,
        start_date_ns=project.plc.start_date_ns,
    )


def _notes(project: Project, left_out: Mapping[str, Sequence[str]]) -> list[str]:
    """Say which tasks do not run, and the first reason of each."""
    tasks = [entry for entry in project.programs if entry.source in left_out]
    return [
        f"{entry.name} is left out: {left_out[entry.source][0].splitlines()[0]}" for entry in tasks
    ]


def _stub_notes(catalogue: Catalogue) -> list[str]:
    notes = []
    for library, found in catalogue.stubbed.items():
        idle = [name for name, text in found.items() if not text]
        if idle:
            notes.append(
                f"{library}: {', '.join(idle)}: nothing executes them here, they do nothing"
            )
        notes += [f"{library}: {name} is simulated: {text}" for name, text in found.items() if text]
    return notes


def assemble(
    application: Application,
    *,
    clock: Clock,
    network: Network,
    heartbeat: Heartbeat | None = None,
    image: ImageFile | None = None,
    system_fd: int | None = None,
    watch: Callable[[Frame], None] | None = None,
) -> Controller:
    """Return a controller with the extensions hooked in, ready for its boot.

    Args:
        application: what runs on it; its extensions as they are to be here (`in_process`).
        clock: virtual or real.
        network: what its blocks talk over.
        heartbeat: who watches it from outside.
        image: laid out for services and those who watch; None where nobody reads it.
        system_fd: see `plcsim.program.setup.make_controller`.
        watch: likewise.

    Raises:
        ConfigurationError: the variables do not fit into the memory.
        ExtensionError: the settings of an extension do not fit the tags.
    """
    given = application.extensions
    for name, value in given.items():
        clock, network = extensions()[name].surround(value, clock, network)
    controller = make_controller(
        application.setup,
        network=network,
        clock=clock,
        heartbeat=heartbeat,
        idle=collect_while_idle,
        system_fd=system_fd,
        watch=watch,
    )
    for note in (*application.notes, *connect(controller, application.maps)):
        controller.log(Severity.WARNING, "system", note)
    try:
        attached = {
            name: extensions()[name].attach(each, controller) for name, each in given.items()
        }
    except ConfigurationError as err:
        raise ExtensionError(*err.findings) from None
    if image is not None:
        writer = ImageWriter(
            image.fd,
            controller,
            project=application.name,
            services={name: attached[name].for_service for name in services_of(given)},
            streams={name: attachment.stream_size for name, attachment in attached.items()},
            exports=[tag for attachment in attached.values() for tag in attachment.exports],
            wake_fds=image.wake_fds,
        )
        for name, attachment in attached.items():
            if attachment.feed is not None:
                attachment.feed(writer.stream_of(name))
    return controller


def still_controller(application: Application) -> Controller:
    """Return a controller that nobody runs, to look at its memory and tags; nothing hooks in.

    Its programs are compiled as for the real clock, without counting instructions: that takes less,
    and a run of the project finds them in the cache.
    """
    network = VirtualNetwork(VirtualClock().now_ns).host(VIRTUAL_IP)
    return make_controller(application.setup, network=network)
