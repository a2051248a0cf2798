"""The directory: which variables the image holds, as text that another process can read.

A service knows the variables of all programs, with types and addresses, without loading a program.
Types are written out in full and laid out again by `st_types` on the other side.
"""

from __future__ import annotations

import hashlib
import json
from bisect import bisect_right
from dataclasses import dataclass, field
from functools import cached_property
from itertools import accumulate
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.tag import Tag, find_tag
from plcsim.shared_image.errors import ImageError
from st_types.types.derived import (
    AliasType,
    ArrayType,
    DataBlockType,
    EnumerationType,
    Member,
    ReferenceType,
    Section,
    StringType,
    StructType,
    SubrangeType,
    UnionType,
    WStringType,
)
from st_types.types.elementary import ALL_ELEMENTARY, UDINT, DataType, ElementaryType

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


@dataclass(frozen=True)
class Directory:
    """What the image holds.

    Attributes:
        project: name of the project.
        cycle_ns: the shortest cycle time.
        areas: all variables of each program, and the global ones, as one tag each.
        spans: (PLC address, bytes) of what a snapshot holds, one after another.
        services: what each service was given by its extension, by table of plc.toml.
        streams: bytes of the stream beside each ring, those of guests included.
    """

    project: str
    cycle_ns: int
    areas: Sequence[Tag]
    spans: Sequence[tuple[int, int]]
    services: Mapping[str, Any] = field(default_factory=dict)
    streams: Sequence[int] = ()

    @property
    def bank_size(self) -> int:
        """Bytes of a snapshot."""
        return sum(size for _, size in self.spans)

    def find(self, path: str) -> Tag:
        """Return the tag ``path``; case does not matter.

        Raises:
            TagError: there is no such tag; the message offers names that are near.
        """
        return find_tag(path, self.areas)

    def holds(self, tag: Tag) -> bool:
        """Return True for a tag that every snapshot holds."""
        try:
            self.offset_of(tag.address, tag.data_type.size)
        except ImageError:
            return False
        return True

    def offset_of(self, address: int, size: int) -> int:
        """Return where the bytes of a variable lie in a snapshot.

        Raises:
            ImageError: the snapshot does not hold them.
        """
        firsts, offsets = self._index
        found = bisect_right(firsts, address) - 1
        if found >= 0:
            first, length, offset = offsets[found]
            if address + size <= first + length:
                return offset + address - first
        raise ImageError(f"the image does not hold address 16#{address:08X}")

    @cached_property
    def _index(self) -> tuple[list[int], list[tuple[int, int, int]]]:
        """The spans by address, each with its offset in a snapshot."""
        offsets = accumulate((size for _, size in self.spans), initial=0)
        rows = sorted((*span, offset) for span, offset in zip(self.spans, offsets, strict=False))
        return [first for first, _, _ in rows], rows

    def to_bytes(self) -> bytes:
        """Return the directory as JSON."""
        text = {
            "project": self.project,
            "cycle_ns": self.cycle_ns,
            "areas": [
                [a.path, describe_type(a.data_type), a.address, a.is_constant] for a in self.areas
            ],
            "spans": list(self.spans),
            "services": self.services,
            "streams": list(self.streams),
        }
        return json.dumps(text, separators=(",", ":")).encode()


def directory_from(data: bytes) -> Directory:
    """Return the directory of `Directory.to_bytes`."""
    text = json.loads(data)
    return Directory(
        text["project"],
        text["cycle_ns"],
        [Tag(path, type_from(kind), *rest) for path, kind, *rest in text["areas"]],
        [(address, size) for address, size in text["spans"]],
        text["services"],
        text["streams"],
    )


def hash_of(data: bytes) -> int:
    """Return the layout hash: the first 8 bytes of the directory's SHA-256."""
    return int.from_bytes(hashlib.sha256(data).digest()[:8], "little")


_KEYS: Final = {DataBlockType: "data_block", UnionType: "union"}


def describe_type(data_type: DataType[Any]) -> object:
    """Return a type as strings, numbers, lists and dicts."""
    match data_type:
        case ElementaryType(name=name):
            return name
        case AliasType(target=target):
            return describe_type(target)
        case SubrangeType(name=name, base=base, minimum=low, maximum=high):
            return {"subrange": name, "of": base.name, "bounds": [low, high]}
        case StringType(length=length):
            return {"string": length}
        case WStringType(length=length):
            return {"wstring": length}
        case ReferenceType():
            return UDINT.name
        case EnumerationType(name=name, values=values, base=base):
            return {"enumeration": name, "of": base.name, "values": values}
        case ArrayType(element=element, bounds=bounds):
            return {"array": describe_type(element), "bounds": [list(b) for b in bounds]}
        case StructType(name=name, members=members):
            key = _KEYS.get(type(data_type), "struct")
            described = [[m.name, describe_type(m.data_type), m.section.value] for m in members]
            return {key: name, "members": described}
    raise TypeError(f"{data_type} cannot be described")


def type_from(text: Any) -> DataType[Any]:
    """Return the type that `describe_type` described."""
    match text:
        case str(name):
            return ALL_ELEMENTARY[name]
        case {"subrange": name, "of": base, "bounds": [low, high]}:
            return SubrangeType(name, _integer(base), low, high)
        case {"string": length}:
            return StringType(length)
        case {"wstring": length}:
            return WStringType(length)
        case {"enumeration": name, "of": base, "values": values}:
            return EnumerationType(name, values, base=_integer(base))
        case {"array": element, "bounds": bounds}:
            return ArrayType(type_from(element), [(low, high) for low, high in bounds])
        case {"data_block": name, "members": members}:
            return DataBlockType(name, _members(members))
        case {"union": name, "members": members}:
            return UnionType(name, _members(members))
        case {"struct": name, "members": members}:
            return StructType(name, _members(members))
    raise ImageError(f"{text!r} does not describe a type")


def _integer(name: str) -> Any:
    return ALL_ELEMENTARY[name]


def _members(members: list[Any]) -> list[Member]:
    return [
        Member(name, type_from(kind), None, Section(section)) for name, kind, section in members
    ]
