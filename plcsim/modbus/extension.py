"""The extension of the table [modbus]: checks the map, hands it to the Modbus service."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from plcsim.modbus.map.automatic import write_lock
from plcsim.modbus.map.load import load_map
from plcsim.modbus.ports import may_use_privileged_ports, remedy, unprivileged_ports
from plcsim.modbus.settings import read_settings
from plcsim.project.extension import Attachment, Extension

if TYPE_CHECKING:
    from pathlib import Path

    from plcsim.core.controller import Controller
    from plcsim.modbus.settings import ModbusSettings
    from plcsim.settings.table import Table


class ModbusProject(NamedTuple):
    """The settings and the folder of the project they belong to.

    Attributes:
        settings: table [modbus].
        folder: of the project.
        is_in_process: nothing serves the map; nothing is written into the project.
    """

    settings: ModbusSettings
    folder: Path
    is_in_process: bool = False


class ModbusExtension(Extension):
    """Tags over Modbus TCP."""

    def read(self, table: Table) -> ModbusProject:
        """Return the settings."""
        return ModbusProject(read_settings(table), table.folder)

    def in_process(self, settings: ModbusProject, ip: str) -> ModbusProject:
        """Return the settings for where no service runs: the map is checked, no file is written."""
        return settings._replace(is_in_process=True)

    def service(self, _settings: ModbusProject) -> str:
        """Return the module that serves the map."""
        return "plcsim.modbus.service.process"

    def endpoint(self, settings: ModbusProject) -> str:
        """Return address and port."""
        host, port = settings.settings.host, settings.settings.port
        return f"{f'[{host}]' if ':' in host else host}:{port or 'any free port'}"

    def attach(self, settings: ModbusProject, controller: Controller) -> Attachment:
        """Return the map for the service; addresses given for the first time are locked.

        Where nothing serves it, the addresses may still change.
        """
        tag_map = load_map(settings.settings, settings.folder, controller.tags, controller.areas)
        if not tag_map.is_locked and not settings.is_in_process:
            write_lock(settings.folder, tag_map.lock)
        points = tag_map.points
        return Attachment(
            {
                "settings": settings.settings.to_json(),
                "points": [point.to_json() for point in points],
                "first_class": controller.classes[0].number,
            },
            [controller.tags.find(point.tag) for point in points],
        )

    def check(self, settings: ModbusProject, controller: Controller) -> list[str]:
        """Check the map against the tags, and the files of TLS; say where the port needs rights."""
        load_map(settings.settings, settings.folder, controller.tags, controller.areas)
        if settings.settings.tls is not None:
            # not at the top: the scan process has no use for ssl and pymodbus
            from plcsim.modbus.service.tls import server_context  # noqa: PLC0415

            server_context(settings.settings.tls)
        port = settings.settings.port
        if 0 < port < unprivileged_ports() and not may_use_privileged_ports():
            return [f"modbus.port: {remedy(port)}"]
        return []


EXTENSION = ModbusExtension()
