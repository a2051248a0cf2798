"""Forced tags: variables that keep a value whatever inputs and programs do.

A forced value is written last in LATCH, so it wins over every input and command, and first in
PUBLISH, so what a program wrote instead never gets out. In between a program sees what it writes
itself, as on the controller. A variable of a class in the middle of a cycle is left alone until
that class publishes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from plcsim.core.errors import TagError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from plcsim.core.memory import Memory
    from plcsim.core.owners import Owners
    from plcsim.core.tag import Tag


class Force(NamedTuple):
    """One forced tag.

    Attributes:
        tag: the variable.
        data: its bytes while it is forced.
        source: who forced it.
    """

    tag: Tag
    data: bytes
    source: str


class Forces:
    """The forced tags of a controller, in the order in which they were forced.

    Args:
        memory: where the variables lie.
        owners: of the variables.

    Attributes:
        stores: what `apply` does: owner, variable and bytes of each.
    """

    def __init__(self, memory: Memory, owners: Owners) -> None:
        self._memory = memory
        self._owners = owners
        self._forces: dict[tuple[int, int], Force] = {}
        self.stores: list[tuple[int, memoryview, bytes]] = []
        self._followers: list[Callable[[], None]] = []

    def follow(self, changed: Callable[[], None]) -> None:
        """Have ``changed`` called whenever a tag was forced or released."""
        self._followers.append(changed)

    def force(self, tag: Tag, data: bytes, source: str) -> None:
        """Force a tag from the next LATCH on; a tag that is forced gets another value.

        Args:
            tag: of any type.
            data: its bytes.
            source: who wants it, for the list and the logbook.

        Raises:
            TagError: the bytes are not those of a value of the tag, or parts of it are forced,
                or it is constant.
            PageFault: the tag does not lie in PLC memory.
        """
        span = tag.address, tag.data_type.size
        if tag.is_constant:
            raise TagError(f"tag {tag.path} is CONSTANT")
        if len(data) != tag.data_type.size:
            raise TagError(f"tag {tag.path}: {len(data)} bytes are not a {tag.data_type}")
        self._memory.check(*span)
        if span not in self._forces:
            for other in self._forces.values():
                if _overlap(tag, other.tag):
                    raise TagError(f"tag {tag.path} overlaps {other.tag.path}, which is forced")
        self._forces[span] = Force(tag, bytes(data), source)
        self._changed()

    def release(self, tag: Tag) -> bool:
        """Let a tag go; it keeps its value until somebody writes it. False: it was not forced."""
        if self._forces.pop((tag.address, tag.data_type.size), None) is None:
            return False
        self._changed()
        return True

    def clear(self) -> int:
        """Let all tags go; return how many there were."""
        count = len(self._forces)
        self._forces.clear()
        if count:
            self._changed()
        return count

    def apply(self, held: int) -> None:
        """Write the forced values, except those of classes in the middle of a cycle.

        Args:
            held: owners of what must be left alone, as bits.
        """
        for owner, variable, data in self.stores:
            if not owner & held:
                variable[:] = data

    def _changed(self) -> None:
        self.stores = [
            (self._owners.of(f.tag.address), self._memory.view(f.tag.address, len(f.data)), f.data)
            for f in self._forces.values()
        ]
        for changed in self._followers:
            changed()

    def __iter__(self) -> Iterator[Force]:
        return iter(tuple(self._forces.values()))

    def __len__(self) -> int:
        return len(self._forces)


def _overlap(one: Tag, other: Tag) -> bool:
    return (
        one.address < other.address + other.data_type.size
        and other.address < one.address + one.data_type.size
    )
