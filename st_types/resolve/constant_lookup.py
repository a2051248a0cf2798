"""Finding the declarations that names stand for, and the values of constants."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from st_types.resolve.constants import UnknownValueError, names_in
from st_types.resolve.index import DONE, NEW, OPEN, VariableEntry
from st_types.syntax.literals import Constant
from st_types.types.conversions import convert
from st_types.types.derived import EnumerationType, resolve_alias
from st_types.types.elementary import ElementaryType

if TYPE_CHECKING:
    from collections.abc import Iterator

    from st_types.resolve.index import IndexEntry, NameSpace
    from st_types.resolve.scope import Scope

MAX_LEVEL: Final = 150
"""Most levels of nesting that are open at a time, over all the declarations that wait for one
another: ARRAYs, STRUCTs, lists of values, parentheses."""

ENTRY_LEVELS: Final = 3
"""Levels that a declaration counts for when another one waits for it: it takes as many calls."""


class ConstantLookup:
    """Looks names up in a scope and resolves what they stand for; it is the scope's `Constants`.

    Attributes:
        scope: where names are looked up.
        entry: the declaration that is being resolved, None between them.
        level: levels of nesting that are open.
    """

    def __init__(self, scope: Scope) -> None:
        self.scope = scope
        self.entry: IndexEntry | None = None
        self.level = 0

    def check_spelling(self, declared: str, name: str, at: int) -> None:
        """Look at a name that stands at the token ``at`` and is declared as ``declared``."""

    def find(self, space: NameSpace, name: str, at: int) -> IndexEntry | None:
        """Return what ``name`` at the token ``at`` stands for, None if there is nothing."""
        hit = self.scope.lookup(space, name)
        if hit is None:
            return None
        self.check_spelling(hit.name, name, at)
        return hit.entry

    def resolved(self, entry: IndexEntry) -> IndexEntry:
        """Resolve ``entry`` if that is not done yet, and return it.

        An entry that is being resolved comes back as it is, ``state`` OPEN.
        """
        if entry.state == NEW:
            if isinstance(entry, VariableEntry):
                self._resolve_needed(entry)
            self._resolve(entry)
        return entry

    def _resolve(self, entry: IndexEntry) -> None:
        if entry.state == NEW:
            entry.state = OPEN
            entry.user = self.entry
            entry.resolver.resolve(entry, self.level + ENTRY_LEVELS)
            entry.user = None
            entry.state = DONE

    def _resolve_needed(self, entry: VariableEntry) -> None:
        """Resolve the constants that the value of a constant needs, the last of a chain first.

        A hundred constants, each one more than the one before, are no nesting.
        """
        seen = {entry}
        waiting = [(entry, _needed(entry))]
        while waiting:
            last, needed = waiting[-1]
            following = next((each for each in needed if each not in seen), None)
            if following is not None:
                seen.add(following)
                waiting.append((following, _needed(following)))
                continue
            waiting.pop()
            if waiting:
                self._resolve(last)

    def check_open(self, entry: IndexEntry) -> None:
        """Refuse to go deeper than `MAX_LEVEL`.

        Raises:
            UnknownValueError: ``entry`` would be one too many.
        """
        if entry.state == NEW and self.level + ENTRY_LEVELS > MAX_LEVEL:
            message = "too many declarations depend one on the other"
            raise UnknownValueError(message, is_final=True)

    def constant(self, name: str, at: int) -> Constant | None:
        """Return the value of a constant or of an enumeration; see `Constants`."""
        type_name, dot, value_name = name.rpartition(".")
        entry = self.find("types" if dot else "constants", type_name or name, at)
        if entry is None:
            return None
        if isinstance(entry, VariableEntry):
            return self._constant_value(entry)
        return self._enumeration_value(entry, value_name, at if dot else None)

    def _constant_value(self, entry: VariableEntry) -> Constant:
        if entry.state == OPEN:
            raise UnknownValueError(f"{entry.name} depends on itself", is_final=True)
        self.check_open(entry)
        self.resolved(entry)
        return constant_of(entry)

    def _enumeration_value(self, entry: IndexEntry, name: str, at: int | None) -> Constant | None:
        if entry.state == OPEN:
            return None
        self.check_open(entry)
        data_type = self.resolved(entry).data_type
        if data_type is None:
            raise UnknownValueError
        data_type = resolve_alias(data_type)
        declared = data_type.spelling(name) if isinstance(data_type, EnumerationType) else None
        if not isinstance(data_type, EnumerationType) or declared is None:
            return None
        if at is not None:
            self.check_spelling(declared, name, at)
        return Constant(data_type.name, data_type.values[declared])


def _needed(entry: VariableEntry) -> Iterator[VariableEntry]:
    """Yield the constants that stand in the value of a variable, as far as they are NEW."""
    if entry.node.initial is None:
        return
    for name in names_in(entry.node.initial):
        hit = entry.resolver.scope.lookup("constants", name)
        if hit is not None and isinstance(hit.entry, VariableEntry) and hit.entry.state == NEW:
            yield hit.entry


def constant_of(entry: VariableEntry) -> Constant:
    """Return a resolved VAR CONSTANT as an operand.

    A constant without a value is 0, as on the controller.

    Raises:
        UnknownValueError: it is a list, a structure, or its value is not known.
    """
    data_type, value = entry.data_type, entry.value
    if entry.node.initial is None and isinstance(data_type, ElementaryType):
        return Constant(data_type.name, convert(0, data_type))
    if data_type is None or not isinstance(value, bool | int | float | str):
        raise UnknownValueError
    return Constant(data_type.name, value)
