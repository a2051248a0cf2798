"""Conversions of floating point numbers to integers, as GCC compiles them for the controller.

C leaves open what becomes of a number that does not fit; programs rely on it all the same: that
-1.5 as UINT is 65535, and 70000.0 as INT 4464. GCC converts to 32 bits, to -2147483648 where the
number does not fit even there (the "integer indefinite" of SSE), and takes the low bits of that.
clang would take for granted that numbers fit; by an option it asks for conversions that saturate,
and those are exchanged here, in the text of its intermediate representation. Constants saturate
with GCC as well, so they stay.
"""

from __future__ import annotations

import re
from struct import pack
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

SATURATE: Final = "-fno-strict-float-cast-overflow"
"""Option by which clang asks for conversions that can be told in its text."""

_BOUNDS: Final = (2.0**31, 2.0**32, 2.0**63, 2.0**64)
_COMPARED: Final = tuple(
    code + pack(kind, bound)
    for code, kind in ((b"\x43", "<f"), (b"\x44", "<d"))
    for bound in _BOUNDS
)
"""Instructions of WebAssembly that load what a number is compared with before its conversion."""

_CALL: Final = re.compile(
    r"@llvm\.fpto([su])i\.sat\.i(8|16|32|64)\.(f32|f64)(?=\((?:float|double) (?:noundef )?%)"
)
_ATTRIBUTES: Final = re.compile(r"^define [^\n]*?(#\d+)", re.MULTILINE)
_REAL: Final = {"f32": "float", "f64": "double"}
_INDEFINITE: Final = {32: -(1 << 31), 64: -(1 << 63)}


def may_convert(wasm: bytes) -> bool:
    """Return whether an object may have conversions; False is certain."""
    return any(code in wasm for code in _COMPARED)


def as_gcc_converts(text: str) -> str:
    """Return the intermediate representation of a file with the conversions that GCC would have.

    Args:
        text: as clang writes it without having optimised it, made with `SATURATE`.
    """
    found = {(each[1], int(each[2]), each[3]) for each in _CALL.finditer(text)}
    if not found:
        return text
    replaced = _CALL.sub(lambda each: f"@{_name(each[1], int(each[2]), each[3])}", text)
    attributes = _ATTRIBUTES.search(text)
    end = f" alwaysinline {attributes[1] if attributes else ''}"
    return "\n".join([replaced, *(_definition(*each, end) for each in sorted(found))])


def _name(sign: str, bits: int, real: str) -> str:
    return f"plcsim.{real}.{sign}{bits}"


def _definition(sign: str, bits: int, real: str, end: str) -> str:
    """Return a function that converts."""
    lines = _unsigned(bits, real) if (sign, bits) in _WHOLE else _signed(bits, real)
    head = f"define internal i{bits} @{_name(sign, bits, real)}({_REAL[real]} %x){end} {{"
    return "\n".join([head, *(f"  {line}" for line in lines), "}"])


_WHOLE: Final = (("u", 32), ("u", 64))
"""Unsigned integers for which there is no wider signed one to convert to."""


def _signed(bits: int, real: str) -> Iterator[str]:
    """Yield the instructions that convert to a signed integer, and take the low bits of it."""
    whole = max(bits, 32)
    yield from _indefinite(whole, real, "%x")
    if bits < whole:
        yield f"%low = trunc i{whole} %whole to i{bits}"
    yield f"ret i{bits} %{'low' if bits < whole else 'whole'}"


def _unsigned(bits: int, real: str) -> Iterator[str]:
    """Yield those that convert to an unsigned one: by way of the signed one, half by half."""
    half, type_ = 2.0 ** (bits - 1), _REAL[real]
    yield f"%big = fcmp oge {type_} %x, {half:.1f}"
    yield f"%less = fsub {type_} %x, {half:.1f}"
    yield f"%small = select i1 %big, {type_} %less, {type_} %x"
    yield from _indefinite(bits, real, "%small")
    yield f"%upper = xor i{bits} %whole, {_INDEFINITE[bits]}"
    yield f"%all = select i1 %big, i{bits} %upper, i{bits} %whole"
    yield f"ret i{bits} %all"


def _indefinite(bits: int, real: str, value: str) -> Iterator[str]:
    """Yield those that convert to %whole, the integer indefinite where the number does not fit."""
    bound, type_ = 2.0 ** (bits - 1), _REAL[real]
    yield f"%below = fcmp olt {type_} {value}, {bound:.1f}"
    yield f"%above = fcmp ogt {type_} {value}, -{bound:.1f}"
    yield "%fits = and i1 %below, %above"
    yield f"%any = fptosi {type_} {value} to i{bits}"
    yield f"%some = freeze i{bits} %any"
    yield f"%whole = select i1 %fits, i{bits} %some, i{bits} {_INDEFINITE[bits]}"
