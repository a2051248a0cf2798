"""The shared image of the controller under test, where its project has services."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from plcsim.project.assembly import ImageFile
from plcsim.project.extension import services_of
from plcsim.shared_image import ImageReader
from plcsim.shared_image.layout import make_file
from plcsim.testing.errors import PlcTestError

if TYPE_CHECKING:
    from collections.abc import Mapping

__tracebackhide__ = True


class SharedImage:
    """What the services of a project would read and write.

    No service process is started; a client of the test, such as the fixture ``modbus``, takes its
    place.

    Args:
        settings: of the extensions in a test, by table.
    """

    def __init__(self, settings: Mapping[str, Any]) -> None:
        self._services = services_of(settings)
        self._fd = make_file() if self._services else -1

    @property
    def of_controller(self) -> ImageFile | None:
        """The image for the controller to lay out, None where nobody reads it."""
        return ImageFile(self._fd) if self._services else None

    def reader(self, table: str) -> ImageReader:
        """Return the image as the service of a table has it.

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
