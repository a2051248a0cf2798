"""Names that differ in case only: which of them a name stands for.

Identifiers of Automation Studio are case-sensitive (216,192 type references and 122,577 uses of
variables in 299 public projects, none in another case; B&R ships ``R_TRIG`` beside ``r_trig``),
those of IEC 61131-3 are not.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection


class Spellings:
    """A set of declared names that can be asked without regard to case.

    Args:
        declared: the names; those that are added later are not seen.
    """

    __slots__ = ("_by_capitals", "_declared")

    def __init__(self, declared: Collection[str]) -> None:
        self._declared = declared
        self._by_capitals: dict[str, list[str]] | None = None

    def near(self, name: str) -> list[str]:
        """Return the declared names that are ``name`` but for case, in the order of declaration."""
        if self._by_capitals is None:
            self._by_capitals = {}
            for declared in self._declared:
                self._by_capitals.setdefault(declared.upper(), []).append(declared)
        return self._by_capitals.get(name.upper(), [])

    def of(self, name: str) -> str | None:
        """Return ``name`` if it is declared, else the only name that differs in case, else None."""
        if name in self._declared:
            return name
        found = self.near(name)
        return found[0] if len(found) == 1 else None
