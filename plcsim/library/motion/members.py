"""Members of a data block by name: those that the version of a vendor's library has."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from st_types.types.derived import (
    EnumerationType,
    ReferenceType,
    StructType,
    resolve_alias,
)

if TYPE_CHECKING:
    from plcsim.core.memory import Memory
    from st_types.types.elementary import DataType


class MemberPlace(NamedTuple):
    """Where a member lies in its structure."""

    data_type: DataType[Any]
    offset: int


class StructMembers:
    """The members of a structure.

    Args:
        data_type: of it.
    """

    def __init__(self, data_type: StructType[Any]) -> None:
        self._places: dict[str, MemberPlace] = {}
        self._add("", data_type, 0)

    def _add(self, prefix: str, data_type: StructType[Any], start: int) -> None:
        for member, offset in zip(data_type.members, data_type.offsets, strict=True):
            kind = resolve_alias(member.data_type)
            name = f"{prefix}{member.name}"
            if isinstance(kind, StructType):
                self._add(f"{name}.", kind, start + offset)
            else:
                self._places[name.upper()] = MemberPlace(kind, start + offset)

    def find(self, name: str) -> MemberPlace | None:
        """Return where a member lies, None where there is none; names count in any case."""
        return self._places.get(name.upper())


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

    def number(self, name: str) -> float:
        """Return a value, 0 where there is no such member."""
        place = self._members.find(name)
        if place is None:
            return 0
        value: float = self._memory.get(place.data_type, self._address + place.offset)
        return value

    def is_true(self, name: str) -> bool:
        """Return a BOOL."""
        return bool(self.number(name))

    def address(self, *names: str) -> int:
        """Return the first of some addresses that is not 0."""
        return next((int(found) for name in names if (found := self.number(name))), 0)

    def set(self, **values: float) -> None:
        """Write values; what the structure does not have is left out."""
        for name, value in values.items():
            place = self._members.find(name.replace("__", "."))
            if place is not None:
                self._memory.set(place.data_type, self._address + place.offset, value)

    def set_enumeration(self, name: str, ending: str) -> None:
        """Write the value of an enumeration whose name ends so, where it has one."""
        place = self._members.find(name)
        if place is None or not isinstance(place.data_type, EnumerationType):
            return
        for key, value in place.data_type.values.items():
            if key.upper().endswith(ending):
                self._memory.set(place.data_type, self._address + place.offset, value)
                return


def referred(data_type: StructType[Any], name: str) -> StructMembers | None:
    """Return the members of what a REFERENCE TO in a structure leads to."""
    member = next((each for each in data_type.members if each.name.upper() == name.upper()), None)
    kind = None if member is None else resolve_alias(member.data_type)
    target = kind.target if isinstance(kind, ReferenceType) else None
    target = None if target is None else resolve_alias(target)
    return StructMembers(target) if isinstance(target, StructType) else None
