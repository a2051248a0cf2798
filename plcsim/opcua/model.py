"""What the address space holds, before it is made of any library's nodes.

Programs, STRUCTs, data blocks of function blocks and ARRAYs of those are objects; variables of
elementary types, strings, enumerations, and ARRAYs of such are variables. A node has the path of
its tag for an identifier: ``ns=2;s=conveyor.motor.speed``, a global variable its bare name.

Source: OPC 30000 (PLCopen and OPC Foundation, OPC UA Information Model for IEC 61131-3), 6.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from itertools import product
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.errors import ConfigurationError
from plcsim.core.suggestion import did_you_mean
from plcsim.core.tag import Tag, leaves
from st_types.types.derived import (
    ArrayType,
    DataBlockType,
    ReferenceType,
    Section,
    StructType,
    resolve_alias,
)

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from st_types.types.elementary import DataType

GLOBALS: Final = "Globals"
"""Name of the object that holds the global variables."""


@dataclass(frozen=True)
class Note:
    """What the tag map says of a tag.

    Attributes:
        unit: engineering unit, "" for none.
        minimum: of a written value; None for what the type allows.
        maximum: likewise.
        description: "" for none.
    """

    unit: str = ""
    minimum: float | None = None
    maximum: float | None = None
    description: str = ""


@dataclass(frozen=True)
class Leaf:
    """A variable of the address space.

    Attributes:
        name: its browse name.
        tag: its path is the identifier.
        is_writable: a client with the right to write may.
        note: of the tag map.
    """

    name: str
    tag: Tag
    is_writable: bool
    note: Note = Note()  # a frozen value

    @property
    def element(self) -> DataType[Any]:
        """Its type, of an ARRAY that of an element."""
        data_type = self.tag.data_type
        return resolve_alias(data_type.element) if isinstance(data_type, ArrayType) else data_type

    @property
    def dimensions(self) -> tuple[int, ...]:
        """Elements in each dimension of an ARRAY; () for none."""
        data_type = self.tag.data_type
        if not isinstance(data_type, ArrayType):
            return ()
        return tuple(high - low + 1 for low, high in data_type.bounds)


@dataclass
class Branch:
    """An object of the address space.

    Attributes:
        name: its browse name.
        path: its identifier; of a program ``::`` and its name.
        type_name: of its STRUCT or function block, "" for a program.
        children: in declared order.
    """

    name: str
    path: str
    type_name: str = ""
    children: list[Branch | Leaf] = field(default_factory=list)

    def leaves(self) -> Iterator[Leaf]:
        """Yield the variables below."""
        for child in self.children:
            if isinstance(child, Leaf):
                yield child
            else:
                yield from child.leaves()


class ModelMaker:
    """Makes the branches of a controller.

    Args:
        patterns: paths or patterns of what is served; empty for all.
        notes: of the tag map, by path.
        most: variables.
        read_only: nothing can be written.
    """

    def __init__(
        self,
        patterns: Sequence[str] = (),
        notes: Mapping[str, Note] | None = None,
        *,
        most: int = 50_000,
        read_only: bool = False,
    ) -> None:
        self._patterns = [pattern.upper() for pattern in patterns]
        self._notes = {path.upper(): note for path, note in (notes or {}).items()}
        self._most = most
        self._read_only = read_only
        self._count = 0
        self._unmet = dict(zip(self._patterns, patterns, strict=True))

    def make(self, areas: Sequence[Tag]) -> list[Branch]:
        """Return a branch for each program, and one for the global variables.

        Raises:
            ConfigurationError: a pattern meets no tag, or there are too many variables.
        """
        branches: dict[str, Branch] = {}
        for area in areas:
            name = area.path or GLOBALS
            branch = branches.setdefault(area.path, Branch(name, f"::{name}"))
            branch.children += self._children(area, area.path)
        if self._unmet:
            missed = next(iter(self._unmet.values()))
            known = (tag.path for area in areas for tag in leaves(area, elements=False))
            near = did_you_mean(missed, known, most=3)
            raise ConfigurationError(f"opcua.tags: no tag {missed!r}{near}")
        return [branch for branch in branches.values() if branch.children]

    def _children(self, area: Tag, path: str) -> list[Branch | Leaf]:
        data_type = area.data_type
        if not isinstance(data_type, StructType):
            return []
        found: list[Branch | Leaf] = []
        is_block = isinstance(data_type, DataBlockType)
        for member, offset in zip(data_type.members, data_type.offsets, strict=True):
            if is_block and member.section is Section.INTERNAL:
                continue
            inner = f"{path}.{member.name}" if path else member.name
            tag = Tag(
                inner, resolve_alias(member.data_type), area.address + offset, area.is_constant
            )
            child = self._node(member.name, tag)
            if child is not None:
                found.append(child)
        return found

    def _node(self, name: str, tag: Tag) -> Branch | Leaf | None:
        data_type = tag.data_type
        if isinstance(data_type, StructType):
            branch = Branch(name, tag.path, data_type.name, self._children(tag, tag.path))
        elif isinstance(data_type, ArrayType) and _holds_parts(data_type):
            branch = Branch(name, tag.path, "", self._elements(tag, data_type))
        else:
            return self._leaf(name, tag)
        return branch if branch.children else None

    def _elements(self, tag: Tag, data_type: ArrayType[Any]) -> list[Branch | Leaf]:
        element = resolve_alias(data_type.element)
        ranges = (range(low, high + 1) for low, high in data_type.bounds)
        found = []
        for number, index in enumerate(product(*ranges)):
            name = f"[{','.join(map(str, index))}]"
            address = tag.address + number * element.size
            child = self._node(name, Tag(tag.path + name, element, address, tag.is_constant))
            if child is not None:
                found.append(child)
        return found

    def _leaf(self, name: str, tag: Tag) -> Leaf | None:
        if not self._is_served(tag.path):
            return None
        self._count += 1
        if self._count > self._most:
            raise ConfigurationError(
                f"opcua: more than {self._most} variables; name those to serve in opcua.tags, "
                "or raise opcua.nodes"
            )
        is_address = isinstance(tag.data_type, ReferenceType)
        is_writable = not (tag.is_constant or is_address or self._read_only)
        return Leaf(name, tag, is_writable, self._notes.get(tag.path.upper(), Note()))

    def _is_served(self, path: str) -> bool:
        if not self._patterns:
            return True
        upper = path.upper()
        met = [p for p in self._patterns if _meets(upper, p)]
        for pattern in met:
            self._unmet.pop(pattern, None)
        return bool(met)


def _meets(path: str, pattern: str) -> bool:
    """Return True for a tag that is named, that lies in what is named, or that a pattern meets.

    Brackets are those of an index; only ``*`` and ``?`` stand for something else.
    """
    if path == pattern or path.startswith((pattern + ".", pattern + "[")):
        return True
    return fnmatchcase(path, pattern.replace("[", "[[]"))


def _holds_parts(data_type: ArrayType[Any]) -> bool:
    return isinstance(resolve_alias(data_type.element), StructType | ArrayType)
