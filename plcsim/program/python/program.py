"""The base classes of programs written in Python, and of the global variables of a project."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plcsim.core.errors import ConfigurationError
from plcsim.program.python.modules import load_module
from st_types.types.views import Struct, context_of

if TYPE_CHECKING:
    from pathlib import Path

    from plcsim.core.context import Context
    from st_types.types.derived import StructType


class Program(Struct):
    """Base of programs written in Python: variables and the units INIT, CYCLIC and EXIT.

    Variables are declared in the class body with `st_types.var`; they lie in PLC memory and are the
    program's tags. Other Python objects must be named in ``__slots__``; they are not tags. Any of
    the three units may be left out.
    """

    __slots__ = ()

    def init(self) -> None:
        """INIT: runs once before the first cycle; its time is not monitored."""

    def cyclic(self) -> None:
        """CYCLIC: runs once in every cycle of the task class."""

    def exit(self) -> None:
        """EXIT: runs once when the controller stops."""

    @property
    def context(self) -> Context:
        """The controller the program runs on."""
        context: Context = context_of(self)
        return context


class Globals(Struct):
    """Base of the global variables of a project that are declared in Python.

    A project without a .var file may have a module ``globals.py`` in its folder with one subclass::

        class Cell(Globals):
            gCount = var(UDINT)
    """

    __slots__ = ()


def globals_in(folder: Path, package: str) -> StructType[Any] | None:
    """Return the type of the global variables in ``globals.py``, None where there are none.

    Args:
        folder: of the project.
        package: name under which Python finds it.

    Raises:
        ConfigurationError: it cannot be imported, or holds several subclasses of `Globals`.
    """
    file = folder / "globals.py"
    if not file.is_file():
        return None
    module = load_module(f"{package}.globals", folder, package)
    found = [
        value
        for value in vars(module).values()
        if isinstance(value, type) and issubclass(value, Globals) and value is not Globals
    ]
    if len(found) > 1:
        names = ", ".join(sorted(each.__name__ for each in found))
        raise ConfigurationError(
            f"{file}: one subclass of plcsim.Globals is expected, found {names}"
        )
    return found[0]._plc_type if found else None
