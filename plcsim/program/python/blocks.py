"""Function blocks as variables of programs in Python: a view class that runs the block.

A block whose body is a Python class has that class. For any other the class is made here; a call of
it runs the body of its language on the same data block.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plcsim.core.errors import ConfigurationError
from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import give_members
from plcsim.program.site import Site, no_body
from st_types.types.derived import (
    ArrayType,
    DataBlockType,
    EnumerationType,
    StructType,
    resolve_alias,
)
from st_types.types.views import address_of, type_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from plcsim.library.catalogue import Catalogue
    from st_types.types.elementary import DataType


def give_views(data_type: DataType[Any], catalogue: Catalogue) -> None:
    """See to it that function blocks in a variable can be called, and enumerations have names.

    Raises:
        ConfigurationError: the body of a block cannot be loaded.
    """
    for block in _blocks_in(data_type, set()):
        if _can_run(block.view):
            continue
        executable = catalogue.executable(block)
        if executable is None:
            _make(block, _without_body)
        elif not _can_run(block.view):  # loading a body in Python makes its class
            _make(block, _run)


def _can_run(view: type | None) -> bool:
    execute = getattr(view, "execute", None)
    return execute is not None and execute is not FunctionBlock.execute


def _make(data_type: DataBlockType[Any], execute: object) -> None:
    """Make a view class; it enters itself into the type."""
    type(data_type.name, (FunctionBlock,), {"_plc_type": data_type, "execute": execute})


def _run(block: FunctionBlock) -> None:
    """Run the block once on its data block."""
    Site.of(block.context).block(type_of(block))(address_of(block))  # type: ignore[arg-type]  # a data block


def _without_body(block: FunctionBlock) -> None:
    raise ConfigurationError(no_body(type_of(block)))  # type: ignore[arg-type]  # a data block


def _blocks_in(data_type: DataType[Any], seen: set[int]) -> Iterator[DataBlockType[Any]]:
    """Iterate over the data blocks in a variable, those inside others first."""
    found = resolve_alias(data_type)
    if isinstance(found, ArrayType):
        yield from _blocks_in(found.element, seen)
    elif isinstance(found, EnumerationType):
        give_members(found)
    elif isinstance(found, StructType) and id(found) not in seen:
        seen.add(id(found))
        for member in found.members:
            yield from _blocks_in(member.data_type, seen)
        if isinstance(found, DataBlockType):
            yield found
