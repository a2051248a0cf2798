"""STRUCTs as ROS 1 messages: the way back of `crosnode.messages.struct_declarations`.

A STRUCT named ``pkg_Type`` is the message ``pkg/Type``; any other takes the package it is given. An
ARRAY with a member ``name_length`` of type UDINT behind it is of variable length. BYTE, WORD, DWORD
and LWORD are unsigned integers, an enumeration is an int32 with its values as constants. What ROS
has no type for is refused: TIME and the date types, WSTRING, references, ARRAYs of more than one
dimension, data blocks.
"""

from __future__ import annotations

import re
from itertools import zip_longest
from typing import TYPE_CHECKING

from crosnode.errors import DefinitionError
from crosnode.messages.struct_declarations import PRIMITIVES, TIMES
from st_types.types.derived import (
    ArrayType,
    DataBlockType,
    EnumerationType,
    Member,
    StringType,
    StructType,
    SubrangeType,
    resolve_alias,
)
from st_types.types.elementary import UDINT, ElementaryType

if TYPE_CHECKING:
    from collections.abc import Iterator

    from st_types.types.elementary import DataType

_ROS_TYPES = {
    **{declared: ros for ros, declared in reversed(PRIMITIVES.items())},
    "BYTE": "uint8",
    "WORD": "uint16",
    "CHAR": "uint8",
    "WCHAR": "uint16",
    "DWORD": "uint32",
    "LWORD": "uint64",
}
_TIMES = {struct: ros for ros, (struct, _) in TIMES.items()}
_STRUCT_NAME = re.compile(r"([a-z][a-z0-9_]*?)_([A-Z]\w*)", re.ASCII)
_FIELD_NAME = re.compile(r"[A-Za-z]\w*", re.ASCII)


def messages_from_struct(data_type: StructType[object], package: str = "plc") -> dict[str, str]:
    """Return the definitions of a STRUCT and of all STRUCTs in it, by message name.

    Args:
        data_type: the STRUCT.
        package: of STRUCTs whose name does not tell one.

    Raises:
        DefinitionError: a member has no ROS form; the message names it.
    """
    found: dict[str, str] = {}
    _add(data_type, package, found)
    return found


def message_name(data_type: StructType[object], package: str = "plc") -> str:
    """Return the name of the message of a STRUCT."""
    match = _STRUCT_NAME.fullmatch(data_type.name)
    return f"{match[1]}/{match[2]}" if match else f"{package}/{data_type.name}"


def _add(data_type: StructType[object], package: str, found: dict[str, str]) -> str:
    name = message_name(data_type, package)
    if isinstance(data_type, DataBlockType):
        raise DefinitionError(f"{data_type}: a function block has no ROS form.")
    if name not in found:
        found[name] = ""
        lines = list(_lines(data_type, package, found))
        del found[name]
        found[name] = "".join(line + "\n" for line in lines)
    return name


def _lines(data_type: StructType[object], package: str, found: dict[str, str]) -> Iterator[str]:
    members = zip_longest(data_type.members, data_type.members[1:])
    for member, following in members:
        where = f"{data_type}.{member.name}"
        if _FIELD_NAME.fullmatch(member.name) is None:
            raise DefinitionError(f"{where}: a ROS field cannot have this name.")
        kind = resolve_alias(member.data_type)
        if isinstance(kind, EnumerationType):
            of = _ROS_TYPES[kind.base.name]
            yield from (f"{of} {key}={value}" for key, value in kind.values.items())
        if isinstance(kind, ArrayType):
            element = _ros_type(where, kind.element, package, found)
            is_variable = _is_length(member, following)
            yield f"{element}[{'' if is_variable else _length(where, kind)}] {member.name}"
            if is_variable:
                next(members)
        else:
            yield f"{_ros_type(where, kind, package, found)} {member.name}"


def _is_length(array: Member, following: Member | None) -> bool:
    if following is None or following.data_type is not UDINT:
        return False
    return following.name.rstrip("_").upper() == f"{array.name}_length".rstrip("_").upper()


def _length(where: str, data_type: ArrayType[object]) -> int:
    if len(data_type.bounds) > 1:
        raise DefinitionError(f"{where}: an ARRAY of several dimensions has no ROS form.")
    return data_type.count


def _ros_type(where: str, declared: DataType[object], package: str, found: dict[str, str]) -> str:
    data_type = resolve_alias(declared)
    match data_type:
        case SubrangeType(base=base) | EnumerationType(base=base):
            return _ros_type(where, base, package, found)
        case StringType():
            return "string"
        case StructType() if data_type.name in _TIMES:
            return _TIMES[data_type.name]
        case StructType():
            return _add(data_type, package, found)
        case ElementaryType() if data_type.name in _ROS_TYPES:
            return _ROS_TYPES[data_type.name]
    raise DefinitionError(f"{where}: {data_type} has no ROS form.")
