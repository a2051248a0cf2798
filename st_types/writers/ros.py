"""ROS 1 messages and services as STRUCTs.

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

A PLC variable has one size, so variable arrays and strings get a bound, each a constant of its own
that may be changed by hand; the length member says how many elements are valid. Names that differ
only in case get an underscore, for identifiers of IEC 61131-3 do not tell them apart.
"""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, NamedTuple

from st_types.errors import DeclarationError
from st_types.syntax.expressions import Expression, Literal, Name, Unary
from st_types.syntax.literals import parse_literal, string_literal
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
    from collections.abc import Callable, Iterator

PRIMITIVES = {
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

TIMES = {"time": ("ros_time", "UDINT"), "duration": ("ros_duration", "DINT")}
"""STRUCT of each time type, and the type of its members sec and nsec."""

MAX_NESTING = 40
"""Most messages that lie one inside the other."""


MAX_ARRAY = 2**31 - 1
"""Most elements of an ARRAY."""


class Limits(NamedTuple):
    """Bounds of what has none in ROS: elements of an array, characters of a string."""

    array: int = 16
    string: int = 80


VARIABLE = -1
"""Length of an array without a fixed one."""


class Field(NamedTuple):
    """A field of a message; ``length`` is None for no array, `VARIABLE` for a variable one."""

    name: str
    base: str
    length: int | None
    comment: str


class Message(NamedTuple):
    """A parsed definition: constants as (type, name, value)."""

    name: str
    fields: tuple[Field, ...]
    constants: tuple[tuple[str, str, str], ...]


class RosDeclarations(NamedTuple):
    """Declarations of messages: their STRUCTs and the constants that these need."""

    types: TypeBlock
    constants: VariableBlock


_FIELD = re.compile(r"([A-Za-z]\w*(?:/[A-Za-z]\w*)?)(?:\[(\d{0,20})\])?\s+([A-Za-z]\w*)", re.ASCII)
_CONSTANT = re.compile(r"([a-z]\w*)\s+([A-Za-z]\w*)\s*=\s*(.*)", re.ASCII)


def parse_message(name: str, text: str) -> Message:
    """Parse a message definition.

    Args:
        name: ``pkg/Type``; its package completes the names of types without one.
        text: the text of a .msg file.

    Raises:
        DeclarationError: a line is no field and no constant; type and line number are named.
    """
    fields: list[Field] = []
    constants: list[tuple[str, str, str]] = []
    for number, line in enumerate(text.splitlines(), 1):
        clean, _, comment = line.partition("#")
        clean = clean.strip()
        if constant := _CONSTANT.fullmatch(line.strip() if "string" in clean[:6] else clean):
            constants.append((constant[1], constant[2], constant[3].strip()))
        elif field := _FIELD.fullmatch(clean):
            length = None if field[2] is None else int(field[2] or VARIABLE)
            fields.append(Field(field[3], _full_name(field[1], name), length, comment.strip()))
        elif clean:
            raise DeclarationError(f"{name}, line {number}: {clean!r} is no field and no constant.")
    return Message(name, tuple(fields), tuple(constants))


def _full_name(base: str, message: str) -> str:
    if base in PRIMITIVES or base in TIMES or base == "string" or "/" in base:
        return base
    return "std_msgs/Header" if base == "Header" else f"{message.partition('/')[0]}/{base}"


def structs_from_ros(
    name: str, read: Callable[[str, str], str | None], limits: Limits | None = None
) -> RosDeclarations:
    """Return the STRUCTs of a message or of both parts of a service, and of all they contain.

    Args:
        name: ``pkg/Type``.
        read: gives the text of a definition by its name and its kind, ``msg`` or ``srv``; None if
            there is none.
        limits: bounds of variable arrays and strings.

    Raises:
        DeclarationError: a definition is missing or wrong, or contains itself.
    """
    if not re.fullmatch(r"[A-Za-z]\w*/[A-Za-z]\w*", name, re.ASCII):
        raise DeclarationError(f"{name!r} is no type name; pkg/Type was expected.")
    conversion = _Conversion(read, limits or Limits())
    text = read(name, "msg")
    if text is not None:
        conversion.add(parse_message(name, text))
        return conversion.declarations()
    text = read(name, "srv")
    if text is None:
        raise DeclarationError(f"no message and no service is called {name}.")
    request, _, response = re.sub(r"(?m)^---.*$", "---", text).partition("---")
    conversion.add(parse_message(f"{name}Request", request))
    conversion.add(parse_message(f"{name}Response", response))
    return conversion.declarations()


class _Conversion:
    """Collects declarations, each message once, those that another needs before it."""

    def __init__(self, read: Callable[[str, str], str | None], limits: Limits) -> None:
        self._read = read
        self._limits = limits
        self._open: list[str] = []
        self._types: dict[str, Declaration] = {}
        self._constants: list[Declaration] = []

    def declarations(self) -> RosDeclarations:
        """Return all that was added."""
        types = TypeBlock(0, list(self._types.values()))
        return RosDeclarations(types, VariableBlock(0, "VAR", ("CONSTANT",), self._constants))

    def add(self, message: Message) -> None:
        """Add a message and all messages inside it.

        Raises:
            DeclarationError: a definition is missing or wrong, or contains itself.
        """
        if message.name in self._open or len(self._open) > MAX_NESTING:
            path = " -> ".join([*self._open[-5:], message.name])
            raise DeclarationError(f"{message.name} contains itself: {path}.")
        self._open.append(message.name)
        prefix = struct_name(message.name)
        taken: set[str] = set()
        members = [d for field in message.fields for d in self._members(field, prefix, taken)]
        for constant in message.constants:
            self._constants.append(_constant(prefix, *constant))
        self._open.pop()
        self._types[prefix] = Declaration(0, prefix, StructSpecification(0, members))

    def _members(self, field: Field, prefix: str, taken: set[str]) -> Iterator[Declaration]:
        name = _free(field.name, taken)
        element = self._element(field, f"{prefix}_{name}")
        behind = f" (*{field.comment.replace('*)', '* )')}*)" if field.comment else ""
        if field.length is None:
            yield Declaration(0, name, element, behind=behind)
            return
        if field.length == 0 or field.length > MAX_ARRAY:
            raise DeclarationError(
                f"{prefix}.{name}: an ARRAY cannot have {field.length} elements."
            )
        last: Expression = _number(field.length - 1)
        if field.length == VARIABLE:
            last = self._bound(f"{prefix}_{name}_MAX", self._limits.array - 1, "highest index")
        array = ArraySpecification(0, [(_number(0), last)], element)
        yield Declaration(0, name, array, behind=behind)
        if field.length == VARIABLE:
            length = _free(f"{name}_length", taken)
            yield Declaration(0, length, NamedType(0, "UDINT"), behind=" (*valid elements*)")

    def _element(self, field: Field, prefix: str) -> TypeSpecification:
        if field.base == "string":
            length = self._bound(f"{prefix}_LENGTH", self._limits.string, "characters")
            return StringSpecification(0, "STRING", length)
        if field.base in PRIMITIVES:
            return NamedType(0, PRIMITIVES[field.base])
        if field.base in TIMES:
            return NamedType(0, self._time(*TIMES[field.base]))
        name = struct_name(field.base)
        if name not in self._types:
            text = self._read(field.base, "msg")
            if text is None:
                raise DeclarationError(f"{self._open[-1]}: no message is called {field.base}.")
            self.add(parse_message(field.base, text))
        return NamedType(0, name)

    def _time(self, name: str, part: str) -> str:
        members = [Declaration(0, each, NamedType(0, part)) for each in ("sec", "nsec")]
        self._types.setdefault(name, Declaration(0, name, StructSpecification(0, members)))
        return name

    def _bound(self, name: str, value: int, comment: str) -> Name:
        number = _number(value)
        kind = NamedType(0, "UDINT")
        self._constants.append(Declaration(0, name, kind, number, behind=f" (*{comment}*)"))
        return Name(0, name)


def struct_name(message: str) -> str:
    """Return the name of the STRUCT of a message: ``pkg_Type`` for ``pkg/Type``."""
    return message.replace("/", "_")


def _free(name: str, taken: set[str]) -> str:
    while name.upper() in taken:
        name += "_"
    taken.add(name.upper())
    return name


def _number(value: int) -> Literal:
    return _literal(str(value))


def _literal(text: str) -> Literal:
    return Literal(0, text, parse_literal(text))


def _constant(prefix: str, base: str, name: str, value: str) -> Declaration:
    if base == "string":
        data = value.encode()
        initial: Expression = _literal(string_literal(data.decode("latin-1")))
        length = _number(max(1, len(data)))
        kind: TypeSpecification = StringSpecification(0, "STRING", length)
        return Declaration(0, f"{prefix}_{name}", kind, initial)
    try:
        kind = NamedType(0, PRIMITIVES[base])
        initial = _value(base, value)
    except (KeyError, ValueError):
        message = f"{prefix}, constant {name}: {value!r} is no value of {base}."
        raise DeclarationError(message) from None
    return Declaration(0, f"{prefix}_{name}", kind, initial)


def _value(base: str, text: str) -> Expression:
    if base == "bool":
        return _literal({"True": "TRUE", "False": "FALSE", "1": "TRUE", "0": "FALSE"}[text])
    number = float(text) if base.startswith("float") else int(text)
    if not math.isfinite(number):
        raise ValueError
    size = _literal(repr(abs(number)))
    return Unary(0, "-", size) if number < 0 else size
