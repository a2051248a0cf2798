"""What C would make of a value: its sign, and whether working it out twice changes anything."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.program.structured_text.check import typed
from plcsim.program.structured_text.check.kinds import (
    ANY_INT,
    TypeKind,
    is_unsigned,
    kind_of,
    number_type,
)
from st_types.types.derived import ReferenceType

if TYPE_CHECKING:
    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.typed import Value


def is_unsigned_in_c(node: Value) -> bool:
    """Return True for an integer that C holds as unsigned: of 32 bits or more, or made of one.

    8 and 16 bits become an int, whatever their sign.
    """
    data_type = node.type
    match node:
        case typed.Constant():
            is_large = isinstance(node.value, int) and node.value > 0x7FFF_FFFF
            return is_large or (data_type is not ANY_INT and _is_unsigned_word(data_type))
        case typed.Compare() | typed.Bit() | typed.Edge():
            return False
        case typed.Unary(operand=operand):
            return is_unsigned_in_c(operand)
        case typed.Binary(operator="/" | "MOD"):
            return is_unsigned(number_type(data_type))
        case typed.Binary():
            return _is_unsigned_chain(node)
    return _is_unsigned_word(data_type)


def _is_unsigned_chain(node: Value) -> bool:
    while isinstance(node, typed.Binary) and node.operator not in ("/", "MOD"):
        if is_unsigned_in_c(node.right):
            return True
        node = node.left
    return is_unsigned_in_c(node)


def is_pure(node: Value) -> bool:
    """Return True where nothing changes if a value is worked out twice, or not at all."""
    match node:
        case typed.Constant() | typed.Variable() | typed.This():
            return True
        case typed.Binary() | typed.Compare():
            return _is_pure_chain(node)
        case typed.Unary() | typed.Convert():
            return is_pure(node.operand)
        case typed.Member() | typed.Bit():
            return is_pure(node.base)
        case typed.Target():
            return is_pure(node.pointer)
        case typed.Address():
            return is_pure(node.place)
        case typed.Element():
            return is_pure(node.base) and all(map(is_pure, node.indices))
        case typed.Builtin():
            return all(map(is_pure, node.arguments))
    return False  # a call, or an edge, which remembers


def _is_pure_chain(node: Value) -> bool:
    while isinstance(node, typed.Binary | typed.Compare):
        if not is_pure(node.right):
            return False
        node = node.left
    return is_pure(node)


def _is_unsigned_word(data_type: Type) -> bool:
    if isinstance(data_type, ReferenceType):
        return True
    return (
        data_type.size >= 4 and is_unsigned(data_type) and kind_of(data_type) is not TypeKind.REAL
    )
