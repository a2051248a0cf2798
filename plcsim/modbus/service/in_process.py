"""Modbus without a network, for virtual time: the same handler and connections as in the service.

No time passes while nobody asks: `VirtualServer.exchange` runs the scan only where a write waits
for it.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from plcsim.core.system import State
from plcsim.modbus.service.connection import Connection, Limits
from plcsim.modbus.service.device import Device
from plcsim.modbus.service.handler import Handler, Rights
from plcsim.shared_image import ImageReader, ImageWriter
from plcsim.shared_image.layout import make_file

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.core.controller import Controller
    from plcsim.modbus.map.point import Point

SERVICE = "modbus"


class VirtualServer:
    """Serves a controller in its own process; to be made before the controller's boot.

    Args:
        controller: on a virtual clock.
        points: the map.
        limits: settings of all connections.
        strict_holes: see `plcsim.modbus.map.reading.Reads`.

    Attributes:
        device: what is served.
    """

    def __init__(
        self,
        controller: Controller,
        points: Sequence[Point],
        limits: Limits | None = None,
        *,
        strict_holes: bool = False,
    ) -> None:
        self._controller = controller
        self._limits = limits or Limits()
        self._fd = make_file()
        tags = [controller.tags.find(point.tag) for point in points]
        ImageWriter(self._fd, controller, project="virtual", services={SERVICE: None}, exports=tags)
        self.device = Device(ImageReader(self._fd, SERVICE), points, strict_holes)

    def connect(self, rights: Rights | None = None) -> Connection:
        """Return a new connection."""
        handler = Handler(self.device, rights or Rights())
        return Connection(handler, self.device, self._limits, self._controller.clock.now_ns())

    def exchange(self, connection: Connection, data: bytes) -> bytes:
        """Hand requests over and return the answers; the scan runs while writes wait for it."""
        connection.receive(data)
        answers = [self._step(connection)]
        while connection.is_waiting or connection.has_more:
            if connection.is_waiting and self._controller.run(cycles=1) is not State.RUN:
                self.device.is_alive = False
            answers.append(self._step(connection))
        return b"".join(answers)

    def _step(self, connection: Connection) -> bytes:
        return connection.step(self._controller.clock.now_ns())

    def close(self) -> None:
        """Give the shared memory back."""
        os.close(self._fd)
