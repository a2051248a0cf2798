"""Variables by their names at run time: PV_xgetadr, PV_ninfo, PV_item.

A name is ``task:variable`` or that of a global variable, with members and indices behind it
(``mix:recipe.steps[3].time``); indices are those of the declaration.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.controller import Controller
from plcsim.library.executable import function
from plcsim.library.runtime import ERR_OK
from plcsim.library.sys_lib.interface import (
    ERR_BUR_ILLPTR,
    ERR_BUR_NOENTRY,
    ERR_BUR_TOOLONG_PVNAME,
    SYSLIB_IEC_TYPE_STRING,
    SYSLIB_IEC_TYPE_UDINT,
    SYSLIB_IEC_TYPE_USER_DEFINED,
    SYSLIB_IEC_TYPE_USER_DEFINED_2,
    SYSLIB_IEC_TYPE_WSTRING,
)
from plcsim.library.sys_lib.tasks import name_at
from st_types.types.derived import (
    ArrayType,
    EnumerationType,
    ReferenceType,
    StringType,
    StructType,
    SubrangeType,
    WStringType,
    resolve_alias,
)

if TYPE_CHECKING:
    from typing import Any

    from plcsim.core.context import Context
    from plcsim.core.tag import Tag
    from st_types.types.elementary import DataType

_CODES: Final = {
    "BOOL": 1,
    "SINT": 2,
    "INT": 3,
    "DINT": 4,
    "USINT": 5,
    "UINT": 6,
    "UDINT": 7,
    "REAL": 8,
    "ULINT": 10,
    "DATE_AND_TIME": 11,
    "TIME": 12,
    "DATE": 13,
    "LREAL": 14,
    "TIME_OF_DAY": 16,
    "BYTE": 17,
    "WORD": 18,
    "DWORD": 19,
    "LWORD": 20,
    "LINT": 23,
}
"""Numbers of the elementary types (IEC_DATATYPE_... of runtime.var)."""


def _find(context: Context, p_name: int) -> Tag | int:
    """Return a variable by the name at an address, or a status."""
    name = name_at(context, p_name)
    if name is None:
        return ERR_BUR_TOOLONG_PVNAME
    return find_variable(context, name) or ERR_BUR_NOENTRY


def find_variable(context: Context, name: str) -> Tag | None:
    """Return a variable by ``task:variable`` or the name of a global one, None for no such name.

    ``::`` before either is left out.
    """
    program, separator, rest = name.removeprefix("::").partition(":")
    if separator and not rest:
        return None
    is_local = separator and program and not rest.startswith(":")
    path = f"{program}.{rest}" if is_local else f"::{name.lstrip(':')}"
    controller = Controller.of(context)
    return None if controller is None else controller.tags.get(path)


def type_code(data_type: DataType[Any]) -> int:
    """Return the number of a type; an ARRAY has that of its elements."""
    kind = resolve_alias(data_type)
    match kind:
        case ArrayType(element=element):
            code = type_code(element)
            is_struct = code == SYSLIB_IEC_TYPE_USER_DEFINED
            return SYSLIB_IEC_TYPE_USER_DEFINED_2 if is_struct else code
        case StringType():
            return SYSLIB_IEC_TYPE_STRING
        case WStringType():
            return SYSLIB_IEC_TYPE_WSTRING
        case SubrangeType(base=base) | EnumerationType(base=base):
            return type_code(base)
        case ReferenceType():
            return SYSLIB_IEC_TYPE_UDINT
        case _:
            return _CODES.get(kind.name, SYSLIB_IEC_TYPE_USER_DEFINED)


def _dimension(data_type: DataType[Any]) -> tuple[int, int]:
    """Return the bytes of an element and the number of elements; members for a STRUCT."""
    kind = resolve_alias(data_type)
    if isinstance(kind, ArrayType):
        size = resolve_alias(kind.element).size
        return size, kind.size // size if size else 0
    return kind.size, len(kind.members) if isinstance(kind, StructType) else 1


@function("PV_xgetadr")
def address_of_variable(context: Context, p_name: int, p_address: int, p_length: int) -> int:
    """Store the address of a variable and its bytes; return a status."""
    if not (p_name and p_address and p_length):
        return ERR_BUR_ILLPTR
    found = _find(context, p_name)
    if isinstance(found, int):
        return found
    context.memory.check(p_length, 4)
    context.memory.write(p_address, found.address.to_bytes(4, "little"))
    context.memory.write(p_length, found.data_type.size.to_bytes(4, "little"))
    return ERR_OK


@function("PV_ninfo")
def type_of_variable(
    context: Context, p_name: int, p_type: int, p_length: int, p_dimension: int
) -> int:
    """Store number of type, bytes of an element, number of elements or members (UDINT, UDINT,
    UINT); return a status.
    """  # noqa: D205  # the parameters do not fit one line
    if not (p_name and p_type and p_length and p_dimension):
        return ERR_BUR_ILLPTR
    found = _find(context, p_name)
    if isinstance(found, int):
        return found
    size, count = _dimension(found.data_type)
    for address, bytes_ in ((p_type, 4), (p_length, 4), (p_dimension, 2)):
        context.memory.check(address, bytes_)
    context.memory.write(p_type, type_code(found.data_type).to_bytes(4, "little"))
    context.memory.write(p_length, size.to_bytes(4, "little"))
    context.memory.write(p_dimension, min(count, 0xFFFF).to_bytes(2, "little"))
    return ERR_OK


@function("PV_item")
def member_of_variable(context: Context, p_name: int, index: int, p_item: int) -> int:
    """Store the name of a member of a STRUCT; return a status."""
    if not (p_name and p_item):
        return ERR_BUR_ILLPTR
    found = _find(context, p_name)
    if isinstance(found, int):
        return found
    kind = resolve_alias(found.data_type)
    if not isinstance(kind, StructType) or index >= len(kind.members):
        return ERR_BUR_NOENTRY
    context.memory.write(p_item, kind.members[index].name.encode("latin-1", "replace") + b"\0")
    return ERR_OK
