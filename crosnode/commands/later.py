"""Acts of commands, loaded when one of them runs and not with every command of ``plcsim``."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from crosnode.errors import CrosnodeError
from plcsim.core.errors import PlcError

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable


def act_of(module: str, name: str) -> Callable[[argparse.Namespace], int]:
    """Return what runs a function of a module; ``plcsim`` tells its errors in one line.

    Args:
        module: full name.
        name: of a function that takes the arguments, and may give an exit code.
    """

    def act(options: argparse.Namespace) -> int:
        try:
            code: int | None = getattr(import_module(module), name)(options)
        except CrosnodeError as error:
            raise PlcError(str(error)) from error
        return code or 0

    return act
