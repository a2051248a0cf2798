"""The configuration of a controller: values by interface and by what they are."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from plcsim.core.context import Context

MOST_INTERFACES: Final = 64
"""Interfaces whose values are kept."""


class Text(Enum):
    """What of an interface is a text, with its first value."""

    IP = "192.168.0.10"
    MASK = "255.255.255.0"
    GATEWAY = "192.168.0.1"
    BROADCAST = "192.168.0.255"


MAC: Final = bytes((2, 0, 0, 0, 0, 1))
"""A locally administered address."""


class ArConfiguration:
    """See the module.

    Attributes:
        host_name: of the controller.
        time_zone: number of its time zone.
    """

    def __init__(self, _context: Context) -> None:
        self._texts: dict[tuple[str, Text], str] = {}
        self._modes: dict[str, int] = {}
        self.host_name = "plcsim"
        self.time_zone = 0

    def text(self, interface: str, kind: Text) -> str:
        """Return a text of an interface."""
        return self._texts.get((interface, kind), kind.value)

    def set_text(self, interface: str, kind: Text, value: str) -> bool:
        """Set a text of an interface; return whether there was room for it."""
        key = (interface, kind)
        if key not in self._texts and len(self._texts) >= MOST_INTERFACES * len(Text):
            return False
        self._texts[key] = value
        return True

    def mode(self, interface: str) -> int:
        """Return where an interface has its address from."""
        return self._modes.get(interface, 0)

    def set_mode(self, interface: str, mode: int) -> bool:
        """Set it; return whether there was room for it."""
        if interface not in self._modes and len(self._modes) >= MOST_INTERFACES:
            return False
        self._modes[interface] = mode
        return True
