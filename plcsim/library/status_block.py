"""Models of blocks with ``enable`` and ``status``; `plcsim.library.block` has those with bodies."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plcsim.library.members import BlockVariables, StructMembers
from plcsim.library.runtime import ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE

if TYPE_CHECKING:
    from plcsim.core.context import Context
    from plcsim.library.members import FindType
    from st_types.types.derived import StructType


class StatusBlock:
    """Runs the blocks of one type on one controller: each is done in its call.

    Args:
        data_type: their data block.
        context: of the controller.
        find_type: finds the types of the library.

    Attributes:
        context: as above.
    """

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        self.context = context
        self._find_type = find_type
        self._members = StructMembers(data_type)

    def run(self, address: int) -> None:
        """Run the block whose data block lies at an address.

        Raises:
            PageFault: an address in it is wild.
        """
        variables = BlockVariables(self.context.memory, self._members, address)
        if variables.is_true("enable"):
            variables.set(status=self.step(variables))
        else:
            self.rest(variables)
            variables.set(status=ERR_FUB_ENABLE_FALSE)

    def step(self, variables: BlockVariables) -> int:
        """Run one call with enable TRUE; return the status.

        Raises:
            PageFault: an address in the data block is wild.
        """
        raise NotImplementedError(type(self).__name__)

    def rest(self, variables: BlockVariables) -> None:
        """Run one call with enable FALSE: for most, nothing."""


class DelayedBlock(StatusBlock):
    """Blocks that are BUSY in one call and act in the next; then the next call starts anew."""

    def step(self, variables: BlockVariables) -> int:
        """Begin, or act."""
        is_begun = variables.number("status") == ERR_FUB_BUSY
        return self.act(variables) if is_begun else ERR_FUB_BUSY

    def act(self, variables: BlockVariables) -> int:
        """Do what the block is for; return the status.

        Raises:
            PageFault: an address in the data block is wild.
        """
        raise NotImplementedError(type(self).__name__)
