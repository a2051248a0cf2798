"""What blocks of mapp share: Enable makes them active, and wants an MpLink."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from plcsim.library.mapp.errors import MPLINK_NULL
from plcsim.library.members import BlockVariables, StructMembers

if TYPE_CHECKING:
    from plcsim.core.context import Context
    from plcsim.library.members import FindType
    from st_types.types.derived import StructType


class _Settled(NamedTuple):
    """A block whose last call changed nothing.

    Attributes:
        data: its data block.
        link: its MpLink, 0 where it was not enabled.
        seen: what else the call depended on.
    """

    data: bytes
    link: int
    seen: tuple[object, ...]


class _SettledBlocks:
    """Such blocks by their addresses; a restart forgets them."""

    def __init__(self, _context: Context) -> None:
        self.by_address: dict[int, _Settled] = {}


class MappBlock:
    """Runs the blocks of one type on one controller.

    Args:
        data_type: their data block.
        context: of the controller.
        find_type: finds the types of the library.

    Attributes:
        data_type: as above.
        context: as above.
        find_type: as above.
    """

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        self.data_type = data_type
        self.context = context
        self.find_type = find_type
        self._members = StructMembers(data_type)

    def run(self, address: int) -> None:
        """Run the block whose data block lies at an address.

        A call that would do again what the last one did, which was nothing, is left out.

        Raises:
            PageFault: an address in it is wild.
        """
        memory = self.context.memory
        data = memory.read(address, self.data_type.size)
        variables = BlockVariables(memory, self._members, address)
        settled = self.context.library(_SettledBlocks).by_address
        last = settled.get(address)
        if last is not None and last.data == data and self._seen(variables, last.link) == last.seen:
            return
        link = variables.address("MpLink") if variables.is_true("Enable") else 0
        before = self._seen(variables, link)
        self._call(address, variables, link)
        is_same = data == memory.read(address, len(data))
        if is_same and self._seen(variables, link) == before:
            settled[address] = _Settled(data, link, before)
        else:
            settled.pop(address, None)

    def _call(self, address: int, variables: BlockVariables, link: int) -> None:
        """Run one call; the link is 0 where it is not enabled."""
        status = MPLINK_NULL if not link and variables.is_true("Enable") else 0
        variables.set(Active=link != 0, Error=status != 0, StatusID=status)
        if link:
            self.call(address, variables, link)
        else:
            self.rest(address, variables)

    def _seen(self, variables: BlockVariables, link: int) -> tuple[object, ...]:
        return self.seen(variables, link) if link else ()

    def seen(self, variables: BlockVariables, link: int) -> tuple[object, ...]:
        """Return what a call depends on, and changes, beside the data block.

        Raises:
            PageFault: an address in the data block is wild.
        """
        raise NotImplementedError(type(self).__name__)

    def call(self, address: int, variables: BlockVariables, link: int) -> None:
        """Run one call of an active block."""
        raise NotImplementedError(type(self).__name__)

    def rest(self, address: int, variables: BlockVariables) -> None:
        """Run one call of a block that is not active: outputs of commands are taken back."""
        variables.set(CommandDone=False, CommandBusy=False)
