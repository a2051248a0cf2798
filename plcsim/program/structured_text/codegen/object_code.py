"""A compiled module before its variables have addresses."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from plcsim.program.structured_text import ir
    from plcsim.program.structured_text.codegen.lines import ModuleLines
    from plcsim.program.structured_text.codegen.profile import Profile


Holes = npt.NDArray[np.int64]
"""Holes of five bytes in a module, each in a row of three: position in the module, number of a
segment, bytes to add to the address of the segment.

What is filled in is the same as operand of i32.const, a signed LEB128 number, and as offset of an
access, an unsigned one: an address below 2**31, filled up to five bytes.
"""


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
        wasm = np.frombuffer(bytearray(self.wasm), dtype=np.uint8)
        starts = np.array([addresses[one.name] for one in self.segments], dtype=np.int64)
        positions, segments, offsets = self.holes.T
        values = starts[segments] + offsets
        for place in range(4):
            wasm[positions + place] = values >> 7 * place & 0x7F | 0x80
        wasm[positions + 4] = values >> 28
        return wasm.tobytes()
