"""The assembly of a controller: programs, extensions and the image that other processes share.

``plcsim run`` on either clock, the pytest plugin, ``plcsim check`` and whoever else needs a
controller of a project gets it here, so that a project is the same thing everywhere.
"""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.clock import VirtualClock
from plcsim.core.duration import format_duration
from plcsim.core.errors import ConfigurationError, CycleTimeViolation, Findings
from plcsim.host.garbage import collect_while_idle
from plcsim.host.time_limit import time_limit
from plcsim.network import VirtualNetwork
from plcsim.program.fault import location_of
from plcsim.program.loader import ProgramLoader
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from plcsim.project.extension import extensions, in_process, services_of
from plcsim.shared_image import ImageWriter

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from plcsim.core.clock import Clock
    from plcsim.core.controller import Controller, Heartbeat
    from plcsim.network import Network
    from plcsim.program.language import ProgramCode
    from plcsim.project.plc_toml import Project
    from plcsim.project.tables import ProgramEntry

VIRTUAL_IP: Final = "192.168.0.10"
"""Address of the controller on a virtual network."""


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
        unload: forgets its modules, so that the next to load it has them afresh.
    """

    name: str
    setup: Setup
    extensions: Mapping[str, Any] = field(default_factory=dict)
    warnings: Sequence[str] = ()
    unload: Callable[[], None] = _nothing

    def in_process(self, ip: str, *, is_test: bool = False) -> Application:
        """Return the application as it is where no process runs beside the controller.

        Args:
            ip: see `plcsim.project.extension.Extension.in_process`.
            is_test: see `plcsim.project.extension.Extension.in_test`.
        """
        return replace(self, extensions=in_process(self.extensions, ip, is_test=is_test))


@dataclass(frozen=True)
class Image:
    """The shared image of a controller, as its parent gave it.

    Attributes:
        fd: an empty file of shared memory (`plcsim.shared_image.layout.make_file`).
        wake_fds: an eventfd for each service, raised when the scan acknowledged its commands.
    """

    fd: int
    wake_fds: Sequence[int] = ()


def load(project: Project, *, watched: bool = False) -> Application:
    """Load the programs of a project.

    Args:
        project: as plc.toml has it.
        watched: another process ends this one when it does not return within the project's
            ``init_timeout``; otherwise loading is ended here.

    Raises:
        ConfigurationError: programs are missing, cannot be loaded or do not return, or a library
            cannot be told what plc.toml tells it; all findings are told, with file and line.
    """
    sources = dict.fromkeys(entry.source for entry in project.programs)
    loader = ProgramLoader(project.folder, [*sources], project.library_folders)
    try:
        with nullcontext() if watched else time_limit(project.plc.init_timeout_ns):
            return _load(project, loader)
    except CycleTimeViolation as error:
        loader.unload()
        limit = format_duration(project.plc.init_timeout_ns)
        location = location_of(error) or project.folder
        raise ConfigurationError(
            f"{location}: the programs were not loaded within {limit}"
        ) from None
    except BaseException:
        loader.unload()
        raise


def _load(project: Project, loader: ProgramLoader) -> Application:
    findings = Findings()
    settings: list[object] = []
    catalogue = loader.declarations.catalogue
    with findings.gathered():
        settings = catalogue.read_settings(project.libraries)
    codes: Mapping[str, ProgramCode] = {}
    with findings.gathered():
        codes = loader.load()
    findings.check()

    def setup_of(entry: ProgramEntry) -> ProgramSetup:
        return ProgramSetup(entry.name, codes[entry.source])

    exception = project.plc.exception_program
    setup = Setup(
        classes=[
            TaskClassSetup(
                number=c.number,
                cycle_ns=c.cycle_ns,
                programs=[setup_of(p) for p in c.programs],
                tolerance_ns=c.tolerance_ns,
                first_release_ns=c.first_release_ns,
                policy=c.policy,
                host_policy=c.host_policy,
            )
            for c in project.classes
        ],
        memory_size=project.plc.memory_size,
        exception_program=setup_of(exception) if exception else None,
        settings=settings,
        shared=loader.shared if any(kind.members for kind in loader.shared) else None,
        catalogue=catalogue,
        start_date_ns=project.plc.start_date_ns,
    )
    return Application(
        project.name, setup, project.extensions, tuple(loader.warnings), loader.unload
    )


def assemble(
    application: Application,
    *,
    clock: Clock,
    network: Network,
    heartbeat: Heartbeat | None = None,
    image: Image | None = None,
    system_fd: int | None = None,
) -> Controller:
    """Return a controller with the extensions hooked in, ready for its boot.

    Args:
        application: what runs on it; its extensions as they are to be here (`in_process`).
        clock: virtual or real.
        network: what its blocks talk over.
        heartbeat: who watches it from outside.
        image: laid out for services and those who watch; None where nobody reads it.
        system_fd: see `plcsim.program.setup.make_controller`.

    Raises:
        ConfigurationError: the variables do not fit into the memory, or the settings of an
            extension do not fit the tags.
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
    )
    attached = {name: extensions()[name].attach(value, controller) for name, value in given.items()}
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
    """Return a controller that nobody runs, to look at its memory and tags; nothing hooks in."""
    clock = VirtualClock()
    network = VirtualNetwork(clock.now_ns).host(VIRTUAL_IP)
    return make_controller(application.setup, network=network, clock=clock)
