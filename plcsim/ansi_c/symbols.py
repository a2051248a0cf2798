"""What objects define and what they need, to link of static libraries what is needed of them.

Source: WebAssembly tool conventions, "Linking", version 2. Archives would do it, but linkers differ
in what they ask of one.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.machine.reader import CUSTOM, FUNCTION, GLOBAL, IMPORTS, Reader, imports, sections

if TYPE_CHECKING:
    from collections.abc import Sequence

_SEGMENTS, _SYMBOL_TABLE = 5, 8
_OF_FUNCTION, _OF_DATA, _OF_GLOBAL, _OF_SECTION, _OF_TAG, _OF_TABLE = range(6)
_WEAK, _LOCAL, _UNDEFINED, _EXPLICIT_NAME = 1, 2, 0x10, 0x40
_KIND_OF_IMPORT: Final = {_OF_FUNCTION: FUNCTION, _OF_GLOBAL: GLOBAL}


class DataSymbol(NamedTuple):
    """A variable that an object holds.

    Attributes:
        place: of its flags in the object.
        segment: number of its segment.
        size: in bytes.
    """

    place: int
    segment: int
    size: int


class ObjectSymbols(NamedTuple):
    """Names that an object shares with others.

    Attributes:
        defined: what it holds.
        needed: what it uses and does not hold.
        weak: functions among what it holds for which another definition would be taken, with the
            places of their flags in the object.
        weak_data: variables likewise, with the numbers of their segments.
        data: other variables that it holds.
        segments: names of the segments.
    """

    defined: set[str]
    needed: set[str]
    weak: dict[str, int]
    weak_data: dict[str, int]
    data: dict[str, DataSymbol]
    segments: list[str]

    @property
    def valued(self) -> list[str]:
        """Weak variables, those that are marked _GLOBAL or _LOCAL, with an initial value."""
        return [n for n, s in self.weak_data.items() if not self._is_zero(s)]

    def _is_zero(self, segment: int) -> bool:
        return self.segments[segment].startswith(".bss")

    @property
    def without_value(self) -> dict[str, DataSymbol]:
        """Variables that are not weak, without an initial value."""
        return {name: each for name, each in self.data.items() if self._is_zero(each.segment)}


def symbols_of(wasm: bytes) -> ObjectSymbols:
    """Return the symbols of an object that the compiler has made.

    Raises:
        MachineError: it is none.
    """
    imported: dict[int, list[str]] = {FUNCTION: [], GLOBAL: []}
    found = ObjectSymbols(set(), set(), {}, {}, {}, [])
    for section in sections(wasm):
        if section.number == IMPORTS:
            for each in imports(wasm, section):
                if each.kind in imported:
                    imported[each.kind].append(each.name)
        elif section.number == CUSTOM and section.name == "linking":
            reader = Reader(wasm, section.start, section.end)
            reader.uleb()
            while reader.more:
                kind, size = reader.byte(), reader.uleb()
                end = reader.offset + size
                if kind == _SEGMENTS:
                    for _ in range(reader.uleb()):
                        found.segments.append(reader.name())
                        reader.uleb(), reader.uleb()
                elif kind == _SYMBOL_TABLE:
                    for _ in range(reader.uleb()):
                        _read(reader, imported, found)
                reader.offset = end
    return found


def _read(reader: Reader, imported: dict[int, list[str]], found: ObjectSymbols) -> None:
    """Read one symbol."""
    kind, place = reader.byte(), reader.offset
    flags = reader.uleb()
    name = ""
    if kind == _OF_DATA:
        name = reader.name()
        if not flags & _UNDEFINED:
            segment, _, size = reader.uleb(), reader.uleb(), reader.uleb()
            if flags & _WEAK:
                found.weak_data[name] = segment
            elif not flags & _LOCAL:
                found.data[name] = DataSymbol(place, segment, size)
    else:
        index = reader.uleb()
        if kind != _OF_SECTION and (flags & _EXPLICIT_NAME or not flags & _UNDEFINED):
            name = reader.name()
        elif kind in _KIND_OF_IMPORT:
            name = imported[_KIND_OF_IMPORT[kind]][index]
    if not name or flags & _LOCAL:
        return
    (found.needed if flags & _UNDEFINED else found.defined).add(name)
    if kind == _OF_FUNCTION and flags & _WEAK and not flags & _UNDEFINED:
        found.weak[name] = place


def chosen(wanted: Sequence[bytes], offered: Sequence[bytes]) -> list[int]:
    """Return which of some objects others need, by what these define, in their order.

    Args:
        wanted: objects that are linked anyway.
        offered: objects of static libraries; what a former one defines counts.
    """
    symbols = [symbols_of(wasm) for wasm in offered]
    own = [symbols_of(wasm) for wasm in wanted]
    defined = {name for each in own for name in each.defined}
    missing = {name for each in own for name in each.needed} - defined
    taken: set[int] = set()
    while True:
        found = next(
            (n for n, s in enumerate(symbols) if n not in taken and s.defined & missing), None
        )
        if found is None:
            return sorted(taken)
        taken.add(found)
        defined |= symbols[found].defined
        missing = (missing | symbols[found].needed) - defined


def without_weak(objects: Sequence[bytes]) -> list[bytes]:
    """Return objects whose weak functions are the module's own where nothing else defines them.

    A linker would let another module define them; the first definition is the one to take.
    """
    symbols = [symbols_of(wasm) for wasm in objects]
    settled = {name for each in symbols for name in each.defined - each.weak.keys()}
    changed = []
    for wasm, each in zip(objects, symbols, strict=True):
        content = bytearray(wasm)
        for name, place in each.weak.items():
            if name not in settled:
                content[place] &= ~_WEAK
                settled.add(name)
        changed.append(bytes(content))
    return changed


def with_common(objects: Sequence[bytes]) -> list[bytes]:
    """Return objects of C in which a variable without an initial value is one with its namesakes.

    So GCC had it up to version 9: ``int counter;`` in a header is one variable for all files. Of
    several the one with an initial value counts, else the largest one.
    """
    symbols = [symbols_of(wasm) for wasm in objects]
    changed = [bytearray(wasm) for wasm in objects]
    for name in {name for each in symbols for name in each.without_value}:
        same = [(each.without_value.get(name), n) for n, each in enumerate(symbols)]
        common = sorted(((s.size, s.place, n) for s, n in same if s), reverse=True)
        has_other = any(name in each.data and name not in each.without_value for each in symbols)
        for _, place, number in common if has_other else common[1:]:
            changed[number][place] |= _WEAK
    return [bytes(content) for content in changed]
