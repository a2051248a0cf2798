"""Settings: from a table of a file to an object, by what its class declares.

A class of settings stands for one table. Each attribute is a key: its type says what a value must
be, what stands beside the type in ``Annotated`` bounds or converts it, its default is the value
where the key is missing; an attribute without one must be given::

    @settings
    class ModbusSettings:
        host: Annotated[str, IpAddress()] = "127.0.0.1"
        port: Annotated[int, Whole(0, 65535)] = 502
        idle_ns: Annotated[int, Duration(minimum_ns=1)] = 60_000_000_000  # key "idle"
        order: Literal["ABCD", "CDAB"] = "ABCD"
        unit_ids: tuple[Annotated[int, Whole(0, 255)], ...] = ()
        audit: Annotated[Path, PathTo()] = Path()
        hosts: Mapping[str, str] = field(default_factory=dict)  # a table with free keys
        tls: TlsSettings | None = None  # a table inside this one

`Table.read` makes the object, or tells everything that is wrong, each with file, table and key.
What no declaration can say (one key that depends on another) its owner checks afterwards, with
`Table.error` for the same form of message.

Types that can be declared: bool, int, float, str, Path, Literal, Enum (by value), another class of
settings, ``tuple[X, ...]`` (a list), ``Mapping[str, X]`` (a table with free keys), ``X | None``
(None where it is missing), Any.
"""

from plcsim.settings.declaration import is_settings, settings
from plcsim.settings.kinds import (
    Converted,
    Duration,
    IpAddress,
    Key,
    OneOf,
    PathTo,
    SettingKind,
    Size,
    Whole,
    is_loopback,
)
from plcsim.settings.table import Table

__all__ = [
    "Converted",
    "Duration",
    "IpAddress",
    "Key",
    "OneOf",
    "PathTo",
    "SettingKind",
    "Size",
    "Table",
    "Whole",
    "is_loopback",
    "is_settings",
    "settings",
]
