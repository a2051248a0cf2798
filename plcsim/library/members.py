"""Members of a data block by name: those that the version of a vendor's library has."""

from __future__ import annotations

from struct import Struct
from typing import TYPE_CHECKING, Any, NamedTuple

from st_types.types.derived import (
    ArrayType,
    EnumerationType,
    ReferenceType,
    StringType,
    StructType,
    resolve_alias,
)
from st_types.types.elementary import ElementaryType, Kind

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.core.context import Context
    from plcsim.core.memory import Memory
    from st_types.types.elementary import DataType

    FindType = Callable[[str], DataType[Any] | None]


class MemberPlace(NamedTuple):
    """Where a member lies in its structure.

    Attributes:
        data_type: of it.
        offset: of it.
        form: its bytes, where it is of an elementary type.
    """

    data_type: DataType[Any]
    offset: int
    form: Struct | None


class StructMembers:
    """The members of a structure.

    Args:
        data_type: of it.
    """

    def __init__(self, data_type: StructType[Any]) -> None:
        self._places: dict[str, MemberPlace] = {}
        self._found: dict[str, MemberPlace | None] = {}
        self._add("", data_type, 0)

    def _add(self, prefix: str, data_type: StructType[Any], start: int) -> None:
        for member, offset in zip(data_type.members, data_type.offsets, strict=True):
            kind = resolve_alias(member.data_type)
            name = f"{prefix}{member.name}"
            if isinstance(kind, StructType):
                self._add(f"{name}.", kind, start + offset)
            else:
                self._places[name.upper()] = MemberPlace(kind, start + offset, _form(kind))

    def find(self, name: str) -> MemberPlace | None:
        """Return where a member lies, None where there is none; names count in any case.

        Of ``Info.Ready`` the name may be ``Info__Ready``, too.
        """
        if name not in self._found:
            spelling = name.upper()
            place = self._places.get(spelling) or self._places.get(spelling.replace("__", "."))
            self._found[name] = place
        return self._found[name]


def _form(kind: DataType[Any]) -> Struct | None:
    if not isinstance(kind, ElementaryType):
        return None
    return Struct("<B" if kind.kind is Kind.BOOL else f"<{kind.code}")


