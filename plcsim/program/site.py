"""One controller as its programs find it: memory, global variables, libraries."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

from plcsim.core.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.core.context import Context
    from plcsim.core.memory import Memory
    from plcsim.core.tag import Tag
    from plcsim.library.catalogue import Catalogue
    from plcsim.machine import Machine
    from st_types.types.derived import StructType


class Site:
    """What programs are put on; blocks find it by `Site.of`.

    Args:
        context: of the controller; its memory takes the programs' variables.
        catalogue: libraries of the project.
        shared: the global variables, and the global constants, as one tag each.
        counts_instructions: those of compiled programs; for the virtual clock, where no other
            measure of time means anything, and nothing else ends an endless loop.

    Attributes:
        context: as above.
        catalogue: likewise.
        shared: likewise.
    """

    def __init__(
        self,
        context: Context,
        catalogue: Catalogue,
        shared: Sequence[Tag] = (),
        *,
        counts_instructions: bool = False,
    ) -> None:
        self.context = context
        self.catalogue = catalogue
        self.shared = tuple(shared)
        self._bound: dict[StructType[Any], Callable[[int], None]] = {}
        self._counts_instructions = counts_instructions
        context.give_settings(self)

    @staticmethod
    def of(context: Context) -> Site:
        """Return the site of a controller.

        Raises:
            RuntimeError: nobody has made one.
        """
        found = context.settings(Site)
        if found is None:
            raise RuntimeError("this controller was made without a site")
        return found

    @property
    def memory(self) -> Memory:
        """The PLC memory."""
        return self.context.memory

    @cached_property
    def machine(self) -> Machine:
        """What compiled programs run on; made when the first of them asks for it.

        Raises:
            MachineError: the host has no room for it.
        """
        from plcsim.machine import Machine  # noqa: PLC0415  # 20 ms that not every project needs

        return Machine(self.memory, fuel=self._counts_instructions)

    def block(self, data_type: StructType[Any]) -> Callable[[int], None]:
        """Return what runs a function block on the data block at an address.

        Raises:
            ConfigurationError: nothing executes this block.
        """
        if data_type not in self._bound:
            executable = self.catalogue.executable(data_type)
            if executable is None:
                raise ConfigurationError(no_body(data_type))
            self._bound[data_type] = executable.bind(self.context)
        return self._bound[data_type]


def no_body(data_type: StructType[Any]) -> str:
    """Return what is wrong with a block that nothing executes."""
    return f"FUNCTION_BLOCK {data_type.name} has no body: it is declared, and nothing executes it"
