"""Models of blocks that leave out calls which would change nothing.

Programs call all their blocks in each cycle, and most have nothing to do.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Generic, NamedTuple, TypeVar

from plcsim.library.block_model import BlockModel

if TYPE_CHECKING:
    from plcsim.core.context import Context
    from plcsim.library.members import BlockVariables

Subject = TypeVar("Subject")
"""What the blocks of a library are about, such as an axis."""


class _Settled(NamedTuple):
    """A block whose last call changed nothing.

    Attributes:
        data: its data block.
        place: what it named its subject with.
        seen: what else the call depended on.
    """

    data: bytes
    place: int
    seen: tuple[object, ...]


class _SettledBlocks:
    """Such blocks by their addresses; a restart forgets them."""

    def __init__(self, _context: Context) -> None:
        self.by_address: dict[int, _Settled] = {}


class SettlingBlock(BlockModel, Generic[Subject]):
    """Runs the blocks of one type on one controller.

    Attributes:
        settles: whether a call depends on nothing but the data block and what `look` gives, and
            changes nothing else.
    """

    settles: ClassVar[bool] = True

    def run(self, address: int) -> None:
        """Run the block whose data block lies at an address.

        A call that would do again what the last one did, which was nothing, is left out.

        Raises:
            PageFault: an address in it is wild.
        """
        memory = self.context.memory
        data = memory.read(address, self.data_type.size)
        settled = self.context.library(_SettledBlocks).by_address
        last = settled.get(address)
        if last is not None and last.data != data:
            last = None
        place = self.place(self.variables(address)) if last is None else last.place
        subject = self.find(place)
        before = self.look(address, subject)
        if last is not None and before == last.seen:
            return
        self.execute(address, self.variables(address), subject)
        is_same = data == memory.read(address, len(data))
        if self.settles and is_same and self.look(address, subject) == before:
            settled[address] = _Settled(data, place, before)
        else:
            settled.pop(address, None)

    def place(self, variables: BlockVariables) -> int:
        """Return the address that the data block names its subject with, 0 for none."""
        raise NotImplementedError(type(self).__name__)

    def find(self, place: int) -> Subject:
        """Return the subject as it is now."""
        raise NotImplementedError(type(self).__name__)

    def look(self, address: int, subject: Subject) -> tuple[object, ...]:
        """Return what a call depends on, and changes, beside the data block.

        Raises:
            PageFault: an address in the data block is wild.
        """
        raise NotImplementedError(type(self).__name__)

    def execute(self, address: int, variables: BlockVariables, subject: Subject) -> None:
        """Run one call."""
        raise NotImplementedError(type(self).__name__)
