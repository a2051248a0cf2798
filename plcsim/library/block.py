"""What blocks with ``enable`` and ``status`` share.

Two forms of them stand on the controller. A synchronous block is done when its call is. An
asynchronous one answers ERR_FUB_BUSY first: it wants to be called again, with the same inputs,
until the status is another.
"""

from __future__ import annotations

from typing import Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.runtime import ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE, ERR_OK

IDLE: Final = 0
BUSY: Final = 1


class StatusError(Exception):
    """A block cannot do what it is asked for.

    Attributes:
        status: of the block.
    """

    def __init__(self, status: int) -> None:
        super().__init__(status)
        self.status = status


class SynchronousBlock(FunctionBlock):
    """Base of blocks that are done in the call; FALSE at enable gives ERR_FUB_ENABLE_FALSE."""

    __slots__ = ()

    enable: bool
    status: int

    def execute(self) -> None:
        """Run one call.

        Raises:
            PageFault: a pointer input is wild; nothing was done.
        """
        self.status = self.step() if self.enable else ERR_FUB_ENABLE_FALSE

    def step(self) -> int:
        """Do what the block does; return the status."""
        raise NotImplementedError(f"{type(self).__name__} has no step method.")


class ActingBlock(SynchronousBlock):
    """Base of blocks whose status is ERR_OK, or that of a `StatusError`."""

    __slots__ = ()

    def step(self) -> int:
        """Do what the block does; return the status."""
        try:
            self.act()
        except StatusError as refused:
            return refused.status
        return ERR_OK

    def act(self) -> None:
        """Do what the block does.

        Raises:
            StatusError: it cannot; with the status.
        """
        raise NotImplementedError(f"{type(self).__name__} has no act method.")


class AsynchronousBlock(SynchronousBlock):
    """Base of blocks that are BUSY in the first call and act in a later one.

    The second call acts, in the same cycle or in a later one: a program may call until the status
    changes. Once a block has given its status, the next call with enable TRUE starts it anew.
    """

    __slots__ = ()

    i_state: int
    i_result: int
    i_tmp: int

    def execute(self) -> None:
        """Run one call.

        Raises:
            PageFault: a pointer input is wild; nothing was done.
        """
        if not self.enable:
            self.status = ERR_FUB_ENABLE_FALSE
            self.i_state = IDLE
        elif self.i_state != BUSY:
            self.status = ERR_FUB_BUSY
            self.i_state = BUSY
        else:
            status = self.step()
            self.status = self.i_result = status
            self.i_state = BUSY if status == ERR_FUB_BUSY else IDLE
