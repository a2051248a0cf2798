"""Idents: numbers in PLC memory that stand for what cannot lie there."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, Generic, TypeVar

if TYPE_CHECKING:
    from collections.abc import Iterator

    from plcsim.core.context import Context

T = TypeVar("T")

LAST_IDENT: Final = 0xFFFF_FFFF
MOST_IDENTS: Final = 4096
"""Objects of one library that can be in use at once."""


class Idents(Generic[T]):
    """What the idents of one library stand for, on one controller.

    An ident is given once: a stale one stays unknown for 2^32 further objects.

    Args:
        context: the controller's.
        most: objects that can be in use at once.
    """

    def __init__(self, context: Context, most: int = MOST_IDENTS) -> None:
        self.context = context
        self._most = most
        self._objects: dict[int, T] = {}
        self._last = 0

    @property
    def full(self) -> bool:
        """Whether all idents are in use."""
        return len(self._objects) >= self._most

    def add(self, made: T) -> int:
        """Return a new ident for an object; the caller sees to it that there is one left."""
        self._last = self._last % LAST_IDENT + 1
        while self._last in self._objects:
            self._last = self._last % LAST_IDENT + 1
        self._objects[self._last] = made
        return self._last

    def find(self, ident: int) -> T | None:
        """Return what an ident stands for, None if it is not in use."""
        return self._objects.get(ident)

    def remove(self, ident: int) -> T | None:
        """Forget an ident and return what it stood for, None if it was not in use."""
        return self._objects.pop(ident, None)

    def __iter__(self) -> Iterator[tuple[int, T]]:
        return iter([*self._objects.items()])

    def __len__(self) -> int:
        return len(self._objects)
