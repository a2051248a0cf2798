"""Table [library.AsTCP] of plc.toml: what B&R's documents that we know leave open."""

from __future__ import annotations

from typing import Annotated, Final

from plcsim.library.astcp.interface import (
    tcpERR_INVALID,
    tcpERR_INVALID_IDENT,
    tcpERR_NOT_CONNECTED,
)
from plcsim.settings import Duration, OneOf, Whole, settings

MOST_IDENTS: Final = 65_535
LONGEST_TIMEOUT_NS: Final = 3_600_000_000_000


@settings
class AsTcpSettings:
    """Settings of the library; docs/decisions/0003-astcp-open-questions.md gives the reasons.

    Attributes:
        idents: sockets that can be open at once.
        connect_timeout_ns: nanoseconds after which TcpClient gives up with tcpERR_INVALID,
            counted in releases of the task class; 0 leaves it to the network.
        closed_while_busy: status of a block whose ident was closed while it was BUSY.
    """

    idents: Annotated[int, Whole(1, MOST_IDENTS)] = 128
    connect_timeout_ns: Annotated[int, Duration(maximum_ns=LONGEST_TIMEOUT_NS)] = 0
    closed_while_busy: Annotated[
        int, OneOf(tcpERR_INVALID_IDENT, tcpERR_INVALID, tcpERR_NOT_CONNECTED)
    ] = tcpERR_INVALID_IDENT
