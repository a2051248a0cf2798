"""Blocks of mapp with commands: taken at their edges, done one call later."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from plcsim.library.mapp.block import MappBlock
from plcsim.library.mapp.errors import is_error
from plcsim.library.members import rises

if TYPE_CHECKING:
    from plcsim.core.context import Context
    from plcsim.library.members import BlockVariables


class _Command:
    """The command of a block.

    Attributes:
        running: its name, "" for none.
        status: of the last one.
        is_done: whether that was done.
    """

    def __init__(self) -> None:
        self.running = ""
        self.status = 0
        self.is_done = False


class _Commands:
    """The commands of blocks by their addresses; a restart forgets them."""

    def __init__(self, _context: Context) -> None:
        self.by_block: dict[int, _Command] = {}


class CommandBlock(MappBlock):
    """A block with commands: CommandBusy in the call that takes one, then CommandDone or Error.

    CommandDone stays while a command is TRUE, Error until ErrorReset or until Enable is FALSE; no
    command is taken meanwhile.

    Attributes:
        commands: the names of the inputs.
    """

    commands: ClassVar[tuple[str, ...]] = ()

    def call(self, address: int, variables: BlockVariables, link: int) -> None:
        """Take a command, or do the one that was taken."""
        command = self.context.library(_Commands).by_block.setdefault(address, _Command())
        if rises(self.context, address, variables, "ErrorReset"):
            command.status = 0
        if command.running:
            command.status = self.do(command.running, address, variables, link)
            command.running, command.is_done = "", not is_error(command.status)
        edges = [name for name in self.commands if rises(self.context, address, variables, name)]
        if edges and not is_error(command.status):
            command.running, command.status, command.is_done = edges[0], 0, False
        command.is_done &= any(map(variables.is_true, self.commands))
        variables.set(
            CommandBusy=command.running != "",
            CommandDone=command.is_done,
            Error=is_error(command.status),
            StatusID=command.status,
        )

    def running(self, variables: BlockVariables) -> str:
        """Return the name of the command that was taken and is not yet done, "" for none."""
        command = self.context.library(_Commands).by_block.get(variables.start)
        return "" if command is None else command.running

    def do(self, name: str, address: int, variables: BlockVariables, link: int) -> int:
        """Do a command; return its status."""
        raise NotImplementedError(type(self).__name__)

    def rest(self, address: int, variables: BlockVariables) -> None:
        """Forget the command and its error."""
        super().rest(address, variables)
        self.context.library(_Commands).by_block.pop(address, None)
