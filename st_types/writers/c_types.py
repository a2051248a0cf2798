"""C's fundamental types as data types, after figure 1.23 of the cROS thesis.

The thesis had to map the 64-bit integers to DINT and UDINT, which hold half of them, because the
version of Automation Studio at hand had no larger type; LINT and ULINT are the right ones. Names
are those of the figure: an underscore in front where the plain C name is not free.
"""

from __future__ import annotations

from st_types.syntax.tree import Declaration, NamedType, TypeBlock

C_TO_ST = {
    "int8_t": "SINT",
    "uint8_t": "USINT",
    "int16_t": "INT",
    "uint16_t": "UINT",
    "int32_t": "DINT",
    "uint32_t": "UDINT",
    "int64_t": "LINT",
    "uint64_t": "ULINT",
    "size_t": "UDINT",
    "int": "DINT",
    "unsigned int": "UDINT",
    "char": "SINT",
    "unsigned char": "USINT",
    "short": "INT",
    "unsigned short": "UINT",
    "long": "DINT",
    "unsigned long": "UDINT",
    "long long": "LINT",
    "unsigned long long": "ULINT",
    "float": "REAL",
    "double": "LREAL",
}
"""Data type of each C type on the 32-bit target, where ``long`` and pointers have 4 bytes."""


def alias_name(c_type: str) -> str:
    """Return the name of the alias: ``_int32_t``, ``unsignedShort``."""
    first, *others = c_type.split()
    return first + "".join(word.capitalize() for word in others) if others else f"_{first}"


def c_type_block() -> TypeBlock:
    """Return a TYPE block with an alias of each C type."""
    aliases = [Declaration(0, alias_name(c), NamedType(0, st)) for c, st in C_TO_ST.items()]
    return TypeBlock(0, aliases)
