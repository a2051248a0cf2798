"""The Modbus service process: ``python -m plcsim.modbus.service ORDER``.

ORDER is a `plcsim.project.extension.ServiceOrder` as JSON. The process ends when it is asked to or
when its supervisor ends; where it ends otherwise, the supervisor starts it again.
"""

from __future__ import annotations

import asyncio
import importlib
import json
import signal
import sys
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

from plcsim.core.errors import PlcError
from plcsim.host import descriptors, realtime
from plcsim.modbus.map.point import Point
from plcsim.modbus.map.status_block import ControllerStatus
from plcsim.modbus.service.audit import AuditLog
from plcsim.modbus.service.device import Device, Identity
from plcsim.modbus.service.listener import place
from plcsim.modbus.service.server import Server
from plcsim.modbus.settings import settings_from
from plcsim.project.extension import ServiceOrder
from plcsim.shared_image import ImageReader
from plcsim.shared_image.status_page import StatusPage

if TYPE_CHECKING:
    from collections.abc import Callable


def main() -> int:
    """Serve until asked to stop; return the exit code."""
    order = ServiceOrder(**json.loads(sys.argv[1]))
    realtime.die_with_parent(signal.SIGTERM)
    try:
        with asyncio.Runner(loop_factory=_loop_factory()) as runner:
            return runner.run(_serve(order))
    except PlcError as err:
        sys.stderr.write(f"plcsim: {err}\n")
        return 1


def _loop_factory() -> Callable[[], asyncio.AbstractEventLoop] | None:
    """Return uvloop's loop where it is installed (pip install plcsim[fast])."""
    try:
        factory: Callable[[], asyncio.AbstractEventLoop]
        factory = importlib.import_module("uvloop").new_event_loop
    except ImportError:
        return None
    return factory


async def _serve(order: ServiceOrder) -> int:
    image = ImageReader(order.image_fd, order.table)
    given: dict[str, Any] = image.directory.services[order.table]
    settings = settings_from(given["settings"])
    device = Device(
        image,
        [Point(**point) for point in given["points"]],
        settings.strict_holes,
        Identity(revision=version("plcsim"), project=image.directory.project),
        _status_reader(order, given["first_class"], image.layout_hash),
    )
    descriptors.allow(settings.connections + descriptors.SPARE)
    stopped = asyncio.Event()
    loop = asyncio.get_running_loop()
    for number in (signal.SIGTERM, signal.SIGINT):
        loop.add_signal_handler(number, stopped.set)
    with AuditLog(settings.audit) as audit:
        server = Server(device, settings, audit)
        await server.start(order.wake_fd)
        if not order.quiet:
            sys.stderr.write(
                f"modbus: serving {len(device.points)} tags on "
                f"{place(settings.host, server.port)}"
                f"{' with TLS' if settings.tls else ''}\n"
            )
        await stopped.wait()
        await server.stop()
    return 0


def _status_reader(
    order: ServiceOrder, number: int, layout_hash: int
) -> Callable[[], ControllerStatus]:
    """Return what reads the status block's figures from the status page."""
    page = StatusPage(order.status_fd)

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


if __name__ == "__main__":
    sys.exit(main())
