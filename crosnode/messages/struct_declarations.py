"""ROS 1 messages, services and actions as STRUCTs.

| ROS                     | declaration                                                    |
|-------------------------|----------------------------------------------------------------|
| bool                    | BOOL                                                           |
| int8, byte              | SINT                                                           |
| uint8, char             | USINT                                                          |
| int16 ... uint64        | INT, UINT, DINT, UDINT, LINT, ULINT                            |
| float32, float64        | REAL, LREAL                                                    |
| string f                | f : STRING[pkg_Type_f_LENGTH]                                  |
| time, duration          | STRUCTs ros_time {sec, nsec : UDINT}, ros_duration (DINT)      |
| pkg/Type                | STRUCT pkg_Type                                                |
| T[3] f                  | f : ARRAY[0..2] OF T                                           |
| T[] f                   | f : ARRAY[0..pkg_Type_f_MAX] OF T and f_length : UDINT         |
| T NAME=value            | VAR CONSTANT pkg_Type_NAME : T := value                        |
| service pkg/Type        | STRUCTs pkg_TypeRequest, pkg_TypeResponse                      |
| action pkg/Type         | STRUCTs of the seven messages of actionlib                     |

A PLC variable has one size, so variable arrays and strings get a bound, each a constant of its own
that may be changed by hand; the length member says how many elements are valid. Names that differ
only in case get an underscore, for identifiers of IEC 61131-3 do not tell them apart.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final, NamedTuple

from crosnode.errors import DefinitionError
from crosnode.messages.definition import field_comments
from st_types.syntax.expressions import Expression, Literal, Name, Unary
from st_types.syntax.literals import parse_literal, string_literal
from st_types.syntax.printer import print_item
from st_types.syntax.tree import (
    ArraySpecification,
    Declaration,
    NamedType,
    StringSpecification,
    StructSpecification,
    TypeBlock,
    TypeSpecification,
    VariableBlock,
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from crosnode.messages.definition import Definition, Field, MessageConstant
    from crosnode.messages.registry import MessageTypes

PRIMITIVES: Final = {
    "bool": "BOOL",
    "int8": "SINT",
    "byte": "SINT",
    "uint8": "USINT",
    "char": "USINT",
    "int16": "INT",
    "uint16": "UINT",
    "int32": "DINT",
    "uint32": "UDINT",
    "int64": "LINT",
    "uint64": "ULINT",
    "float32": "REAL",
    "float64": "LREAL",
}
"""Data type of each primitive type of ROS but string."""

TIMES: Final = {"time": ("ros_time", "UDINT"), "duration": ("ros_duration", "DINT")}
"""STRUCT of each time type, and the type of its members sec and nsec."""


class Bounds(NamedTuple):
    """Sizes of what has none in ROS: elements of an array, characters of a string."""

    array: int = 16
    string: int = 80


class StructDeclaration(NamedTuple):
    """A STRUCT and the constants that it needs."""

    struct: Declaration
    constants: tuple[Declaration, ...]

    @property
    def name(self) -> str:
        """Name of the STRUCT."""
        return self.struct.name

    def typ(self) -> str:
        """Return the text of a .typ file."""
        return print_types([self])

    def var(self) -> str:
        """Return the text of a .var file, "" where no constant is needed."""
        return print_constants([self])


def print_types(declarations: Iterable[StructDeclaration]) -> str:
    """Return STRUCTs as one TYPE block."""
    return print_item(TypeBlock(0, [each.struct for each in declarations]))


def print_constants(declarations: Iterable[StructDeclaration]) -> str:
    """Return the constants of STRUCTs as one VAR block, "" where there is none."""
    constants = [constant for each in declarations for constant in each.constants]
    return print_item(VariableBlock(0, "VAR", ("CONSTANT",), constants)) if constants else ""


def struct_declarations(
    types: MessageTypes, names: Iterable[str], bounds: Bounds | None = None
) -> list[StructDeclaration]:
    """Return the STRUCTs of messages, services and actions and of all messages in them.

    Args:
        types: knows the messages.
        names: ``pkg/Type`` of each.
        bounds: sizes of variable arrays and strings.

    Returns:
        Each STRUCT once, behind those that it needs.

    Raises:
        MessageTypeError: a definition is missing or wrong, contains itself, or has no form in a
            PLC: an ARRAY without elements, a constant that is not finite.
    """
    conversion = _Conversion(types, bounds or Bounds())
    for name in names:
        for message_type in types.find(name).messages:
            conversion.add(message_type.definition)
    return list(conversion.found.values())


class _Conversion:
    """Collects declarations, each message once, those that another needs before it."""

    def __init__(self, types: MessageTypes, bounds: Bounds) -> None:
        self.found: dict[str, StructDeclaration] = {}
        self._types = types
        self._bounds = bounds

    def add(self, definition: Definition) -> str:
        """Add a message and all messages inside it; return the name of its STRUCT."""
        name = struct_name(definition.name)
        if name not in self.found:
            members, constants = _Members(self, definition, self._bounds).made()
            struct = Declaration(0, name, StructSpecification(0, members))
            self.found[name] = StructDeclaration(struct, constants)
        return name

    def add_message(self, name: str) -> str:
        """Add the message of a field."""
        return self.add(self._types.definition(name))

    def add_time(self, name: str, part: str) -> str:
        """Add a time or a duration."""
        members = [Declaration(0, each, NamedType(0, part)) for each in ("sec", "nsec")]
        struct = Declaration(0, name, StructSpecification(0, members))
        self.found.setdefault(name, StructDeclaration(struct, ()))
        return name


class _Members:
    """The members of one STRUCT, and the constants that they need."""

    def __init__(self, conversion: _Conversion, definition: Definition, bounds: Bounds) -> None:
        self._conversion = conversion
        self._definition = definition
        self._bounds = bounds
        self._prefix = struct_name(definition.name)
        self._taken: set[str] = set()
        self._constants: list[Declaration] = []

    def made(self) -> tuple[list[Declaration], tuple[Declaration, ...]]:
        """Return members and constants."""
        comments = field_comments(self._definition)
        members = [
            member
            for field in self._definition.fields
            for member in self._members(field, comments.get(field.name, ""))
        ]
        own = [_constant(self._prefix, constant) for constant in self._definition.constants]
        return members, (*self._constants, *own)

    def _members(self, field: Field, comment: str) -> Iterator[Declaration]:
        name = self._free(field.name)
        element = self._element(field, f"{self._prefix}_{name}")
        behind = f" (*{comment.replace('*)', '* )')}*)" if comment else ""
        if not field.is_array:
            yield Declaration(0, name, element, behind=behind)
            return
        if field.length == 0:
            raise DefinitionError(f"{self._prefix}.{name}: an ARRAY cannot have 0 elements.")
        last: Expression = (
            self._bound(f"{self._prefix}_{name}_MAX", self._bounds.array - 1, "highest index")
            if field.length is None
            else _number(field.length - 1)
        )
        array = ArraySpecification(0, [(_number(0), last)], element)
        yield Declaration(0, name, array, behind=behind)
        if field.length is None:
            length = self._free(f"{name}_length")
            yield Declaration(0, length, NamedType(0, "UDINT"), behind=" (*valid elements*)")

    def _element(self, field: Field, prefix: str) -> TypeSpecification:
        if field.base == "string":
            length = self._bound(f"{prefix}_LENGTH", self._bounds.string, "characters")
            return StringSpecification(0, "STRING", length)
        if field.base in PRIMITIVES:
            return NamedType(0, PRIMITIVES[field.base])
        if field.base in TIMES:
            return NamedType(0, self._conversion.add_time(*TIMES[field.base]))
        return NamedType(0, self._conversion.add_message(field.base))

    def _bound(self, name: str, value: int, comment: str) -> Name:
        kind = NamedType(0, "UDINT")
        constant = Declaration(0, name, kind, _number(value), behind=f" (*{comment}*)")
        self._constants.append(constant)
        return Name(0, name)

    def _free(self, name: str) -> str:
        while name.upper() in self._taken:
            name += "_"
        self._taken.add(name.upper())
        return name


def struct_name(message: str) -> str:
    """Return the name of the STRUCT of a message: ``pkg_Type`` for ``pkg/Type``."""
    return message.replace("/", "_")


def _number(value: int) -> Literal:
    return _literal(str(value))


def _literal(text: str) -> Literal:
    return Literal(0, text, parse_literal(text))


def _constant(prefix: str, constant: MessageConstant) -> Declaration:
    name = f"{prefix}_{constant.name}"
    if not (name.isascii() and name.isidentifier()):  # genmsg takes any words for it
        raise DefinitionError(f"{prefix}: no constant of a PLC can be called {constant.name!r}.")
    if isinstance(constant.value, str):
        data = constant.value.encode()
        initial: Expression = _literal(string_literal(data.decode("latin-1")))
        length = _number(max(1, len(data)))
        return Declaration(0, name, StringSpecification(0, "STRING", length), initial)
    if not math.isfinite(constant.value):
        raise DefinitionError(f"{name}: {constant.value} is no value of a PLC.")
    return Declaration(0, name, NamedType(0, PRIMITIVES[constant.primitive]), _value(constant))


def _value(constant: MessageConstant) -> Expression:
    value = constant.value
    assert not isinstance(value, str)
    if constant.primitive == "bool":
        return _literal("TRUE" if value else "FALSE")
    size = _literal(repr(abs(value)))
    return Unary(0, "-", size) if value < 0 else size
