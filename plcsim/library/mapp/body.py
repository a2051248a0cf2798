"""Bodies of blocks and functions of mapp Services, for the catalogue."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.library.mapp import alarm_blocks, alarm_functions, recipe_blocks

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.core.context import Context
    from plcsim.library.mapp.block import MappBlock
    from plcsim.library.members import FindType
    from st_types.types.derived import DataBlockType

LANGUAGE: Final = "model"

_BLOCKS: Final[Mapping[str, type[MappBlock]]] = {
    **alarm_blocks.BLOCKS,
    **recipe_blocks.BLOCKS,
}
_FUNCTIONS: Final[Mapping[str, Callable[..., Any]]] = alarm_functions.FUNCTIONS


class MappBlockBody(NamedTuple):
    """The body of a block; see `plcsim.library.executable.Executable`.

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
        return _text(self.data_type.name)

    def bind(self, context: Context) -> Callable[[int], None]:
        """Return what runs the block on the data block at an address."""
        return _BLOCKS[self.data_type.name](self.data_type, context, self.find_type).run


class MappFunctionBody(NamedTuple):
    """The body of a function, likewise.

    Attributes:
        name: of the function.
    """

    name: str

    @property
    def language(self) -> str:
        """It is a model."""
        return LANGUAGE

    @property
    def text(self) -> str:
        """What it does, in words."""
        return _text(self.name)

    def bind(self, context: Context) -> Callable[..., Any]:
        """Return the function with its context."""
        return partial(_FUNCTIONS[self.name], context)


def _text(name: str) -> str:
    is_recipe = name in recipe_blocks.BLOCKS
    return "recipes of registered variables in files" if is_recipe else "the alarms of its core"


def mapp_block(data_type: DataBlockType[Any], find_type: FindType) -> MappBlockBody | None:
    """Return the body of a block, None for one that there is no model of."""
    return MappBlockBody(data_type, find_type) if data_type.name in _BLOCKS else None


def mapp_function(name: str) -> MappFunctionBody | None:
    """Return the body of a function, likewise."""
    return MappFunctionBody(name) if name in _FUNCTIONS else None
