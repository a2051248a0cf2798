"""Table [library.AsUDP] of plc.toml."""

from __future__ import annotations

from typing import Annotated, Final

from plcsim.settings import Whole, settings

MOST_IDENTS: Final = 65_535


@settings
class AsUdpSettings:
    """Settings of the library.

    Attributes:
        idents: sockets that can be open at once.
    """

    idents: Annotated[int, Whole(1, MOST_IDENTS)] = 128
