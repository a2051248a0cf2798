"""What programs and libraries have allocated on heaps of their own, for those who report it."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.core.context import Context


class HeapUse(NamedTuple):
    """What is on a heap, in bytes.

    Attributes:
        size: of the heap.
        used: in areas that were not freed.
        most: that ever were.
        areas: that were not freed.
        refused: requests for which there was no room.
    """

    size: int
    used: int
    most: int
    areas: int
    refused: int


class Heaps:
    """The heaps of a controller; see `of`."""

    def __init__(self) -> None:
        self._told: dict[str, Callable[[], HeapUse]] = {}

    @staticmethod
    def of(context: Context) -> Heaps:
        """Return those of a controller, made at the first call."""
        found = context.settings(Heaps)
        if found is None:
            found = Heaps()
            context.give_settings(found)
        return found

    def add(self, name: str, told: Callable[[], HeapUse]) -> None:
        """Note a heap.

        Args:
            name: of the program or library that has it.
            told: tells its use.
        """
        self._told[name] = told

    def uses(self) -> Mapping[str, HeapUse]:
        """Return the use of each heap, by the name of what has it."""
        return {name: told() for name, told in self._told.items()}
