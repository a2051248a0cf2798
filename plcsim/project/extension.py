"""Extensions: tables of plc.toml beyond [plc], [task_class.N] and [library.NAME].

A package claims a table by an entry point of the group ``plcsim.extensions``: its name is the
table's, its object is an `Extension`. The extension checks the table when the project is read,
hooks into the controller before its boot, and may have a service: a process that the supervisor
starts beside the scan and starts again when it ends.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from importlib.metadata import entry_points
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from plcsim.core.errors import Findings

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.core.clock import Clock
    from plcsim.core.controller import Controller
    from plcsim.core.tag import Tag
    from plcsim.network import Network
    from plcsim.settings.table import Table
    from plcsim.shared_image.stream import StreamWriter

GROUP = "plcsim.extensions"


class Attachment(NamedTuple):
    """What an extension hands over when it has hooked into a controller.

    Attributes:
        for_service: what its service process is told, of JSON's types.
        exports: tags that a snapshot of the shared image must hold.
        stream_size: bytes of the stream that carries samples to its service, 0 where it asks for
            none; a second of samples should fit.
        feed: is given that stream, to write what is not a sample; None for nobody.
    """

    for_service: Any = None
    exports: Sequence[Tag] = ()
    stream_size: int = 0
    feed: Callable[[StreamWriter], None] | None = None


class Extension(Protocol):
    """One table of plc.toml and what it stands for; subclass it for what is not said here."""

    def read(self, table: Table) -> Any:
        """Return the settings in the table; called for every command that reads the project.

        They must survive `pickle`: the process that read plc.toml hands them to the others.

        Raises:
            ConfigurationError: something is wrong; file and field are named (`Table.read`).
        """

    def in_process(self, settings: Any, ip: str) -> Any:
        """Return the settings for the virtual clock and for tests; called before all but ``read``.

        No process runs beside the controller there, and what happens must not depend on where it
        runs.

        Args:
            settings: of the table.
            ip: of the controller on a virtual network, which has nothing of this machine; "" where
                a test uses the network of the host.
        """
        return settings

    def in_test(self, settings: Any, ip: str) -> Any:
        """Return the settings for tests, where nothing may be left in the project."""
        return self.in_process(settings, ip)

    def service(self, settings: Any) -> str:
        """Return the module that serves in a process beside the scan, "" for none.

        `plcsim.process.service_main` calls its function ``serve``.
        """
        return ""

    def stopping_s(self, settings: Any) -> float:
        """Return how many seconds the service may take to end when it is asked to."""
        return 2.0

    def endpoint(self, settings: Any) -> str:
        """Return where others reach the service, as people write it; "" where nobody does."""
        return ""

    def surround(self, settings: Any, clock: Clock, network: Network) -> tuple[Clock, Network]:
        """Return what the controller has for clock and network; called before it is made."""
        return clock, network

    def attach(self, settings: Any, controller: Controller) -> Attachment:
        """Hook into a controller before its boot, in the scan process.

        Values go in by ``controller.image.inputs`` (LATCH) and out by ``controller.image.watchers``
        (PUBLISH), or through the shared image by the service.

        Raises:
            ConfigurationError: the settings do not fit the controller's tags.
        """
        return Attachment()

    def check(self, settings: Any, controller: Controller) -> Sequence[str]:
        """Check what `read` cannot, with a controller that will not run; for ``plcsim check``.

        Nothing may be written or opened to the world.

        Returns:
            what is right in the project but will not work on this host, a line for each.

        Raises:
            ConfigurationError: the settings do not fit the controller's tags, or a file that they
                name is wrong.
        """
        return ()


class _Installed(Mapping[str, "Extension"]):
    """The installed extensions; one is imported when a project has its table, not before."""

    def __init__(self) -> None:
        self._entries = {entry.name: entry for entry in entry_points(group=GROUP)}

    def __getitem__(self, name: str) -> Extension:
        extension: Extension = self._entries[name].load()
        return extension

    def __iter__(self) -> Iterator[str]:
        return iter(sorted(self._entries))

    def __len__(self) -> int:
        return len(self._entries)


@cache
def extensions() -> Mapping[str, Extension]:
    """Return the installed extensions by the table they claim."""
    return _Installed()


def check_settings(settings: Mapping[str, Any], controller: Controller) -> list[str]:
    """Let the extensions of a project check their settings; return their notes on this host.

    Args:
        settings: of the extensions, by table.
        controller: of the project, before its boot.

    Raises:
        ConfigurationError: something is wrong; all of it is told.
    """
    findings = Findings()
    notes: list[str] = []
    for name, value in settings.items():
        with findings.gathered():
            notes += extensions()[name].check(value, controller)
    findings.check()
    return notes


def in_process(settings: Mapping[str, Any], ip: str, *, is_test: bool = False) -> dict[str, Any]:
    """Return the settings where no process runs beside the controller, by table.

    Args:
        settings: of the extensions, by table.
        ip: see `Extension.in_process`.
        is_test: see `Extension.in_test`.
    """

    def here(name: str, value: Any) -> Any:
        extension = extensions()[name]
        return extension.in_test(value, ip) if is_test else extension.in_process(value, ip)

    return {name: here(name, value) for name, value in settings.items()}


def services_of(settings: Mapping[str, Any]) -> dict[str, str]:
    """Return the modules of the services of a project, by table."""
    modules = {name: extensions()[name].service(value) for name, value in settings.items()}
    return {name: module for name, module in modules.items() if module}
