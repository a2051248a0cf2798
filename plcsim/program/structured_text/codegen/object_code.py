"""A compiled module before its variables have addresses."""

from __future__ import annotations

import hashlib
import struct
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from array import array
    from collections.abc import Iterator, Mapping, Sequence

    from plcsim.program.structured_text import ir
    from plcsim.program.structured_text.codegen.lines import ModuleLines
    from plcsim.program.structured_text.codegen.profile import Profile


HOLES = "i"
"""Type of the numbers in an array of holes (module ``array``)."""

Holes: TypeAlias = "array[int]"
"""Holes of five bytes in a module, three numbers for each: position in the module, number of a
segment, bytes to add to the address of the segment.

What is filled in is the same as operand of i32.const, a signed LEB128 number, and as offset of an
access, an unsigned one: an address below 2**31, filled up to five bytes.
"""

_HOLE = struct.Struct("<IB")
_MORE = 0x8080_8080
"""The bit in four of the five bytes that says that another follows."""


class ObjectCode:
    """A compiled module before its variables have addresses.

    It depends on sources only, so several tasks of one program share it.

    Args:
        name: of the module.
        wasm: the module, with holes for addresses.
        segments: what it accesses, in the order of their numbers.
        holes: where their addresses belong.
        lines: from instructions to lines.
        imports: functions that it needs, those of the runtime not among them.
        profile: what its counters mean; None where it has none.
    """

    def __init__(
        self,
        name: str,
        wasm: bytes,
        segments: Sequence[ir.Segment],
        holes: Holes,
        lines: ModuleLines,
        imports: Sequence[ir.Import] = (),
        profile: Profile | None = None,
    ) -> None:
        self.name = name
        self.wasm = wasm
        self.segments = segments
        self.holes = holes
        self.lines = lines
        self.imports = imports
        self.profile = profile

    def place(self, addresses: Mapping[str, int]) -> bytes:
        """Return the module with its variables at these addresses, by name of the segment.

        Raises:
            KeyError: a segment has no address.
        """
        wasm, fill = bytearray(self.wasm), _HOLE.pack_into
        starts = self._starts(addresses)
        for position, segment, offset in self.rows():
            value = starts[segment] + offset
            parts = value & 0x7F | value << 1 & 0x7F00 | value << 2 & 0x7F_0000
            fill(wasm, position, parts | value << 3 & 0x7F00_0000 | _MORE, value >> 28)
        return bytes(wasm)

    def identity(self, addresses: Mapping[str, int]) -> bytes:
        """Return what `place` depends on, which is known sooner.

        Raises:
            KeyError: a segment has no address.
        """
        state = hashlib.blake2b(self.wasm)
        state.update(self.holes)
        return state.digest() + repr(self._starts(addresses)).encode()

    def rows(self) -> Iterator[tuple[int, int, int]]:
        """Iterate over the holes: position, number of the segment, bytes to add."""
        numbers = iter(self.holes)
        return zip(numbers, numbers, numbers, strict=True)

    def _starts(self, addresses: Mapping[str, int]) -> list[int]:
        return [addresses[one.name] for one in self.segments]
