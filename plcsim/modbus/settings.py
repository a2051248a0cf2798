"""The table [modbus] of plc.toml; docs/modbus.md lists its keys."""

from __future__ import annotations

import ipaddress
from collections.abc import Mapping
from dataclasses import asdict, field, replace
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal

from plcsim.settings import Converted, Duration, IpAddress, SettingKind, Whole, settings
from plcsim.settings.kinds import PathTo

if TYPE_CHECKING:
    from pathlib import Path

    from plcsim.settings import Table

TAGS_FILE: Final = "tags.csv"
AUDIT_FILE: Final = ".plcsim/modbus-audit.jsonl"
MODBUS_PORT: Final = 502
SECURE_PORT: Final = 802


class _File(SettingKind):
    """A file that must be there, as text: settings go to the service as JSON."""

    def convert(self, value: object, folder: Path) -> str:
        """Return the path."""
        return str(PathTo("file").convert(value, folder.resolve()))


def _network(text: str) -> str:
    return str(ipaddress.ip_network(text))


@settings
class TlsSettings:
    """Modbus/TCP Security: TLS with certificates on both sides, and what each role may do.

    Attributes:
        certificate: file of the server's certificate, PEM.
        key: file of its key, PEM.
        clients: file of the authorities that clients' certificates come from, PEM.
        roles: "rw", "ro" or "none" by role; empty lets every known client read and write.
    """

    certificate: Annotated[str, _File()]
    key: Annotated[str, _File()]
    clients: Annotated[str, _File()]
    roles: Mapping[str, Literal["rw", "ro", "none"]] = field(default_factory=dict)


@settings
class ModbusSettings:
    """What [modbus] says; `read_settings` makes the paths absolute.

    Attributes:
        host: address to listen on.
        port: of TCP, 0 for any free one.
        tags: file of the map, "" where there is none.
        auto: variables that the file does not name get addresses of their own.
        order: word order of tags that give none.
        strict_holes: a read that touches an address without a tag is refused.
        read_only: no function that writes is there.
        unit_ids: those answered; empty for all.
        allow: networks that may connect; empty for all.
        connections: at once.
        idle_ns: a connection without a complete request for so long is closed.
        write_timeout_ns: a write that the scan has not shown by then is answered "busy".
        audit: file that every write is noted in, "" for none.
        tls: None for plain TCP.
    """

    host: Annotated[str, IpAddress()] = "127.0.0.1"
    port: Annotated[int, Whole(0, 65535)] = MODBUS_PORT
    tags: str = ""
    auto: bool = False
    order: Literal["ABCD", "CDAB", "BADC", "DCBA"] = "ABCD"
    strict_holes: bool = False
    read_only: bool = False
    unit_ids: tuple[Annotated[int, Whole(0, 255)], ...] = ()
    allow: tuple[Annotated[str, Converted(_network)], ...] = ()
    connections: Annotated[int, Whole(1, 10_000)] = 64
    idle_ns: Annotated[int, Duration(minimum_ns=1)] = 60_000_000_000
    write_timeout_ns: Annotated[int, Duration(minimum_ns=1)] = 2_000_000_000
    audit: str = AUDIT_FILE
    tls: TlsSettings | None = None

    def to_json(self) -> dict[str, Any]:
        """Return the settings as JSON's types."""
        return asdict(self)


def settings_from(values: Mapping[str, Any]) -> ModbusSettings:
    """Return the settings of `ModbusSettings.to_json`."""
    tls = values["tls"]
    lists = {name: tuple(values[name]) for name in ("unit_ids", "allow")}
    return ModbusSettings(**{**values, **lists, "tls": TlsSettings(**tls) if tls else None})


def read_settings(table: Table) -> ModbusSettings:
    """Return the settings of the table [modbus] of a project.

    Raises:
        ConfigurationError: values are wrong; file and field of each are named.
    """
    folder = table.folder.resolve()
    has_port = "port" in table
    made = table.read(ModbusSettings)
    return replace(
        made,
        port=SECURE_PORT if made.tls and not has_port else made.port,
        tags=_tags_file(table, folder, made),
        audit=str(folder / made.audit) if made.audit else "",
    )


def _tags_file(table: Table, folder: Path, made: ModbusSettings) -> str:
    file = folder / (made.tags or TAGS_FILE)
    if file.is_file():
        return str(file)
    if made.tags or not made.auto:
        raise table.error("tags", f"there is no file {file}; or give auto = true")
    return ""
