"""Where members lie: natural alignment, and the order of a function block's data block."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from st_types.elementary import BOOL, DataType

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from st_types.derived import Member


class Layout(NamedTuple):
    """Offsets of members in declaration order, total size and alignment, all in bytes."""

    offsets: tuple[int, ...]
    size: int
    alignment: int


def align_up(offset: int, alignment: int) -> int:
    """Return the smallest multiple of ``alignment`` that is not below ``offset``."""
    return -(-offset // alignment) * alignment


def lay_out(types: Iterable[DataType[object]]) -> Layout:
    """Lay members out one after another as a C compiler does on the 32-bit target.

    An empty STRUCT takes 1 byte, so that each variable has an address of its own.
    """
    offsets = []
    end = 0
    alignment = 1
    for data_type in types:
        start = align_up(end, data_type.alignment)
        offsets.append(start)
        end = start + data_type.size
        alignment = max(alignment, data_type.alignment)
    return Layout(tuple(offsets), max(1, align_up(end, alignment)), alignment)


def data_block_order(members: Sequence[Member]) -> tuple[int, ...]:
    """Return the indices of ``members`` in the order of the generated C struct.

    Analog inputs, analog outputs, analog internals, then BOOL inputs, outputs, internals; the order
    of declaration within each group (read off SG4/AsTCP.h, where ``enable`` comes last).
    """
    return tuple(
        sorted(
            range(len(members)),
            key=lambda i: (members[i].data_type is BOOL, members[i].section.value),
        )
    )
