"""The extensions of the project under test: attached as in the scan process, in one process."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from plcsim.project.extension import extensions, in_process, services_of
from plcsim.shared_image import ImageReader, ImageWriter
from plcsim.shared_image.layout import make_file
from plcsim.testing.errors import PlcTestError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.controller import Controller

__tracebackhide__ = True


class Extensions:
    """What plc.toml says beyond the controller itself, hooked into the controller under test.

    No service process is started; what it would read and write, the shared image, is there, and a
    client of the test, such as the fixture ``modbus``, takes the place of the service.

    Args:
        settings: by table.
        controller: under test, not booted.
        name: of the project.
        ip: of the controller on the virtual network, "" on the host's.
    """

    def __init__(
        self, settings: Mapping[str, Any], controller: Controller, name: str, ip: str
    ) -> None:
        self._fd = -1
        here = in_process(settings, ip)
        self._services = services_of(here)
        for table, given in here.items():
            if table not in self._services:
                extensions()[table].attach(given, controller)
        if self._services:
            self._share(controller, name)

    def _share(self, controller: Controller, name: str) -> None:
        """Lay out the shared image, which holds all variables, however many they are."""
        self._fd = make_file()
        services = dict.fromkeys(self._services)
        ImageWriter(self._fd, controller, project=name, services=services, exports=controller.areas)

    def image(self, table: str) -> ImageReader:
        """Return the shared image as the service of a table has it.

        Raises:
            PlcTestError: the project has no such service.
        """
        if table not in self._services:
            raise PlcTestError(f"the project has no table [{table}] in its plc.toml")
        return ImageReader(self._fd, table)

    def close(self) -> None:
        """Give the shared memory back; who has read it keeps what it has."""
        if self._fd >= 0:
            os.close(self._fd)
            self._fd = -1
