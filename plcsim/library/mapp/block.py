"""What blocks of mapp share: Enable makes them active, and wants an MpLink."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plcsim.library.mapp.errors import MPLINK_NULL
from plcsim.library.members import BlockVariables, StructMembers

if TYPE_CHECKING:
    from plcsim.core.context import Context
    from plcsim.library.members import FindType
    from st_types.types.derived import StructType


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

        Raises:
            PageFault: an address in it is wild.
        """
        variables = BlockVariables(self.context.memory, self._members, address)
        enable = variables.is_true("Enable")
        link = variables.address("MpLink")
        is_active = enable and link != 0
        status = MPLINK_NULL if enable and not link else 0
        variables.set(Active=is_active, Error=status != 0, StatusID=status)
        if is_active:
            self.call(address, variables, link)
        else:
            self.rest(address, variables)

    def call(self, address: int, variables: BlockVariables, link: int) -> None:
        """Run one call of an active block."""
        raise NotImplementedError(type(self).__name__)

    def rest(self, address: int, variables: BlockVariables) -> None:
        """Run one call of a block that is not active: outputs of commands are taken back."""
        variables.set(CommandDone=False, CommandBusy=False)
