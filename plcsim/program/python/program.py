"""The base class of programs written in Python."""

from __future__ import annotations

from typing import TYPE_CHECKING

from st_types.types.views import Struct, context_of

if TYPE_CHECKING:
    from plcsim.core.context import Context


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
