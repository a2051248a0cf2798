"""Models of blocks with ``enable`` and ``status``; `plcsim.library.block` has those with bodies."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.library.block import StatusError
from plcsim.library.block_model import BlockModel
from plcsim.library.runtime import ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE

if TYPE_CHECKING:
    from plcsim.library.members import BlockVariables


class StatusBlock(BlockModel):
    """Runs the blocks of one type on one controller: each is done in its call."""

    def run(self, address: int) -> None:
        """Run the block whose data block lies at an address.

        Raises:
            PageFault: an address in it is wild.
        """
        variables = self.variables(address)
        if variables.is_true("enable"):
            try:
                status = self.step(variables)
            except StatusError as refused:
                status = refused.status
        else:
            self.rest(variables)
            status = ERR_FUB_ENABLE_FALSE
        variables.set(status=status)

    def step(self, variables: BlockVariables) -> int:
        """Run one call with enable TRUE; return the status.

        Raises:
            StatusError: it cannot; with the status.
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
