"""The table [modbus] of plc.toml; docs/modbus.md lists its keys."""

from __future__ import annotations

import ipaddress
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any, Final

from plcsim.modbus.map.point import ORDERS

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from plcsim.settings.table import Table

TAGS_FILE: Final = "tags.csv"
AUDIT_FILE: Final = ".plcsim/modbus-audit.jsonl"
MODBUS_PORT: Final = 502
SECURE_PORT: Final = 802
PERMISSIONS: Final = ("rw", "ro", "none")


@dataclass(frozen=True)
class TlsSettings:
    """Modbus/TCP Security: TLS with certificates on both sides, and what each role may do.

    Attributes:
        certificate: file of the server's certificate, PEM.
        key: file of its key, PEM.
        clients: file of the authorities that clients' certificates come from, PEM.
        roles: "rw", "ro" or "none" by role; empty lets every known client read and write.
    """

    certificate: str
    key: str
    clients: str
    roles: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class ModbusSettings:
    """What [modbus] says; paths are absolute.

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

    host: str = "127.0.0.1"
    port: int = MODBUS_PORT
    tags: str = ""
    auto: bool = False
    order: str = "ABCD"
    strict_holes: bool = False
    read_only: bool = False
    unit_ids: tuple[int, ...] = ()
    allow: tuple[str, ...] = ()
    connections: int = 64
    idle_ns: int = 60_000_000_000
    write_timeout_ns: int = 2_000_000_000
    audit: str = ""
    tls: TlsSettings | None = None

    def to_json(self) -> dict[str, Any]:
        """Return the settings as JSON's types."""
        return asdict(self)


def settings_from(values: Mapping[str, Any]) -> ModbusSettings:
    """Return the settings of `ModbusSettings.to_json`."""
    tls = values["tls"]
    lists = {name: tuple(values[name]) for name in ("unit_ids", "allow")}
    return ModbusSettings(**{**values, **lists, "tls": TlsSettings(**tls) if tls else None})


def read_settings(table: Table, folder: Path) -> ModbusSettings:
    """Return the settings of the table [modbus] of a project.

    Raises:
        ConfigurationError: a value is wrong; file and field are named.
    """
    folder = folder.resolve()
    tls = _read_tls(table, folder) if "tls" in table else None
    auto = table.take("auto", bool, False)  # noqa: FBT003  # the default of the key
    order = table.convert("order", "ABCD", _order)
    audit = table.take("audit", str, AUDIT_FILE)
    return ModbusSettings(
        host=table.convert("host", "127.0.0.1", _address),
        port=table.number("port", SECURE_PORT if tls else MODBUS_PORT, 0, 65535),
        tags=_tags_file(table, folder, auto=auto),
        auto=auto,
        order=order,
        strict_holes=table.take("strict_holes", bool, False),  # noqa: FBT003  # likewise
        read_only=table.take("read_only", bool, False),  # noqa: FBT003  # likewise
        unit_ids=_unit_ids(table),
        allow=_networks(table),
        connections=table.number("connections", 64, 1, 10_000),
        idle_ns=_positive_ns(table, "idle", 60_000_000_000),
        write_timeout_ns=_positive_ns(table, "write_timeout", 2_000_000_000),
        audit=str(folder / audit) if audit else "",
        tls=tls,
    )


def _tags_file(table: Table, folder: Path, *, auto: bool) -> str:
    named = "tags" in table
    file = folder / table.take("tags", str, TAGS_FILE)
    if file.is_file():
        return str(file)
    if named or not auto:
        raise table.error("tags", f"there is no file {file}; or give auto = true")
    return ""


def _order(text: str) -> str:
    if text not in ORDERS:
        raise ValueError(f"{text!r} is not one of {', '.join(ORDERS)}")
    return text


def _address(text: str) -> str:
    try:
        return str(ipaddress.ip_address(text))
    except ValueError:
        raise ValueError(f"{text!r} is not an IP address") from None


def _positive_ns(table: Table, key: str, default_ns: int) -> int:
    value_ns = table.duration_ns(key, default_ns)
    if value_ns <= 0:
        raise table.error(key, "must be above 0")
    return value_ns


def _unit_ids(table: Table) -> tuple[int, ...]:
    values = table.take("unit_ids", list, [])
    for value in values:
        if not isinstance(value, int) or isinstance(value, bool) or not 0 <= value <= 255:
            raise table.error("unit_ids", f"{value!r} is not a number from 0 to 255")
    return tuple(values)


def _networks(table: Table) -> tuple[str, ...]:
    networks = table.strings("allow")
    for network in networks:
        try:
            ipaddress.ip_network(network)
        except ValueError as err:
            raise table.error("allow", str(err)) from None
    return networks


def _read_tls(table: Table, folder: Path) -> TlsSettings:
    tls = table.table("tls")
    files = {}
    for key in ("certificate", "key", "clients"):
        name = tls.take(key, str, "")
        if not name or not (folder / name).is_file():
            raise tls.error(key, f"there is no file {name!r}" if name else "a file is needed")
        files[key] = str(folder / name)
    roles = tls.take("roles", dict, {})
    for role, permission in roles.items():
        if permission not in PERMISSIONS:
            raise tls.error(f"roles.{role}", f"{permission!r} is not one of rw, ro, none")
    tls.finish()
    return TlsSettings(**files, roles=roles)
