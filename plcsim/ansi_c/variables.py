"""Variables that C defines itself, as one STRUCT: plain global ones, and static ones.

Their types come from the debug information. What has none that a tag could have, such as a pointer
to a function or a bit-field, is left out.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.ansi_c import debug_info as dwarf
from plcsim.ansi_c.debug_info import DebugInfo
from st_types.types.derived import (
    ArrayType,
    EnumerationType,
    Member,
    ReferenceType,
    StringType,
    StructType,
)
from st_types.types.elementary import ELEMENTARY
from st_types.types.layout import StructLayout

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from plcsim.ansi_c.debug_info import DebugEntry
    from plcsim.machine.shared_module import SharedModule
    from st_types.resolve.scope import Scope
    from st_types.types.elementary import DataType

_BY_ENCODING: Final = {
    # boolean, float, signed, signed character, unsigned, unsigned character
    2: {1: "BOOL"},
    4: {4: "REAL", 8: "LREAL"},
    5: {1: "SINT", 2: "INT", 4: "DINT", 8: "LINT"},
    6: {1: "SINT"},
    7: {1: "USINT", 2: "UINT", 4: "UDINT", 8: "ULINT"},
    8: {1: "USINT"},
}
_BY_NAME: Final = {
    "plcbit": "BOOL",
    "plcbyte": "BYTE",
    "plcword": "WORD",
    "plcdword": "DWORD",
    "plclword": "LWORD",
    "plctime": "TIME",
    "plcdate": "DATE",
    "plcdt": "DATE_AND_TIME",
    "plctod": "TIME_OF_DAY",
}
"""Names of bur/plctypes.h that say more than the size."""

_DEEPEST: Final = 16


class PlacedType(StructType[object]):
    """A STRUCT whose members lie where a compiler has put them.

    Args:
        name: of the type.
        members: in any order.
        layout: their offsets, and the size of the whole.
    """

    def __init__(self, name: str, members: Sequence[Member], layout: StructLayout) -> None:
        self._given = layout
        super().__init__(name, members)

    def _laid_out(self) -> StructLayout:
        return self._given


def own_variables(
    module: SharedModule, scope: Scope, declared: Collection[str], name: str
) -> StructType[object] | None:
    """Return the variables that a module defines itself, laid out as its data; None for none.

    Args:
        module: as it was linked.
        scope: whose types those in C stand for, where name and size are the same.
        declared: names of variables that are declared elsewhere.
        name: of the STRUCT.
    """
    if not module.memory_size:
        return None  # no data, so nothing has a place in it; most programs declare what they have
    types = _Types(DebugInfo(module.section), scope)
    found: dict[str, tuple[int, DataType[object]]] = {}
    retained: set[str] = set()
    for variable, offset, entry, marks in types.info.variables():
        if "RETAIN" in marks:  # _LOCAL_RETAIN, _GLOBAL_RETAIN
            retained.add(variable)
        data_type = types.of(entry)
        is_new = variable not in declared and variable not in found
        if is_new and data_type is not None and offset + data_type.size <= module.memory_size:
            found[variable] = offset, data_type
    if not found:
        return None
    members = [
        Member(variable, data_type, is_retained=variable in retained)
        for variable, (_, data_type) in found.items()
    ]
    offsets = tuple(offset for offset, _ in found.values())
    layout = StructLayout(offsets, module.memory_size, module.memory_alignment)
    return PlacedType(name, members, layout)


def global_variables(module: SharedModule, scope: Scope) -> dict[str, int]:
    """Return the sizes of the variables that a module defines as _GLOBAL, by name.

    Args:
        module: as it was linked.
        scope: as for `own_variables`.
    """
    if not module.memory_size or b"_GLOBAL\0" not in module.wasm:
        return {}
    types = _Types(DebugInfo(module.section), scope)
    marked = [(name, kind) for name, _, kind, marks in types.info.variables() if "_GLOBAL" in marks]
    return {name: found.size for name, kind in marked if (found := types.of(kind)) is not None}


class _Types:
    """Types of C as those of the controller."""

    def __init__(self, info: DebugInfo, scope: Scope) -> None:
        self.info = info
        self._scope = scope
        self._known: dict[int, DataType[object] | None] = {}

    def of(self, entry: DebugEntry, depth: int = 0) -> DataType[object] | None:
        if id(entry) not in self._known:
            self._known[id(entry)] = None if depth > _DEEPEST else self._made(entry, depth + 1)
        return self._known[id(entry)]

    def _made(self, entry: DebugEntry, depth: int) -> DataType[object] | None:
        match entry.tag:
            case dwarf.BASE:
                sizes = _BY_ENCODING.get(entry.attributes.get(dwarf.ENCODING, 0), {})
                return ELEMENTARY.get(sizes.get(entry.attributes.get(dwarf.SIZE, 0), ""))
            case dwarf.TYPEDEF if entry.name in _BY_NAME:
                return ELEMENTARY[_BY_NAME[entry.name]]
            case dwarf.TYPEDEF | dwarf.CONST | dwarf.VOLATILE:
                inner = self.info.type_of(entry)
                return None if inner is None else self.of(inner, depth)
            case dwarf.POINTER:
                return ReferenceType(None)
            case dwarf.ENUMERATION:
                return self._enumeration(entry)
            case dwarf.ARRAY:
                return self._array(entry, depth)
            case dwarf.STRUCTURE | dwarf.UNION:
                return self._struct(entry, depth)
        return None

    def _enumeration(self, entry: DebugEntry) -> DataType[object]:
        known = self._scope.find_type(entry.name) if entry.name else None
        if isinstance(known, EnumerationType):
            return known
        values = {
            each.name: _signed(each.attributes.get(dwarf.CONST_VALUE, 0))
            for each in entry.children
            if each.tag == dwarf.ENUMERATOR
        }
        return EnumerationType(entry.name or "enum", values) if values else ELEMENTARY["DINT"]

    def _array(self, entry: DebugEntry, depth: int) -> DataType[object] | None:
        inner = self.info.type_of(entry)
        counts = [_count(each) for each in entry.children if each.tag == dwarf.SUBRANGE]
        if inner is None or not counts or min(counts) <= 0:
            return None
        if len(counts) == 1 and counts[0] > 1 and self._is_character(inner):
            return StringType(counts[0] - 1)
        element = self.of(inner, depth)
        return None if element is None else ArrayType(element, [(0, n - 1) for n in counts])

    def _is_character(self, entry: DebugEntry) -> bool:
        while entry.tag in (dwarf.TYPEDEF, dwarf.CONST, dwarf.VOLATILE):
            inner = self.info.type_of(entry)
            if inner is None:
                return False
            entry = inner
        return entry.name == "char"

    def _struct(self, entry: DebugEntry, depth: int) -> DataType[object] | None:
        size = entry.attributes.get(dwarf.SIZE, 0)
        known = self._scope.find_type(entry.name) if entry.name else None
        if known is not None and known.size == size:
            return known
        found: dict[str, tuple[int, DataType[object]]] = {}
        for each in entry.children:
            kind = self.info.type_of(each)
            is_whole = not {dwarf.BIT_SIZE, dwarf.DATA_BIT_OFFSET} & each.attributes.keys()
            data_type = None if kind is None else self.of(kind, depth)
            if each.tag == dwarf.MEMBER and each.name and is_whole and data_type is not None:
                found[each.name] = each.attributes.get(dwarf.OFFSET, 0), data_type
        if not found:
            return None
        members = [Member(name, data_type) for name, (_, data_type) in found.items()]
        offsets = tuple(offset for offset, _ in found.values())
        return PlacedType(entry.name or "struct", members, StructLayout(offsets, size, 4))


def _count(subrange: DebugEntry) -> int:
    attributes = subrange.attributes
    if dwarf.COUNT in attributes:
        count: int = attributes[dwarf.COUNT]
        return count
    last: int = attributes.get(dwarf.UPPER_BOUND, -1)
    return last + 1


def _signed(value: int) -> int:
    return value - (1 << 32) if 1 << 31 <= value < 1 << 32 else value
