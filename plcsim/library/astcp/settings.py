"""Table [library.AsTCP] of plc.toml: what B&R's documents that we know leave open."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from plcsim.core.duration import parse_duration_ns
from plcsim.core.errors import ConfigurationError
from plcsim.library.astcp.constants import (
    tcpERR_INVALID,
    tcpERR_INVALID_IDENT,
    tcpERR_NOT_CONNECTED,
)

if TYPE_CHECKING:
    from collections.abc import Mapping

MOST_IDENTS: Final = 65_535
LONGEST_TIMEOUT_NS: Final = 3_600_000_000_000


@dataclass(frozen=True)
class Settings:
    """Settings of the library; docs/decisions/0003-astcp-open-questions.md gives the reasons.

    Attributes:
        idents: sockets that can be open at once, 1..65535.
        connect_timeout_ns: nanoseconds after which TcpClient gives up with tcpERR_INVALID,
            counted in releases of the task class; 0 leaves it to the network.
        closed_while_busy: status of a block whose ident was closed while it was BUSY.
    """

    idents: int = 128
    connect_timeout_ns: int = 0
    closed_while_busy: int = tcpERR_INVALID_IDENT

    @classmethod
    def read(cls, options: Mapping[str, object]) -> Settings:
        """Read the table; its keys are ``idents``, ``connect_timeout``, ``closed_while_busy``.

        Raises:
            ConfigurationError: an unknown key or a wrong value; names the field.
        """
        known = {
            "idents": _idents,
            "connect_timeout": _connect_timeout,
            "closed_while_busy": _closed_while_busy,
        }
        for key in options.keys() - known:
            raise ConfigurationError(f"library.AsTCP.{key}: unknown; there are {', '.join(known)}")
        values = {key: known[key](value) for key, value in options.items()}
        return cls(
            values.get("idents", cls.idents),
            values.get("connect_timeout", cls.connect_timeout_ns),
            values.get("closed_while_busy", cls.closed_while_busy),
        )


def _idents(value: object) -> int:
    if type(value) is int and 1 <= value <= MOST_IDENTS:
        return value
    raise ConfigurationError(f"library.AsTCP.idents: {value!r} is not in 1..{MOST_IDENTS}")


def _connect_timeout(value: object) -> int:
    try:
        timeout_ns = parse_duration_ns(str(value))
    except ValueError as error:
        raise ConfigurationError(f"library.AsTCP.connect_timeout: {error}") from None
    if timeout_ns > LONGEST_TIMEOUT_NS:
        raise ConfigurationError(f"library.AsTCP.connect_timeout: {value} is more than 1 h")
    return timeout_ns


def _closed_while_busy(value: object) -> int:
    choices = (tcpERR_INVALID_IDENT, tcpERR_INVALID, tcpERR_NOT_CONNECTED)
    if type(value) is int and value in choices:
        return value
    raise ConfigurationError(f"library.AsTCP.closed_while_busy: {value!r} is not one of {choices}")
