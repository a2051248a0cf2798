"""Models of what vendors bring compiled: bodies that work on whatever version is declared.

They find the members of a data block by name, for versions of a library differ in them.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.library.accounts import blocks as account_blocks
from plcsim.library.archives import blocks as archive_blocks
from plcsim.library.bus import objects
from plcsim.library.http import client, texts
from plcsim.library.loops import pid, positions, signals, technology, temperature
from plcsim.library.mapp import (
    alarm_blocks,
    alarm_functions,
    file_blocks,
    history_blocks,
    oee_blocks,
    packml_blocks,
    recipe_blocks,
    temperature_blocks,
    user_blocks,
)
from plcsim.library.motion import assembly, cyclic, drive_parameters, mapp, plcopen

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.core.context import Context
    from plcsim.library.block_model import BlockModel
    from plcsim.library.members import FindType
    from st_types.types.derived import DataBlockType

LANGUAGE: Final = "model"


_AXIS: Final = "an axis with trapezoidal profile"
_DRIVE: Final = "parameters of a drive, read back as they were written"
_BUS: Final = "registers and objects of devices, read back as they were written"
_HTTP: Final = "requests over the controller's network, without TLS"
_TEXTS: Final = "conversions of texts"
_ALARMS: Final = "the alarms of its core"
_HISTORY: Final = "the changes of alarms of all cores"
_USERS: Final = "any name logs in, with all rights"
_ACCOUNTS: Final = "users that programs make"
_FILES: Final = "files on the devices of FileIO"
_ARCHIVES: Final = "archives on the devices of FileIO"
_RECIPES: Final = "recipes of registered variables in files"
_PACKML: Final = "the states of PackML"
_TEMPERATURE: Final = "heats below the set temperature, and cools above it"
_OEE: Final = "availability, performance and quality since Enable"
_POSITIONS: Final = "positions along a trapezoidal profile"
_LOOPS: Final = "the common formulas of closed loops"

_GROUPS: Final[tuple[tuple[Mapping[str, type[BlockModel]], str], ...]] = (
    (plcopen.BLOCKS, _AXIS),
    (cyclic.BLOCKS, _AXIS),
    (mapp.BLOCKS, _AXIS),
    (assembly.BLOCKS, _AXIS),
    (drive_parameters.BLOCKS, _DRIVE),
    (objects.BLOCKS, _BUS),
    (client.BLOCKS, _HTTP),
    (texts.BLOCKS, _TEXTS),
    (alarm_blocks.BLOCKS, _ALARMS),
    (history_blocks.BLOCKS, _HISTORY),
    (recipe_blocks.BLOCKS, _RECIPES),
    (user_blocks.BLOCKS, _USERS),
    (file_blocks.BLOCKS, _FILES),
    (archive_blocks.BLOCKS, _ARCHIVES),
    (account_blocks.BLOCKS, _ACCOUNTS),
    (packml_blocks.BLOCKS, _PACKML),
    (temperature_blocks.BLOCKS, _TEMPERATURE),
    (temperature.BLOCKS, _TEMPERATURE),
    (oee_blocks.BLOCKS, _OEE),
    (positions.BLOCKS, _POSITIONS),
    (signals.BLOCKS, _LOOPS),
    (pid.BLOCKS, _LOOPS),
    (technology.BLOCKS, _LOOPS),
)
"""What runs the blocks by their names, and what they do, in words."""

_BLOCKS: Final = {name: (model, text) for group, text in _GROUPS for name, model in group.items()}
_FUNCTIONS: Final[Mapping[str, tuple[Callable[..., Any], str]]] = {
    name: (function, text)
    for group, text in (
        (alarm_functions.FUNCTIONS, _ALARMS),
        (history_blocks.FUNCTIONS, _HISTORY),
        (packml_blocks.FUNCTIONS, _PACKML),
    )
    for name, function in group.items()
}


class ModelledBlock(NamedTuple):
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
        return _BLOCKS[self.data_type.name][1]

    def bind(self, context: Context) -> Callable[[int], None]:
        """Return what runs the block on the data block at an address."""
        return _BLOCKS[self.data_type.name][0](self.data_type, context, self.find_type).run


class ModelledFunction(NamedTuple):
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
        return _FUNCTIONS[self.name][1]

    def bind(self, context: Context) -> Callable[..., Any]:
        """Return the function with its context."""
        return partial(_FUNCTIONS[self.name][0], context)


def modelled_block(data_type: DataBlockType[Any], find_type: FindType) -> ModelledBlock | None:
    """Return the body of a block, None for one that there is no model of."""
    return ModelledBlock(data_type, find_type) if data_type.name in _BLOCKS else None


def modelled_function(name: str) -> ModelledFunction | None:
    """Return the body of a function, likewise."""
    return ModelledFunction(name) if name in _FUNCTIONS else None