class BlockVariables:
    """The values of a structure at an address.

    Args:
        memory: of the controller.
        members: of the structure.
        address: of it.
    """

    __slots__ = ("_address", "_members", "_memory")

    def __init__(self, memory: Memory, members: StructMembers, address: int) -> None:
        self._memory = memory
        self._members = members
        self._address = address

    @property
    def start(self) -> int:
        """The address of the structure."""
        return self._address

    def number(self, name: str) -> float:
        """Return a value, 0 where there is no such member."""
        place = self._members.find(name)
        if place is None:
            return 0
        at, form = self._address + place.offset, place.form
        found: float
        if form is None:
            found = self._memory.get(place.data_type, at)
        else:
            (found,) = form.unpack(self._memory.read(at, form.size))
        return found

    def is_true(self, name: str) -> bool:
        """Return a BOOL."""
        return bool(self.number(name))

    def address(self, *names: str) -> int:
        """Return the first of some addresses that is not 0."""
        return next((int(found) for name in names if (found := self.number(name))), 0)

    def set(self, **values: float | str) -> None:
        """Write values; what the structure does not have is left out."""
        write, start = self._memory.write, self._address
        for name, value in values.items():
            place = self._members.find(name)
            if place is None:
                continue
            data_type, offset, form = place
            if form is not None and isinstance(value, bool):
                write(start + offset, form.pack(value))
            else:
                self._memory.set(data_type, start + offset, fitting(data_type, value))

    def text(self, name: str, limit: int = 255) -> str:
        """Return the text at the address that an input holds, "" for address 0.

        Raises:
            PageFault: the address is wild.
        """
        address = self.address(name)
        return self._memory.string(address, limit + 1).decode("latin-1") if address else ""

    def own_text(self, name: str) -> str:
        """Return the value of a STRING, "" where there is none."""
        place = self._members.find(name)
        if place is None or not isinstance(place.data_type, StringType):
            return ""
        found: str = self._memory.get(place.data_type, self._address + place.offset)
        return found

    def place(self, name: str) -> int:
        """Return the address of a member itself, 0 where there is none."""
        place = self._members.find(name)
        return 0 if place is None else self._address + place.offset

    def element_address(self, name: str, index: int) -> int:
        """Return the address of an element of an ARRAY, counted from 0; 0 where there is none."""
        place = self._members.find(name)
        if place is None or not isinstance(place.data_type, ArrayType):
            return 0
        size = resolve_alias(place.data_type.element).size
        is_inside = index >= 0 and (index + 1) * size <= place.data_type.size
        return self._address + place.offset + index * size if is_inside else 0

    def element(self, name: str, index: int) -> float:
        """Return an element of an ARRAY, counted from 0; 0 where there is none."""
        place, at = self._members.find(name), self.element_address(name, index)
        if not at or place is None or not isinstance(place.data_type, ArrayType):
            return 0
        kind: DataType[Any] = resolve_alias(place.data_type.element)
        value: float = self._memory.get(kind, at)
        return value

    def set_element(self, name: str, index: int, value: float | str) -> None:
        """Write an element of an ARRAY, counted from 0; what is not there is left out."""
        place, at = self._members.find(name), self.element_address(name, index)
        if at and place is not None and isinstance(place.data_type, ArrayType):
            element = resolve_alias(place.data_type.element)
            self._memory.set(element, at, fitting(element, value))

    def count_of(self, name: str) -> int:
        """Return the number of elements of an ARRAY, 0 where there is none."""
        place = self._members.find(name)
        if place is None or not isinstance(place.data_type, ArrayType):
            return 0
        return place.data_type.size // resolve_alias(place.data_type.element).size

    def enumerator(self, name: str) -> str:
        """Return the name of the value of an enumeration, "" where it has none."""
        place, value = self._members.find(name), self.number(name)
        if place is None or not isinstance(place.data_type, EnumerationType):
            return ""
        return next((key for key, each in place.data_type.values.items() if each == value), "")

    def set_enumeration(self, name: str, ending: str) -> None:
        """Write the value of an enumeration whose name ends so, where it has one."""
        place = self._members.find(name)
        if place is None or not isinstance(place.data_type, EnumerationType):
            return
        for key, value in place.data_type.values.items():
            if key.upper().endswith(ending):
                self._memory.set(place.data_type, self._address + place.offset, value)
                return


def fitting(data_type: DataType[Any], value: float | str) -> float | str:
    """Return a value as a variable takes it: what a STRING has no character for is a ``?``."""
    if isinstance(value, str) and isinstance(data_type, StringType):
        return value.encode("latin-1", "replace").decode("latin-1")
    return value


class _Inputs:
    """Last inputs of blocks, by their addresses; a restart forgets them."""

    def __init__(self, _context: Context) -> None:
        self.last: dict[tuple[int, str], int] = {}


def changes(context: Context, address: int, name: str, value: int) -> bool:
    """Whether an input of a block has another value than in the call before; 0 before the first."""
    inputs = context.library(_Inputs).last
    before = inputs.get((address, name), 0)
    inputs[address, name] = value
    return before != value


def rises(context: Context, address: int, variables: BlockVariables, name: str) -> bool:
    """Whether an input of a block is TRUE and was not in the call before."""
    value = variables.is_true(name)
    return changes(context, address, name, value) and value


def target_of(data_type: StructType[Any], name: str) -> DataType[Any] | None:
    """Return the type that a REFERENCE TO leads to, None where a structure has no such member."""
    found = (each for each in data_type.members if each.name.upper() == name.upper())
    member = next(found, None)
    kind = None if member is None else resolve_alias(member.data_type)
    target = kind.target if isinstance(kind, ReferenceType) else None
    return None if target is None else resolve_alias(target)


class ReferredStructure:
    """The structure that a REFERENCE TO in the data blocks of one type leads to.

    Args:
        data_type: of the data blocks.
        name: of the member.
    """

    def __init__(self, data_type: StructType[Any], name: str) -> None:
        self._name = name
        target = target_of(data_type, name)
        self._members = StructMembers(target) if isinstance(target, StructType) else None

    def of(self, memory: Memory, variables: BlockVariables) -> BlockVariables | None:
        """Return its values, None where the address is 0, or the version of a library has none."""
        address = variables.address(self._name)
        if not address or self._members is None:
            return None
        return BlockVariables(memory, self._members, address)
