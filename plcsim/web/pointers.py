"""What pointers of a controller point to: types, which the shared image does not have.

There a pointer is a UDINT, as in PLC memory. The extension tells the service which members of
STRUCTs and programs are pointers and to what; it follows them on demand.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from plcsim.shared_image.directory import describe_type
from st_types.types.derived import ArrayType, ReferenceType, StructType, resolve_alias

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from plcsim.core.tag import Tag
    from st_types.types.elementary import DataType

MOST_TYPES: Final = 2000
"""Types pointed to that are told; pointers to others are shown as numbers."""


def key_of(struct: DataType[Any], member: str) -> str:
    """Return the name under which a member is noted."""
    return f"{struct.name}.{member}".upper()


def pointers_of(areas: Iterable[Tag]) -> dict[str, Any]:
    """Return, as values of JSON, the types pointed to, and by area and member which one it is.

    Args:
        areas: all variables of each program, and the global ones.
    """
    types: list[object] = []
    members: dict[str, dict[str, int]] = {}
    for area in areas:
        own = members.setdefault(area.path.upper(), {})
        for key, target in _found(area.data_type):
            described = describe_type(target)
            if described not in types and len(types) < MOST_TYPES:
                types.append(described)
            if described in types:
                own[key] = types.index(described)
    return {"types": types, "members": {path: own for path, own in members.items() if own}}


def _found(root: DataType[Any]) -> Iterator[tuple[str, DataType[Any]]]:
    """Yield each pointer in a type, and in what it points to, once."""
    waiting: list[DataType[Any]] = [root]
    seen: set[int] = set()
    while waiting:
        struct = _element(waiting.pop())
        if not isinstance(struct, StructType) or id(struct) in seen:
            continue
        seen.add(id(struct))
        for member in struct.members:
            inner = _element(member.data_type)
            if isinstance(inner, ReferenceType) and inner.target is not None:
                yield key_of(struct, member.name), inner.target
                waiting.append(inner.target)
            else:
                waiting.append(inner)


def _element(data_type: DataType[Any]) -> DataType[Any]:
    """Return what ARRAYs are of, aliases resolved."""
    found = resolve_alias(data_type)
    while isinstance(found, ArrayType):
        found = resolve_alias(found.element)
    return found
