"""The main of every service process: ``python -m plcsim.process.service_main MODULE ORDER``.

MODULE is the service that an extension named, ORDER a `ServiceOrder` as JSON. The module has a
function ``serve(service)``, which gets a `Service` and returns when it is asked to stop. The
process ends with its supervisor, however early that dies; where it ends otherwise, the supervisor
starts it again. An error of plcsim is printed in one line and ends the process with exit code 1.
"""

from __future__ import annotations

import json
import signal
import sys
import time
from dataclasses import asdict, dataclass
from importlib import import_module
from typing import Any, Protocol, cast

from plcsim.core.errors import PlcError
from plcsim.host import realtime
from plcsim.host.signals import HeldSignals
from plcsim.shared_image import ImageNotReady, ImageReader
from plcsim.shared_image.status_page import ServiceState, StatusPage

HELD_BACK = (signal.SIGTERM, signal.SIGINT)
"""The supervisor starts this process with these signals blocked, and so they stay: it may be asked
to end before it has begun, and has to record what is left all the same."""

PATIENCE_S = 5.0
"""The scan process has made the file of the image; it may take so long to lay it out."""


@dataclass(frozen=True)
class ServiceOrder:
    """What the supervisor tells a service process.

    Attributes:
        table: of plc.toml; names the service's ring and its part of the directory.
        number: of the service among those of the project, on the status page.
        parent: process id of the supervisor.
        image_fd: the shared image.
        status_fd: the status page.
        wake_fd: an eventfd, raised when the scan acknowledged commands of this service.
        quiet: print nothing but errors.
    """

    table: str
    number: int
    parent: int
    image_fd: int
    status_fd: int
    wake_fd: int
    quiet: bool = False

    def to_json(self) -> str:
        """Return the order as the argument of the process."""
        return json.dumps(asdict(self))


class ServiceModule(Protocol):
    """A module that an extension names as its service."""

    def serve(self, service: Service) -> None:
        """Serve until the process is asked to stop.

        Raises:
            PlcError: it cannot, for a reason outside; it is tried again later.
        """


class Service:
    """What a service process has.

    Args:
        order: of the supervisor.

    Attributes:
        table: of plc.toml.
        image: the shared image, with the service's ring.
        given: what the extension handed over in the scan process.
        page: the status page.
        wake_fd: an eventfd, raised when the scan acknowledged commands of this service.
        stop_fd: becomes, and stays, readable when the process is asked to stop.
        quiet: print nothing but errors.

    Raises:
        ImageError: the scan process has not made an image.
    """

    def __init__(self, order: ServiceOrder) -> None:
        self.table = order.table
        self.page = StatusPage(order.status_fd)
        self.wake_fd = order.wake_fd
        self._asked = HeldSignals(HELD_BACK)
        self.stop_fd = self._asked.fd
        self.quiet = order.quiet
        self._number = order.number
        self._told: tuple[ServiceState, str] | None = None
        self.image = _open_image(order)
        self.given: Any = self.image.directory.services[order.table]

    @property
    def is_stopping(self) -> bool:
        """True once the process is asked to stop."""
        return self._asked.is_pending

    def serving(self, text: str) -> None:
        """Note, and print once, that the service is there for its clients.

        Args:
            text: what it serves and where, in one line.
        """
        if self._is_news(ServiceState.SERVING, text) and not self.quiet:
            sys.stderr.write(f"{self.table}: {text}\n")

    def failing(self, text: str) -> None:
        """Note, and print once, why the service is not there; it tries on."""
        if self._is_news(ServiceState.FAILING, text):
            sys.stderr.write(f"plcsim: {text}\n")

    def _is_news(self, state: ServiceState, text: str) -> bool:
        self.page.note_service(self._number, state)
        before, self._told = self._told, (state, text)
        return before != self._told


def _open_image(order: ServiceOrder) -> ImageReader:
    deadline = time.monotonic() + PATIENCE_S
    while True:
        try:
            return ImageReader(order.image_fd, order.table)
        except ImageNotReady:
            if time.monotonic() > deadline:
                raise
            time.sleep(0.01)


def main() -> int:
    """Serve until asked to stop; return the exit code."""
    module, text = sys.argv[1:]
    order = ServiceOrder(**json.loads(text))
    realtime.die_with_parent(signal.SIGTERM, order.parent)
    try:
        service = Service(order)
    except PlcError as err:
        sys.stderr.write(f"plcsim: {err}\n")
        return 1
    try:
        cast("ServiceModule", import_module(module)).serve(service)
    except PlcError as err:
        service.failing(str(err))
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
