"""The library IecCheck: where a project has it, Automation Studio calls its functions.

``a[i]`` is ``a[CheckBounds(i, lower, upper)]`` and ``x / y`` is ``x / CheckDivDint(y)`` then; what
they do about a wrong value (limit it, tell the logbook, end the application) is written in the
library, in Structured Text, for the user to change. Without the library nothing is checked. Its
functions for subranges, enumerations and addresses are not called: a wrong address is a page fault
anyhow.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Final

from plcsim.program.structured_text.check.kinds import ANY_INT, NUMBERS, kind_of, number_type, plain
from plcsim.program.structured_text.check.typed import Call, Constant
from st_types.types.elementary import DINT, INT, LREAL, REAL, SINT, UDINT, UINT, USINT

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.names import ScopeNames
    from plcsim.program.structured_text.check.typed import Value
    from st_types.resolve.declared import DeclaredFunction

LIBRARY: Final = "IecCheck"
_DIVISIONS: Final[Mapping[Type, str]] = {
    SINT: "CheckDivSint",
    USINT: "CheckDivUsint",
    INT: "CheckDivInt",
    UINT: "CheckDivUint",
    DINT: "CheckDivDint",
    UDINT: "CheckDivUdint",
    REAL: "CheckDivReal",
    LREAL: "CheckDivLReal",
}


class IecCheck:
    """The calls of IecCheck in one body; there are none where the project has no such library."""

    def __init__(self, names: ScopeNames) -> None:
        self._names = names
        self._function = cache(self._found)

    def index(self, value: Value, low: int, high: int) -> Value:
        """Return an index that is not constant, kept within bounds."""
        function = self._function("CheckBounds")
        if function is None:
            return value
        return Call(DINT, function, [value, Constant(ANY_INT, low), Constant(ANY_INT, high)])

    def divisor(self, value: Value) -> Value:
        """Return a divisor that is not constant, kept from being 0."""
        if type(value) is Constant or kind_of(value.type) not in NUMBERS:
            return value
        data_type = number_type(value.type)
        name = _DIVISIONS.get(data_type)
        function = None if name is None else self._function(name)
        return value if function is None else Call(data_type, function, [value])

    def _found(self, name: str) -> DeclaredFunction | None:
        """Return a function of the library, which does not check itself."""
        scope = self._names.scope
        hit = scope.lookup("functions", name)
        if hit is None:
            return None
        owner = hit.entry.resolver.scope
        if owner.name != LIBRARY or owner in self._names.symbols.storages:
            return None
        function = scope.find_function(name)
        if function is None or function.result is None:
            return None
        return function if plain(function.result) in _DIVISIONS else None
