"""Retained variables: VAR RETAIN, and the permanent variables of a configuration.

At a warm restart they have the values that they had before, at a cold restart only the permanent
ones do, as on the controller. What an earlier run has left is handed in before the first boot; who
keeps it meanwhile is no matter of the core (`plcsim.retain`).
"""

from __future__ import annotations

from itertools import product
from struct import Struct
from typing import TYPE_CHECKING, Any

from plcsim.core.tag import Tag
from st_types.types.derived import ArrayType, StructType, resolve_alias

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from plcsim.core.memory import Memory
    from st_types.types.elementary import DataType

_SPAN = Struct("<II")


class RetainedVariables:
    """Those of one controller.

    Args:
        memory: where they lie.
        areas: all variables; see `plcsim.core.tag.find_tag`.

    Attributes:
        tags: the RETAIN variables, then the permanent ones that are not RETAIN.
        kept: (address, bytes) of what the next boot gives them instead of their initial values.
    """

    def __init__(self, memory: Memory, areas: Sequence[Tag]) -> None:
        self._memory = memory
        self.tags = tuple(tag for area in areas for tag in _retained(area))
        self._permanent: dict[int, int] = {}
        self.kept: list[tuple[int, bytes]] = []

    def add_permanent(self, tag: Tag) -> None:
        """Let a variable be permanent."""
        self._permanent[tag.address] = tag.data_type.size
        if not any(_holds(each, tag) for each in self.tags):
            self.tags = (*self.tags, tag)

    def keep(self) -> None:
        """Keep the present values for the next boot."""
        self.kept = [(t.address, self._memory.read(t.address, t.data_type.size)) for t in self.tags]

    def clear(self) -> None:
        """Forget what is kept, as a cold restart does: all but the permanent variables."""
        kept, self.kept = self.kept, []
        for address, data in kept:
            for first, size in self._permanent.items():
                start, end = max(address, first), min(address + len(data), first + size)
                if start < end:
                    self.kept.append((start, data[start - address : end - address]))

    def restore(self) -> None:
        """Give the variables what is kept."""
        for address, data in self.kept:
            self._memory.write(address, data)

    def to_bytes(self) -> bytes:
        """Return what is kept, for `from_bytes` of the same project's controller."""
        return b"".join(_SPAN.pack(a, len(data)) + data for a, data in self.kept)

    def from_bytes(self, data: bytes) -> None:
        """Let something be kept that `to_bytes` gave."""
        self.kept = []
        at = 0
        while at < len(data):
            address, size = _SPAN.unpack_from(data, at)
            at += _SPAN.size
            self.kept.append((address, data[at : at + size]))
            at += size


def _holds(outer: Tag, inner: Tag) -> bool:
    end = inner.address + inner.data_type.size
    return outer.address <= inner.address and end <= outer.address + outer.data_type.size


def _retained(area: Tag) -> Iterator[Tag]:
    if not area.is_constant:
        yield from _inside(area.path, area.data_type, area.address)


def _inside(path: str, data_type: DataType[Any], address: int) -> Iterator[Tag]:
    """Iterate over the outermost RETAIN variables below one."""
    data_type = resolve_alias(data_type)
    if isinstance(data_type, StructType):
        for offset, member in zip(data_type.offsets, data_type.members, strict=True):
            name = f"{path}.{member.name}" if path else member.name
            if member.is_retained:
                yield Tag(name, resolve_alias(member.data_type), address + offset)
            else:
                yield from _inside(name, member.data_type, address + offset)
    elif isinstance(data_type, ArrayType) and _has_retained(data_type.element):
        for number, index in enumerate(_indices(data_type.bounds)):
            at = address + number * data_type.element.size
            yield from _inside(f"{path}[{index}]", data_type.element, at)


def _has_retained(data_type: DataType[Any]) -> bool:
    data_type = resolve_alias(data_type)
    if isinstance(data_type, ArrayType):
        return _has_retained(data_type.element)
    return isinstance(data_type, StructType) and any(
        m.is_retained or _has_retained(m.data_type) for m in data_type.members
    )


def _indices(bounds: Iterable[tuple[int, int]]) -> Iterator[str]:
    ranges = (range(low, high + 1) for low, high in bounds)
    return (",".join(map(str, each)) for each in product(*ranges))
