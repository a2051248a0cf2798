"""Bodies of blocks that move the model of an axis, for the catalogue."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.library.motion import assembly, mapp, plcopen

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.core.context import Context
    from plcsim.library.members import FindType
    from plcsim.library.motion.block import MotionBlock
    from st_types.types.derived import DataBlockType

LANGUAGE: Final = "model"

_BLOCKS: Final[Mapping[str, type[MotionBlock]]] = {
    **plcopen.BLOCKS,
    **mapp.BLOCKS,
    **assembly.BLOCKS,
}


class MotionBody(NamedTuple):
    """The body of a block that knows an axis; see `plcsim.library.executable.Executable`.

    Attributes:
        data_type: of its data block.
        find_type: finds the types of its library.
    """

    data_type: DataBlockType[Any]
    find_type: FindType

    @property
    def language(self) -> str:
        """It is a model."""
        return LANGUAGE

    @property
    def text(self) -> str:
        """What it does, in words."""
        return "an axis with trapezoidal profile"

    def bind(self, context: Context) -> Callable[[int], None]:
        """Return what runs the block on the data block at an address."""
        return _BLOCKS[self.data_type.name](self.data_type, context, self.find_type).run


def motion_body(data_type: DataBlockType[Any], find_type: FindType) -> MotionBody | None:
    """Return the body of a block that knows an axis, None for any other block."""
    return MotionBody(data_type, find_type) if data_type.name in _BLOCKS else None
