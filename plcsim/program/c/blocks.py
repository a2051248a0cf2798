"""Function blocks of the controller's libraries, as programs in C find them."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Final

from plcsim import library
from plcsim.core.function_block import FunctionBlock
from plcsim.program.c.variables import scope_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.core.context import Context
    from st_types.resolve.scope import Scope

FOLDERS: Final = ("runtime", "standard", "astcp")
"""Of the libraries in `plcsim.library`."""


@cache
def library_scopes() -> list[Scope]:
    """Return what the libraries declare, in the order in which headers include them."""
    root = Path(library.__file__).parent
    scopes: list[Scope] = []
    for folder in FOLDERS:
        named = [f.stem for f in sorted((root / folder).glob("*.fun"))]
        if named:
            scopes.append(scope_of(named[0], root / folder, scopes, strict=False))
    return scopes


@cache
def block_classes() -> dict[str, type[FunctionBlock]]:
    """Return the blocks written in Python, by name."""
    modules = [import_module(f"{library.__name__}.{folder}") for folder in FOLDERS]
    return {
        name: value
        for module in modules
        for name, value in vars(module).items()
        if isinstance(value, type) and issubclass(value, FunctionBlock)
    }


def caller(block: type[FunctionBlock], context: Context) -> Callable[[int], None]:
    """Return what runs a block on the data block at an address."""
    views: dict[int, FunctionBlock] = {}
    access = context.memory.access

    def call(address: int) -> None:
        view = views.get(address)
        if view is None:
            view = views[address] = access(block, address, context)
        view.execute()

    return call
