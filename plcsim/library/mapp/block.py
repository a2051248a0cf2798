"""What blocks of mapp share: Enable makes them active, and wants an MpLink."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.library.mapp.errors import MPLINK_NULL
from plcsim.library.settling import SettlingBlock

if TYPE_CHECKING:
    from plcsim.library.members import BlockVariables


class MappBlock(SettlingBlock[int]):
    """Runs the blocks of one type on one controller; they are about what their MpLink leads to."""

    def place(self, variables: BlockVariables) -> int:
        """Return the MpLink, 0 where the block is not enabled."""
        return variables.address("MpLink") if variables.is_true("Enable") else 0

    def find(self, place: int) -> int:
        """Return the same."""
        return place

    def look(self, address: int, subject: int) -> tuple[object, ...]:
        """Return what a call depends on, and changes, beside the data block."""
        return self.seen(self.variables(address), subject) if subject else ()

    def execute(self, address: int, variables: BlockVariables, subject: int) -> None:
        """Run one call; the link is 0 where it is not enabled."""
        status = MPLINK_NULL if not subject and variables.is_true("Enable") else 0
        variables.set(Active=subject != 0, Error=status != 0, StatusID=status)
        if subject:
            self.call(address, variables, subject)
        else:
            self.rest(address, variables)

    def seen(self, variables: BlockVariables, link: int) -> tuple[object, ...]:
        """Return what a call of an active block depends on, and changes, beside the data block.

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
