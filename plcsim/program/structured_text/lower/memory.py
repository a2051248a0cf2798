"""Where variables lie: segments, offsets, roots, and the segment that only the code knows."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.ansi_c.c_library import STACK_SIZE
from plcsim.core.errors import ConfigurationError
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.check import located
from plcsim.program.structured_text.check.kinds import ANY_REAL, TypeKind, kind_of
from st_types.types.derived import EnumerationType
from st_types.types.elementary import (
    BOOL,
    BYTE,
    CHAR,
    INT,
    LINT,
    LONG_TIMES,
    LREAL,
    LWORD,
    REAL,
    SINT,
    UINT,
    ULINT,
    USINT,
    WCHAR,
    WORD,
)
from st_types.types.layout import align_up
from st_types.types.values import encode

if TYPE_CHECKING:
    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.typed import Symbol
    from st_types.resolve.scope import Scope

_WIDTHS: Final[Mapping[Type, ir.Width]] = {
    BOOL: "u8",
    SINT: "s8",
    **dict.fromkeys((USINT, BYTE, CHAR), "u8"),
    INT: "s16",
    **dict.fromkeys((UINT, WORD, WCHAR), "u16"),
    **dict.fromkeys((LINT, ULINT, LWORD, *LONG_TIMES.values()), "w64"),
    REAL: "f32",
    **dict.fromkeys((LREAL, ANY_REAL), "f64"),
}
DIRECT: Final = "direct addresses"
"""The segment that all programs of a controller share."""

_ALIGNMENT_OF_STACK: Final = 16
"""Bytes, which clang takes for granted."""

MAX_HIDDEN: Final = 1 << 24
"""Bytes of a variable that lives for one call, or of a constant that is no single value."""

SCALARS: Final = frozenset(
    [
        TypeKind.BOOL,
        TypeKind.INTEGER,
        TypeKind.REAL,
        TypeKind.TIME,
        TypeKind.DATE,
        TypeKind.REFERENCE,
    ]
)
"""Kinds whose values fit into one value of the stack."""


def width_of(data_type: Type) -> ir.Width:
    """Return how a scalar lies in memory; a time and an address take 32 bits."""
    if isinstance(data_type, EnumerationType):
        data_type = data_type.base
    return _WIDTHS.get(data_type, "w32")


def is_scalar(data_type: Type) -> bool:
    """Return True for what fits into one value of the stack."""
    return kind_of(data_type) in SCALARS


_CODES: Final[Mapping[ir.Width, str]] = {
    "s8": "<b",
    "u8": "<B",
    "s16": "<h",
    "u16": "<H",
    "w32": "<i",
    "w64": "<q",
    "f32": "<f",
    "f64": "<d",
}


def constant_of(data: bytes, width: ir.Width) -> ir.Const:
    """Return the value that bytes in memory stand for."""
    (value,) = struct.unpack(_CODES[width], data)
    return ir.Const(ir.VALUE_TYPE[width], value)


class Spot(NamedTuple):
    """Where a variable lies: in which segment, and how many bytes from its start."""

    segment: ir.Segment
    offset: int


Areas = Mapping["Scope", Mapping[str, Spot]]
"""The places of declared variables, by scope and name; a constant may have none."""


class Hidden:
    """The segment of what only the code knows: edges, literals, constants, frames, results."""

    def __init__(self) -> None:
        self.segment = ir.Segment("hidden")
        self._image = bytearray()
        self._literals: dict[bytes, int] = {}

    def place(self, size: int, alignment: int, data: bytes = b"") -> int:
        """Return the offset of ``size`` new bytes that begin with ``data``, then zeros."""
        self._image += bytes(-len(self._image) % alignment)
        offset = len(self._image)
        self._image += data[:size].ljust(size, b"\0")
        return offset

    def literal(self, data: bytes, alignment: int) -> int:
        """Return the offset of bytes that nothing changes; equal ones are kept once."""
        found = self._literals.get(data)
        if found is None:
            found = self._literals[data] = self.place(len(data), alignment, data)
        return found

    def finish(self) -> ir.Segment:
        """Return the segment with all that was placed."""
        self.segment.size = len(self._image)
        self.segment.data = bytes(self._image)
        return self.segment


class FrameVariables:
    """What one call of a function that may call itself has on the stack of compiled programs.

    Its places have root 0: another call of the function may reach them by an address.

    Args:
        local: holds its address.

    Attributes:
        size: bytes so far.
    """

    def __init__(self, local: int) -> None:
        self.local = local
        self.size = 0

    def place(self, data_type: Type) -> ir.Place:
        """Return the place of a new variable, which holds anything."""
        offset = align_up(self.size, data_type.alignment)
        self.size = offset + data_type.size
        if self.size > STACK_SIZE:
            message = f"a FUNCTION that calls itself has {self.size} bytes of variables"
            raise ConfigurationError(f"{message}: more than its stack, which has {STACK_SIZE}")
        return ir.Place(ir.Local("i32", self.local), offset)

    def finish(self) -> ir.StackFrame:
        """Return the frame with all that was placed."""
        return ir.StackFrame(align_up(self.size, _ALIGNMENT_OF_STACK), self.local)


class VariablePlaces:
    """The places of all variables of a module.

    Args:
        areas: where the variables of scopes lie.
        hidden: takes what is declared nowhere.

    Attributes:
        direct: the segment of direct addresses, once one of them is named.
    """

    def __init__(self, areas: Areas, hidden: Hidden) -> None:
        self._areas = areas
        self._hidden = hidden
        self._places: dict[Symbol, ir.Place] = {}
        self._roots = 0
        self.direct: ir.Segment | None = None

    def new_root(self) -> int:
        """Return the number of a variable that overlaps no other."""
        self._roots += 1
        return self._roots

    def place(self, symbol: Symbol) -> ir.Place:
        """Return the place of a variable in a segment."""
        found = self._places.get(symbol)
        if found is None:
            found = self._places[symbol] = self._made(symbol)
        return found

    def _made(self, symbol: Symbol) -> ir.Place:
        scope, spot = symbol.scope, None
        if scope is not None and scope in self._areas and symbol.storage != "frame":
            spot = self._areas[scope].get(symbol.name)
        is_own = symbol.storage != "global" and not symbol.has_address
        if symbol.storage == "direct":
            self.direct = self.direct or ir.Segment(DIRECT, located.SIZE, alignment=8)
            spot = Spot(self.direct, 0)
        if spot is None:
            if symbol.type.size > MAX_HIDDEN:
                message = f"{symbol.name} has {symbol.type.size} bytes"
                raise ConfigurationError(f"{message}: too many for a variable of a FUNCTION")
            image = self.image(symbol)
            offset = self._hidden.place(symbol.type.size, symbol.type.alignment, image)
            spot = Spot(self._hidden.segment, offset)
        return ir.Place(spot.segment, spot.offset, self.new_root() if is_own else 0)

    @staticmethod
    def image(symbol: Symbol) -> bytes:
        """Return the bytes of a variable at its start."""
        data_type: Any = symbol.type
        return encode(data_type, symbol.initial)
