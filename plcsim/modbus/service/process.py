"""The Modbus service process; `plcsim.process.service_main` calls `serve`."""

from __future__ import annotations

import asyncio
import importlib
from importlib.metadata import version
from typing import TYPE_CHECKING

from plcsim.host import descriptors
from plcsim.modbus.map.point import point_from
from plcsim.modbus.map.status_block import ControllerStatus
from plcsim.modbus.service.audit import AuditLog
from plcsim.modbus.service.device import Device, Identity
from plcsim.modbus.service.listener import endpoint
from plcsim.modbus.service.server import Server
from plcsim.modbus.settings import settings_from

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.process.service_main import Service
    from plcsim.shared_image.status_page import StatusPage


def serve(service: Service) -> None:
    """Serve the map until asked to stop.

    Raises:
        ConfigurationError: the address cannot be listened on, or TLS is not set up.
    """
    with asyncio.Runner(loop_factory=_loop_factory()) as runner:
        runner.run(_serve(service))


def _loop_factory() -> Callable[[], asyncio.AbstractEventLoop] | None:
    """Return uvloop's loop where it is installed (pip install plcsim[fast])."""
    try:
        factory: Callable[[], asyncio.AbstractEventLoop]
        factory = importlib.import_module("uvloop").new_event_loop
    except ImportError:
        return None
    return factory


async def _serve(service: Service) -> None:
    image, given = service.image, service.given
    settings = settings_from(given["settings"])
    descriptors.allow(settings.connections + descriptors.SPARE)
    stopped = asyncio.Event()
    asyncio.get_running_loop().add_reader(service.stop_fd, stopped.set)
    with AuditLog(settings.audit) as audit:
        device = Device(
            image,
            [point_from(point) for point in given["points"]],
            settings.strict_holes,
            Identity(revision=version("plcsim"), project=image.directory.project),
            _status_reader(service.page, given["first_class"], image.layout_hash),
            audit,
        )
        server = Server(device, settings)
        await server.start(service.wake_fd)
        service.serving(
            f"serving {len(device.points)} tags on {endpoint(settings.host, server.port)}"
            f"{' with TLS' if settings.tls else ''}"
        )
        await stopped.wait()
        await server.stop()


def _status_reader(
    page: StatusPage, number: int, layout_hash: int
) -> Callable[[], ControllerStatus]:
    """Return what reads the status block's figures from the status page."""

    def read() -> ControllerStatus:
        figures = page.of_class(number)
        return ControllerStatus(
            page.state.value,
            figures.cycles,
            figures.execution_ns,
            figures.longest_execution_ns,
            figures.missed,
            layout_hash,
        )

    return read
