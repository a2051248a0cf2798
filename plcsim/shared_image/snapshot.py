"""Snapshots: what services read, copied in PUBLISH into one of two banks.

A snapshot holds all variables where they are not many, and of a larger project what services asked
for. Its bytes lie by owner, one class after another, so that only those are copied that may have
changed: the variables of the class that publishes, the shared ones, those that commands and forces
wrote, and now and then all others (a program may write them through an address). What belongs to a
class in the middle of a cycle is carried over from the snapshot before: nobody outside sees half a
cycle.
"""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING, Any, Final, NamedTuple, Protocol

from plcsim.core.owners import SHARED
from plcsim.shared_image import layout

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from plcsim.core.memory import Memory
    from plcsim.core.owners import Owners

    Places = Iterable[tuple[int, int]]
    Regions = Sequence[memoryview[int]]

WHOLE: Final = 64 * 1024
"""Bytes. Up to here a snapshot holds all variables, and all of them are copied each time."""

REFRESH_NS: Final = 10_000_000
"""What nobody is known to have changed is copied so often."""

NEAR: Final = 256
"""Bytes. Variables that lie closer together are copied in one piece with what is between them: so
much is copied in the time that one more piece takes."""

MOST_PIECES: Final = 500
"""More pieces are gathered word by word by numpy, which is not loaded for less."""


class Span(NamedTuple):
    """A piece of the snapshot: its owner, PLC address and bytes."""

    owner: int
    address: int
    size: int


def whole_or(areas: Places, exports: Places) -> list[tuple[int, int]]:
    """Return what a snapshot must hold: all areas, or the exports where those are too much.

    Args:
        areas: (PLC address, bytes) of all variables.
        exports: of those that services asked for.
    """
    areas = list(areas)
    return areas if sum(size for _, size in areas) <= WHOLE else list(exports)


def spans_of(pieces: Places, owners: Owners) -> list[Span]:
    """Return the spans that hold all pieces, by owner and address, those near each other joined."""
    cut = sorted(part for piece in pieces for part in owners.cut(*piece) if piece[1])
    spans: list[Span] = []
    for owner, address, size in cut:
        if spans and spans[-1].owner == owner:
            _, first, length = spans[-1]
            end = max(first + length, address + size)
            if address - first - length <= NEAR and len(owners.cut(first, end - first)) == 1:
                spans[-1] = Span(owner, first, end - first)
                continue
        spans.append(Span(owner, address, size))
    return _in_words(spans)


def _in_words(spans: list[Span]) -> list[Span]:
    """Widen the pieces of owners that have very many to whole words of 32 bits."""
    result: list[Span] = []
    for owner, group in groupby(spans, lambda span: span.owner):
        pieces = list(group)
        if len(pieces) > MOST_PIECES:
            for _, address, size in pieces:
                first = address & ~3
                result.append(Span(owner, first, (address + size - first + 3) & ~3))
        else:
            result += pieces
    return result


class _Copy(Protocol):
    """Copies the variables of one owner into a bank."""

    def into(self, bank: int) -> None:
        """Copy them as they are now."""


class _Pieces:
    """Copies some pieces."""

    def __init__(self, memory: Memory, spans: Sequence[Span], regions: Regions) -> None:
        self._pieces = [memory.view(address, size) for _, address, size in spans]
        self._regions = regions

    def into(self, bank: int) -> None:
        if len(self._pieces) == 1:
            self._regions[bank][:] = self._pieces[0]
        else:
            self._regions[bank][:] = b"".join(self._pieces)


class _Words:
    """Copies very many small pieces, all of them whole words."""

    def __init__(self, memory: Memory, spans: Sequence[Span], regions: Regions) -> None:
        import numpy as np  # noqa: PLC0415  # 16 MB that few projects need

        low = min(span.address for span in spans)
        high = max(span.address + span.size for span in spans)
        self._take: Any = np.frombuffer(memory.view(low, high - low), np.uint32).take
        self._indices = np.concatenate(
            [np.arange(a - low, a - low + size, 4) // 4 for _, a, size in spans]
        )
        self._regions = [np.frombuffer(region, np.uint32) for region in regions]

    def into(self, bank: int) -> None:
        # mode "clip": the default would fill a buffer first, and copy that
        self._take(self._indices, out=self._regions[bank], mode="clip")


class _Part:
    """The variables of one owner in both banks.

    Attributes:
        owner: bit of the class, or `SHARED`.
        into: copies the variables as they are now into a bank.
        number: of the snapshot they were last copied for.
    """

    __slots__ = ("_regions", "into", "number", "owner")

    def __init__(self, memory: Memory, spans: Sequence[Span], regions: Regions) -> None:
        self.owner = spans[0].owner
        self.number = 0
        self._regions = regions
        kind = _Words if len(spans) > MOST_PIECES else _Pieces
        copy: _Copy = kind(memory, spans, regions)
        self.into = copy.into

    def carry(self, number: int) -> None:
        """Take the variables over from the snapshot before, unless the bank has them already."""
        if self.number == number - 1:
            new, old = self._regions[number & 1], self._regions[~number & 1]
            new[:] = old


class Snapshots:
    """Writes one snapshot after another.

    Args:
        memory: where the variables lie.
        spans: as `spans_of` gives them.
        cells: the header, as 64-bit numbers.
        banks: both banks.
    """

    def __init__(
        self,
        memory: Memory,
        spans: Sequence[Span],
        cells: memoryview[int],
        banks: Regions,
    ) -> None:
        self._cells = cells
        self._number = cells[layout.CELL_LATEST]
        self._parts: list[_Part] = []
        self._refreshed_ns = -REFRESH_NS
        self._is_small = sum(span.size for span in spans) <= WHOLE
        at = 0
        for _, group in groupby(spans, lambda span: span.owner):
            own = list(group)
            end = at + sum(span.size for span in own)
            self._parts.append(_Part(memory, own, [bank[at:end] for bank in banks]))
            at = end

    def publish(self, changed: int, held: int, now_ns: int) -> None:
        """Write the next snapshot.

        Args:
            changed: owners of what may have changed since the last one, as bits.
            held: classes in the middle of a cycle, as bits of owners.
            now_ns: the present time.
        """
        number = self._number + 1
        bank = number & 1
        changed |= SHARED
        if self._is_small or now_ns - self._refreshed_ns >= REFRESH_NS:
            changed, self._refreshed_ns = -1, now_ns
        cells = self._cells
        cells[layout.CELL_BEGIN[bank]] = number
        changed &= ~held
        for part in self._parts:
            if part.owner & changed:
                part.into(bank)
                part.number = number
            else:
                part.carry(number)
        cells[layout.CELL_END[bank]] = number
        cells[layout.CELL_LATEST] = self._number = number
