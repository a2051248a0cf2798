"""Which Python class executes a function block that is declared somewhere."""

from __future__ import annotations

import pkgutil
from importlib import import_module
from typing import TYPE_CHECKING

import plcsim.library
from plcsim.core.function_block import FunctionBlock
from st_types.types.derived import DataBlockType
from st_types.types.views import type_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from st_types.resolve.scope import Scope
    from st_types.types.elementary import DataType


def executed_blocks(scopes: Iterable[Scope]) -> Mapping[DataType[object], tuple[str, str]]:
    """Return module and name of the class that executes each function block.

    A class executes a block of its name if both data blocks have the same members.
    """
    classes = {made.__name__: (module, made) for module, made in _classes()}
    found: dict[DataType[object], tuple[str, str]] = {}
    for block in (block for scope in scopes for block in scope.function_blocks):
        module, made = classes.get(block.name, ("", None))
        if made is not None and block.data_type is not None and _is_same(block.data_type, made):
            found[block.data_type] = (module, block.name)
    return found


def _classes() -> Iterator[tuple[str, type[FunctionBlock]]]:
    for info in pkgutil.iter_modules(plcsim.library.__path__):
        if info.ispkg:
            module = f"{plcsim.library.__name__}.{info.name}"
            for made in vars(import_module(module)).values():
                if isinstance(made, type) and issubclass(made, FunctionBlock):
                    yield module, made


def _is_same(data_type: DataBlockType[object], made: type[FunctionBlock]) -> bool:
    return _shape(data_type) == _shape(type_of(made))


def _shape(data_type: DataType[object]) -> object:
    if not isinstance(data_type, DataBlockType):
        return None
    pairs = zip(data_type.members, data_type.offsets, strict=True)
    return [(m.name, str(m.data_type), m.section, offset) for m, offset in pairs]
