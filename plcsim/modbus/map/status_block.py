"""Input registers that every map has: a test of the word order, and the state of the controller.

==============  =================================================================
65000           16#1234
65001, 65002    int32 16#12345678
65003, 65004    float32 123.456
65005, 65006    string "ABCD"
65010           state: 1 BOOT, 2 RUN, 3 SERVICE, 4 STOPPED
65011, 65012    uint32, cycles of the task class with the lowest number
65013           uint16, execution time of its last cycle, microseconds
65014           uint16, its longest execution time, microseconds
65015, 65016    uint32, grid points it missed
65017 to 65020  uint64, hash of the layout; changes when variables or types change
==============  =================================================================

All in the order ABCD; a number that is too large shows the largest.
"""

from __future__ import annotations

import struct
from typing import Final, NamedTuple

FIRST: Final = 65000
COUNT: Final = 21
"""Registers from `FIRST` on."""

_BLOCK = struct.Struct(">Hif4s6xHIHHIQ")
_TEST = (0x1234, 0x12345678, 123.456, b"ABCD")


class ControllerStatus(NamedTuple):
    """What the block shows; durations in nanoseconds."""

    state: int = 0
    cycles: int = 0
    execution_ns: int = 0
    longest_execution_ns: int = 0
    missed: int = 0
    layout_hash: int = 0


def registers(status: ControllerStatus) -> bytes:
    """Return the bytes of all registers of the block."""
    return _BLOCK.pack(
        *_TEST,
        status.state,
        status.cycles & 0xFFFF_FFFF,
        min(status.execution_ns // 1000, 0xFFFF),
        min(status.longest_execution_ns // 1000, 0xFFFF),
        min(status.missed, 0xFFFF_FFFF),
        status.layout_hash,
    )
