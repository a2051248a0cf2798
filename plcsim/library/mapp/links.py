"""Which core of alarms an MpLink leads to.

Programs hand over the variable that the configuration makes, or a copy of it: its content, which
is the vendor's own, is here the address of that variable.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.controller import Controller
from plcsim.library.mapp.alarms import AlarmCore
from plcsim.library.mapp.configuration import AlarmCoreConfiguration, MappConfiguration

if TYPE_CHECKING:
    from collections.abc import Iterator

    from plcsim.core.context import Context

NO_CONFIGURATION: Final = AlarmCoreConfiguration()


class AlarmLinks:
    """The cores of alarms of a controller.

    Args:
        context: of the controller.
    """

    def __init__(self, context: Context) -> None:
        self._context = context
        self._memory = context.memory
        self._cores: dict[int, AlarmCore] = {}
        configuration = context.settings(MappConfiguration) or MappConfiguration()
        controller = Controller.of(context)
        for name, core in configuration.cores.items():
            tag = None if controller is None else controller.tags.get(f"::{name}")
            if tag is not None:
                self._add(tag.address, core)
        self._is_configured = bool(self._cores)

    def _add(self, address: int, configuration: AlarmCoreConfiguration) -> AlarmCore:
        self._memory.write(address, address.to_bytes(4, "little"))
        core = self._cores[address] = AlarmCore(configuration, lambda: self._context.date_ns)
        return core

    def __iter__(self) -> Iterator[AlarmCore]:
        """Iterate over all of them."""
        return iter(self._cores.values())

    def at(self, address: int) -> AlarmCore | None:
        """Return the core that the MpLink at an address leads to, None for address 0.

        What is no core itself belongs to the first one; where the configuration has none, each
        MpLink is one.

        Raises:
            PageFault: the address is wild.
        """
        if not address:
            return None
        found = self._cores.get(address)
        if found is None:
            content = int.from_bytes(self._memory.read(address, 4), "little")
            found = self._cores.get(content)
        if found is None:
            cores = iter(self._cores.values())
            found = next(cores) if self._is_configured else self._add(address, NO_CONFIGURATION)
        return found


def links_of(context: Context) -> AlarmLinks:
    """Return the cores of a controller."""
    return context.library(AlarmLinks)
