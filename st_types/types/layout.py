"""Where members lie: natural alignment, as the C compiler of the controller lays them out."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable

    from st_types.types.elementary import DataType


class StructLayout(NamedTuple):
    """Offsets of members in declaration order, total size and alignment, all in bytes."""

    offsets: tuple[int, ...]
    size: int
    alignment: int


def align_up(offset: int, alignment: int) -> int:
    """Return the smallest multiple of ``alignment`` that is not below ``offset``."""
    return -(-offset // alignment) * alignment


def lay_out(types: Iterable[DataType[object]]) -> StructLayout:
    """Lay members out one after another as a C compiler does on the 32-bit target.

    An empty STRUCT takes no byte, as in the C of gcc.
    """
    offsets = []
    end = 0
    alignment = 1
    for data_type in types:
        alignment = max(alignment, data_type.alignment)
        end += -end % data_type.alignment
        offsets.append(end)
        end += data_type.size
    return StructLayout(tuple(offsets), align_up(end, alignment), alignment)
