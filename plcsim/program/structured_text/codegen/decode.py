"""Reads the instructions of a function back, to measure and to change them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.machine import opcodes

if TYPE_CHECKING:
    from collections.abc import Iterator


class Instruction(NamedTuple):
    """An instruction.

    Attributes:
        start: position of its opcode.
        opcode: its first byte.
        end: position behind it.
    """

    start: int
    opcode: int
    end: int


def _codes(*names: bytes) -> frozenset[int]:
    return frozenset(name[0] for name in names)


_ONE_NUMBER: Final = _codes(
    opcodes.BR,
    opcodes.BR_IF,
    opcodes.CALL,
    opcodes.LOCAL_GET,
    opcodes.LOCAL_SET,
    opcodes.LOCAL_TEE,
    opcodes.GLOBAL_GET,
    opcodes.GLOBAL_SET,
    opcodes.I32_CONST,
    opcodes.I64_CONST,
    opcodes.BLOCK,  # its type, one byte
    opcodes.LOOP,
    opcodes.IF,
)
_TWO_NUMBERS: Final = _codes(opcodes.CALL_INDIRECT) | frozenset(
    range(opcodes.I32_LOAD[0], opcodes.I64_STORE32[0] + 1)
)
_BYTES: Final = {opcodes.F32_CONST[0]: 4, opcodes.F64_CONST[0]: 8}
_BR_TABLE: Final = opcodes.BR_TABLE[0]

FREE: Final = _codes(
    opcodes.UNREACHABLE,
    opcodes.NOP,
    opcodes.BLOCK,
    opcodes.LOOP,
    opcodes.ELSE,
    opcodes.END,
    opcodes.RETURN,
    opcodes.DROP,
)
"""Instructions that the machine does not count; every other counts as one, and so does the entry
of a function (wasmtime's fuel)."""


def instructions(code: bytes | bytearray) -> Iterator[Instruction]:
    """Iterate over the instructions of a function that this back end has written."""
    place = 0
    while place < len(code):
        end = _end(code, place)
        yield Instruction(place, code[place], end)
        place = end


def _end(code: bytes | bytearray, place: int) -> int:
    opcode = code[place]
    if opcode in _ONE_NUMBER:
        return _after_number(code, place + 1)
    if opcode in _TWO_NUMBERS:
        return _after_number(code, _after_number(code, place + 1))
    if opcode == _BR_TABLE:
        end = _after_number(code, place + 1)
        for _ in range(number_at(code, place + 1) + 1):
            end = _after_number(code, end)
        return end
    return place + 1 + _BYTES.get(opcode, 0)


def _after_number(code: bytes | bytearray, place: int) -> int:
    while code[place] & 0x80:
        place += 1
    return place + 1


def number_at(code: bytes | bytearray, place: int) -> int:
    """Return the unsigned LEB128 number at a position."""
    number = shift = 0
    while code[place] & 0x80:
        number |= (code[place] & 0x7F) << shift
        place, shift = place + 1, shift + 7
    return number | code[place] << shift
