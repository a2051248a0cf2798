"""The table [opcua] of plc.toml; docs/guide/opcua.md lists its keys."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal, NamedTuple

from plcsim.settings import Duration, IpAddress, Whole, settings

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from plcsim.settings import Table

OPCUA_PORT: Final = 4840
"""opc.tcp, IANA."""


@settings
class OpcuaSettings:
    """What [opcua] says.

    Attributes:
        host: address to listen on.
        port: of TCP, 0 for any free one.
        tags: paths, or patterns such as ``conveyor.*``, of what is served; empty for all.
        read_only: nothing can be written.
        security: the least that a client must use: "none", "sign", or "encrypt" (sign and encrypt).
        anonymous: where the project has users, clients may look without being one.
        trusted: folder with the certificates of clients (DER or PEM), "" to take any.
        sampling_ns: how often monitored tags are looked at.
        nodes: most variables in the address space.
        connections: at once.
        write_timeout_ns: a write that the scan has not shown by then is answered BadTimeout.
    """

    host: Annotated[str, IpAddress()] = "127.0.0.1"
    port: Annotated[int, Whole(0, 65535)] = OPCUA_PORT
    tags: tuple[str, ...] = ()
    read_only: bool = False
    security: Literal["none", "sign", "encrypt"] = "none"
    anonymous: bool = False
    trusted: str = ""
    sampling_ns: Annotated[int, Duration(minimum_ns=1_000_000)] = 50_000_000
    nodes: Annotated[int, Whole(1, 1_000_000)] = 50_000
    connections: Annotated[int, Whole(1, 1000)] = 64
    write_timeout_ns: Annotated[int, Duration(minimum_ns=1)] = 2_000_000_000

    @property
    def endpoint(self) -> str:
        """Address and port as a client is given them."""
        host = f"[{self.host}]" if ":" in self.host else self.host
        return f"opc.tcp://{host}:{self.port or '(any free port)'}"

    def to_json(self) -> dict[str, Any]:
        """Return the settings as JSON's types."""
        return asdict(self)


class OpcuaProject(NamedTuple):
    """The settings and the folder of the project they belong to."""

    settings: OpcuaSettings
    folder: Path


def settings_from(values: Mapping[str, Any]) -> OpcuaSettings:
    """Return the settings of `OpcuaSettings.to_json`."""
    return OpcuaSettings(**{**values, "tags": tuple(values["tags"])})


def read_settings(table: Table) -> OpcuaProject:
    """Return the settings of the table [opcua] of a project.

    Raises:
        ConfigurationError: values are wrong; file and field of each are named.
    """
    made = table.read(OpcuaSettings)
    folder = table.folder.resolve()
    if made.trusted and not (folder / made.trusted).is_dir():
        raise table.error("trusted", f"there is no folder {folder / made.trusted}")
    return OpcuaProject(made, folder)
