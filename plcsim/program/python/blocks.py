"""Function blocks and enumerations as variables of programs in Python: the classes of their views.

A block whose body is a Python class has that class. For any other the class is made here; a call of
it runs the body of its language on the same data block.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import give_members
from plcsim.program.site import blocks_in
from st_types.types.derived import ArrayType, EnumerationType, StructType, resolve_alias

if TYPE_CHECKING:
    from plcsim.library.catalogue import Catalogue
    from st_types.types.elementary import DataType


def give_views(data_type: DataType[Any], catalogue: Catalogue) -> None:
    """See to it that function blocks in a variable can be called, and enumerations have names.

    Raises:
        ConfigurationError: the body of a block cannot be loaded.
    """
    _name_values(data_type, set())
    for block in blocks_in(data_type):
        execute = getattr(block.view, "execute", None)
        if execute is None or execute is FunctionBlock.execute:
            catalogue.executable(block)  # loading a body in Python makes its class
        if not hasattr(block.view, "execute"):
            type(block.name, (FunctionBlock,), {"_plc_type": block})  # it enters itself


def _name_values(data_type: DataType[Any], seen: set[int]) -> None:
    found = resolve_alias(data_type)
    if isinstance(found, ArrayType):
        _name_values(found.element, seen)
    elif isinstance(found, EnumerationType):
        give_members(found)
    elif isinstance(found, StructType) and id(found) not in seen:
        seen.add(id(found))
        for member in found.members:
            _name_values(member.data_type, seen)
