"""Variables of compiled C by its debug information: their names, places and types.

Source: DWARF Debugging Information Format, version 4, chapters 2, 4, 5 and 7.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from plcsim.machine.errors import MachineError
from plcsim.machine.reader import Reader

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

_VERSION = 4

_CUT: Final = "the debug information ends in the middle of something"

_Abbreviation = tuple[int, bool, list[tuple[int, int, int]]]
"""Tag, whether there are children, and attributes: name, form, bytes of a plain number or 0."""

# tags
(ARRAY, ENUMERATION, MEMBER, POINTER, COMPILE_UNIT) = (0x01, 0x04, 0x0D, 0x0F, 0x11)
(STRUCTURE, TYPEDEF, UNION, SUBRANGE, BASE) = (0x13, 0x16, 0x17, 0x21, 0x24)
(CONST, ENUMERATOR, FUNCTION, VARIABLE, VOLATILE) = (0x26, 0x28, 0x2E, 0x34, 0x35)
ANNOTATION: Final = 0x6000  # DW_TAG_LLVM_annotation

# attributes
(LOCATION, NAME, SIZE, BIT_SIZE, CONST_VALUE) = (0x02, 0x03, 0x0B, 0x0D, 0x1C)
(UPPER_BOUND, COUNT, OFFSET, ENCODING, SPECIFICATION) = (0x2F, 0x37, 0x38, 0x3E, 0x47)
(TYPE, DATA_BIT_OFFSET) = (0x49, 0x6B)

_PLACE: Final = re.compile(rb"(?:\xed\x03.{4})?\x03(.{4})\x22?", re.DOTALL)
"""Of a variable: DW_OP_addr; newer clangs add (DW_OP_plus) it to a global (DW_OP_WASM_location)."""


@dataclass(slots=True)
class DebugEntry:
    """A debugging information entry.

    Attributes:
        tag: what it describes.
        attributes: by number.
        children: entries in it.
    """

    tag: int
    attributes: dict[int, Any]
    children: list[DebugEntry] = field(default_factory=list)

    @property
    def name(self) -> str:
        """Its name, "" where it has none."""
        text: str = self.attributes.get(NAME, "")
        return text


class DebugInfo:
    """The entries of a module.

    Args:
        section: gives the content of a custom section by its name.

    Raises:
        MachineError: it ends in the middle of something.
    """

    def __init__(self, section: Callable[[str], bytes]) -> None:
        self._strings = section(".debug_str")
        self._abbreviations = section(".debug_abbrev")
        self._info = section(".debug_info")
        self.entries: dict[int, DebugEntry] = {}
        self.units: list[DebugEntry] = []
        reader = Reader(self._info)
        while reader.more:
            start = reader.offset
            end = _number(reader, 4) + reader.offset
            if _number(reader, 2) == _VERSION:
                self._read_unit(reader, start, end)
            reader.offset = end

    def variables(self) -> Iterator[tuple[str, int, DebugEntry, frozenset[str]]]:
        """Yield name, offset in the module's data, type and marks of each variable with a place.

        Marks are what ``__attribute__((btf_decl_tag("...")))`` says.
        """
        for unit in self.units:
            yield from self._variables_in(unit)

    def _variables_in(
        self, parent: DebugEntry
    ) -> Iterator[tuple[str, int, DebugEntry, frozenset[str]]]:
        for entry in parent.children:
            if entry.tag == FUNCTION:
                yield from self._variables_in(entry)
            place = entry.attributes.get(LOCATION)
            if entry.tag != VARIABLE or not isinstance(place, bytes):
                continue
            declared = self.entries.get(entry.attributes.get(SPECIFICATION, -1), entry)
            kind = self.type_of(entry) or self.type_of(declared)
            found = _PLACE.fullmatch(place)
            if found and kind and declared.name:  # strings in the text have no name
                marks = {
                    each.attributes.get(CONST_VALUE, "")
                    for each in (*entry.children, *declared.children)
                    if each.tag == ANNOTATION and each.name == "btf_decl_tag"
                }
                yield declared.name, int.from_bytes(found[1], "little"), kind, frozenset(marks)

    def type_of(self, entry: DebugEntry) -> DebugEntry | None:
        """Return the type of a variable, a member, a pointer, a typedef; None for void."""
        return self.entries.get(entry.attributes.get(TYPE, -1))

    def _read_unit(self, reader: Reader, start: int, end: int) -> None:
        abbreviations = self._read_abbreviations(_number(reader, 4))
        reader.bytes(1)  # the size of an address
        try:
            last = self._read_entries(reader.offset, end, start, abbreviations)
        except (IndexError, KeyError, ValueError):
            raise MachineError(_CUT) from None
        if last > end:
            raise MachineError(_CUT)

    def _read_entries(
        self, at: int, end: int, unit: int, abbreviations: Mapping[int, _Abbreviation]
    ) -> int:
        """Read entries from an offset on; return where the last one ends.

        There are tens of thousands of them, so this is one loop over bytes.
        """
        data, entries, value = self._info, self.entries, self._value
        path: list[DebugEntry] = []
        siblings = self.units
        while at < end:
            place = at
            code = data[at]
            at += 1
            if code > 0x7F:
                code, at = _uleb(data, place)
            if code == 0:
                if path:
                    path.pop()
                siblings = path[-1].children if path else self.units
                continue
            tag, has_children, forms = abbreviations[code]
            attributes: dict[int, Any] = {}
            for name, form, size in forms:
                if size:
                    attributes[name] = int.from_bytes(data[at : at + size], "little")
                    at += size
                else:
                    attributes[name], at = value(form, at, unit)
            entry = entries[place] = DebugEntry(tag, attributes)
            siblings.append(entry)
            if has_children:
                path.append(entry)
                siblings = entry.children
        return at

    def _read_abbreviations(self, place: int) -> dict[int, _Abbreviation]:
        reader = Reader(self._abbreviations, place)
        found: dict[int, _Abbreviation] = {}
        while code := reader.uleb():
            tag, has_children = reader.uleb(), bool(reader.byte())
            forms = []
            while pair := (reader.uleb(), reader.uleb()):
                if pair == (0, 0):
                    break
                forms.append((*pair, _SIZES.get(pair[1], 0)))
            found[code] = tag, has_children, forms
        return found

    def _value(self, form: int, at: int, unit: int) -> tuple[Any, int]:
        """Return a value whose form is no plain number, and where it ends."""
        data = self._info
        if form in _REFERENCES:
            end = at + _REFERENCES[form]
            return unit + int.from_bytes(data[at:end], "little"), end
        if form in _BLOCKS:
            size = _BLOCKS[form]
            count, at = _fixed(data, at, size) if size else _uleb(data, at)
            return data[at : at + count], at + count
        if form == _STRING_REFERENCE:
            return _text(self._strings, int.from_bytes(data[at : at + 4], "little")), at + 4
        if form == _STRING:
            return _text(data, at), data.index(0, at) + 1
        if form == _SIGNED:
            number, end = _uleb(data, at)
            bits = 7 * (end - at)
            return number - (1 << bits) if number >> (bits - 1) else number, end
        if form == _UNSIGNED_REFERENCE:
            number, end = _uleb(data, at)
            return unit + number, end
        return _uleb(data, at) if form == _UNSIGNED else (1, at)  # the last: DW_FORM_flag_present


# forms; numbers, references and offsets by their bytes, blocks by the bytes of their length
_SIZES: Final = {0x01: 4, 0x0B: 1, 0x05: 2, 0x06: 4, 0x07: 8, 0x0C: 1, 0x17: 4, 0x20: 8, 0x10: 4}
_REFERENCES: Final = {0x11: 1, 0x12: 2, 0x13: 4, 0x14: 8}
_BLOCKS: Final = {0x0A: 1, 0x03: 2, 0x04: 4, 0x09: 0, 0x18: 0}
_STRING, _SIGNED, _STRING_REFERENCE, _UNSIGNED, _UNSIGNED_REFERENCE = 0x08, 0x0D, 0x0E, 0x0F, 0x15


def _number(reader: Reader, size: int) -> int:
    return int.from_bytes(reader.bytes(size), "little")


def _fixed(data: bytes, at: int, size: int) -> tuple[int, int]:
    return int.from_bytes(data[at : at + size], "little"), at + size


def _uleb(data: bytes, at: int) -> tuple[int, int]:
    """Return an unsigned LEB128 number of at most 64 bits, and where it ends."""
    value = 0
    for shift in range(0, 70, 7):
        byte = data[at]
        at += 1
        value |= (byte & 0x7F) << shift
        if byte < 0x80:
            return value, at
    raise ValueError(value)


def _text(data: bytes, place: int) -> str:
    return data[place : data.index(0, place)].decode("utf-8", "replace")
