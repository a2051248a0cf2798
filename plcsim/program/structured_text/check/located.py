"""Direct addresses of standard files, ``%IX0.0``, ``%QW3``, ``%MD10``, and the variables AT them.

Inputs, outputs and markers are three areas of bytes that all programs of a controller share;
``%MW10`` are the bytes 20 and 21, as in CODESYS. A bit has a byte of its own, which has an address,
unless something that the program sees reaches the byte that the bit belongs to.

A variable AT an address is that place for the statements. The variable itself, which tags show,
takes what lies there behind the body of its PROGRAM; what changes it from outside (an initial
value, a force, Modbus) goes there before the body.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.program.structured_text.check import operations, typed
from plcsim.program.structured_text.check.kinds import BOOL, plain
from plcsim.program.structured_text.check.typed import Bit, Member, Symbol, Variable
from st_types.types.derived import ArrayType, StructType, UnionType
from st_types.types.elementary import BYTE, DWORD, LWORD, WORD

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.typed import Statement, Value
    from st_types.resolve.index import VariableEntry
    from st_types.resolve.scope import Scope

AREA_BYTES: Final = 1 << 16
"""Bytes of each area."""

_BIT_BYTES: Final = 1 << 12
"""Bytes at the start of each area whose bits may have bytes of their own."""

MOST_VALUES: Final = 1024
"""Single values of one variable AT an address."""

_AREAS: Final = "IQM"
_BITS_START: Final = len(_AREAS) * AREA_BYTES
SIZE: Final = _BITS_START + len(_AREAS) * _BIT_BYTES * 8
"""Bytes of all areas together."""

_ADDRESS: Final = re.compile(r"%([IQM])([XBWDL]?)(\d+)(?:\.([0-7]))?", re.IGNORECASE | re.ASCII)
_TYPES: Final[dict[str, Type]] = {"B": BYTE, "W": WORD, "D": DWORD, "L": LWORD}


class DirectPlace(NamedTuple):
    """A place in the areas.

    Attributes:
        area: I, Q or M.
        byte: number of its first byte.
        bit: of that byte; None for whole bytes.
        type: what lies there if no variable says otherwise.
    """

    area: str
    byte: int
    bit: int | None
    type: Type


def direct_place(text: str) -> DirectPlace | None:
    """Return the place that an address names, None for any other text and beyond the areas."""
    match = _ADDRESS.fullmatch(text)
    if match is None:
        return None
    area, letter, number, bit = match[1].upper(), match[2].upper(), int(match[3]), match[4]
    if letter in ("", "X"):
        byte, in_byte = (number, int(bit)) if bit else divmod(number, 8)
        found = DirectPlace(area, byte, in_byte, BOOL)
    elif bit:
        return None
    else:
        data_type = _TYPES[letter]
        found = DirectPlace(area, number * data_type.size, None, data_type)
    return found if found.byte + found.type.size <= AREA_BYTES else None


class DirectAddresses:
    """The areas as one program sees them.

    Args:
        scopes: whose texts it sees.

    Attributes:
        used: something names an address, or a variable AT one.
    """

    def __init__(self, scopes: Iterable[Scope]) -> None:
        self.used = False
        self._symbol = Symbol("%", BYTE, "direct", has_address=True, used=True)
        self._whole = {byte for scope in scopes for byte in _whole_bytes(scope)}

    def value(self, place: DirectPlace, data_type: Type | None = None) -> Value:
        """Return what lies at a place, by default as the address itself says."""
        self.used = True
        area, base = _AREAS.index(place.area), Variable(BYTE, self._symbol)
        byte = area * AREA_BYTES + place.byte
        if place.bit is None:
            return Member(data_type or place.type, base, byte)
        if place.byte >= _BIT_BYTES or (place.area, place.byte) in self._whole:
            return Bit(BOOL, Member(BYTE, base, byte), place.bit)
        bit = (area * _BIT_BYTES + place.byte) * 8 + place.bit
        return Member(BOOL, base, _BITS_START + bit)


def place_of(entry: VariableEntry) -> DirectPlace | None:
    """Return the place that a variable is declared AT, None where it is at none that is known."""
    if not entry.node.address or entry.is_constant:
        return None
    place = direct_place(entry.node.address)
    if place is None or entry.data_type is None:
        return None
    size = entry.data_type.size
    is_bit = place.bit is not None
    fits = plain(entry.data_type) is BOOL if is_bit else place.byte + size <= AREA_BYTES
    return place if fits else None


def _whole_bytes(scope: Scope) -> Iterator[tuple[str, int]]:
    """Yield the bytes that addresses of whole bytes in the text of a scope reach."""
    for file in scope.files:
        for match in _ADDRESS.finditer(file.tokens.source.text):
            place = direct_place(match.group())
            if place is not None and place.bit is None:
                for byte in range(place.byte, place.byte + place.type.size):
                    yield place.area, byte
    for entry in scope.index.variables:
        if entry.node.address:
            entry.resolver.complete(entry)
            place = place_of(entry)
            if place is not None and place.bit is None and entry.data_type is not None:
                for byte in range(place.byte, place.byte + entry.data_type.size):
                    yield place.area, byte


def synchronised(
    line: int, variable: Value, direct: Value
) -> tuple[list[Statement], list[Statement]]:
    """Return what happens before and after a body with a variable AT an address.

    Before it the variable goes to its address where something else has changed it.

    Args:
        line: of the body.
        variable: that tags show.
        direct: what the statements mean by its name.
    """
    before: list[Statement] = []
    after: list[Statement] = []
    for own, there in zip(_leaves(variable), _leaves(direct), strict=True):
        last = Variable(own.type, Symbol("last value AT an address", own.type, "hidden"))
        changed = operations.operation("<>", own, last)
        assert changed is not None
        arm = typed.Arm(line, changed, [typed.Assign(line, there, own)])
        before.append(typed.If(line, [arm], ()))
        after += [typed.Assign(line, own, there), typed.Assign(line, last, own)]
    return before, after


def values_in(data_type: Type) -> int:
    """Return the number of single values that a type has."""
    if isinstance(data_type, ArrayType):
        return int(data_type.count) * values_in(plain(data_type.element))
    if isinstance(data_type, StructType):
        return sum(values_in(plain(member.data_type)) for member in data_type.members)
    return 1


def _leaves(place: Value) -> Iterator[Value]:
    """Yield the single values in a place; of a UNION its first member."""
    data_type = place.type
    if isinstance(data_type, ArrayType):
        element = plain(data_type.element)
        for index in range(data_type.count):
            yield from _leaves(Member(element, place, index * element.size))
    elif isinstance(data_type, StructType):
        members = zip(data_type.members, data_type.offsets, strict=True)
        for member, offset in list(members)[: 1 if isinstance(data_type, UnionType) else None]:
            yield from _leaves(Member(plain(member.data_type), place, offset))
    else:
        yield place
