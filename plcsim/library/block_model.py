"""What all models of blocks share: the data block, whose members they find by name."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plcsim.library.members import BlockVariables, StructMembers

if TYPE_CHECKING:
    from plcsim.core.context import Context
    from plcsim.library.members import FindType
    from st_types.types.derived import StructType


class BlockModel:
    """Runs the blocks of one type on one controller.

    Args:
        data_type: their data block.
        context: of the controller.
        find_type: finds the types of the library.

    Attributes:
        data_type: as above.
        context: as above.
    """

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        self.data_type = data_type
        self.context = context
        self._find_type = find_type
        self._members = StructMembers(data_type)

    def variables(self, address: int) -> BlockVariables:
        """Return the values of the data block at an address."""
        return BlockVariables(self.context.memory, self._members, address)

    def run(self, address: int) -> None:
        """Run the block whose data block lies at an address.

        Raises:
            PageFault: an address in it is wild.
        """
        raise NotImplementedError(type(self).__name__)
