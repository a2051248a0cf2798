"""The text of .msg, .srv and .action files, read as genmsg reads it.

The md5 of a type is taken over raw text (a constant ``1e-3`` is not ``0.001``), so parsing keeps
the words of each line as genmsg would write them into its md5 text; see wiki.ros.org/msg and
genmsg's ``msg_loader``. What genmsg refuses is refused here, with type and line number.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from crosnode.errors import DefinitionError, MessageTypeError

if TYPE_CHECKING:
    from collections.abc import Callable

HEADER = "std_msgs/Header"
INTEGERS = (
    "byte",
    "char",
    "int8",
    "uint8",
    "int16",
    "uint16",
    "int32",
    "uint32",
    "int64",
    "uint64",
)
PRIMITIVES = frozenset(("bool", "float32", "float64", "string", *INTEGERS))
BUILTINS = PRIMITIVES | {"time", "duration"}
SEPARATOR = "---"

_IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_FIELD_TYPE = re.compile(
    r"(?P<base>[A-Za-z]\w*(?:/[A-Za-z]\w*)?)(?P<array>\[(?P<length>\d*)\])?", re.A
)
_TYPE_NAME = re.compile(r"[A-Za-z]\w*/[A-Za-z]\w*", re.A)

MAX_FIXED_ARRAY = 1 << 28
"""Elements; a longer array does not travel in one message."""


class MessageConstant(NamedTuple):
    """A constant: ``value`` converted, ``md5_line`` as it enters the md5."""

    name: str
    primitive: str
    value: bool | int | float | str
    md5_line: str


class Field(NamedTuple):
    """A field of a message.

    Attributes:
        name: as in the definition.
        declared: the type word of the definition, array suffix included.
        base: builtin or full type name ``pkg/Name`` of one element.
        is_array: True for fixed and variable arrays.
        length: elements of a fixed array, None where variable or no array.
    """

    name: str
    declared: str
    base: str
    is_array: bool = False
    length: int | None = None

    @property
    def is_builtin(self) -> bool:
        """True where the elements are of a builtin type, time and duration included."""
        return self.base in BUILTINS


class Definition(NamedTuple):
    """A parsed message definition; ``name`` is ``pkg/Name``, ``text`` the raw text."""

    name: str
    text: str
    constants: tuple[MessageConstant, ...]
    fields: tuple[Field, ...]


def split_type_name(name: str) -> tuple[str, str]:
    """Split ``pkg/Name`` (or ``pkg/msg/Name``, ``pkg/srv/Name``) into package and base name.

    Raises:
        MessageTypeError: the text is not a type name.
    """
    short = re.sub(r"/(msg|srv|action)/", "/", name, count=1)
    if not _TYPE_NAME.fullmatch(short):
        raise MessageTypeError(f"{name!r} is not a type name; expected 'package/Type'.")
    package, _, base = short.partition("/")
    return package, base


def parse_message(name: str, text: str) -> Definition:
    """Parse the text of a .msg file, or of one part of a .srv or .action file.

    Args:
        name: full type name, ``pkg/Name``; its package resolves short type names.
        text: the raw text; lines may end in CR LF.

    Raises:
        DefinitionError: a line that genmsg refuses, or two fields of one name.
    """
    package, _ = split_type_name(name)
    text = text.replace("\r\n", "\n")
    constants: list[MessageConstant] = []
    fields: list[Field] = []
    for number, line in enumerate(text.split("\n"), 1):
        clean = line.split("#", 1)[0].strip()
        try:
            if "=" in clean:
                constants.append(_parse_constant(line, clean))
            elif clean:
                fields.append(_parse_field(clean, package))
        except ValueError as error:
            raise DefinitionError(f"{name}, line {number}: {error}") from error
    _check_unique(name, fields)
    return Definition(name, text, tuple(constants), tuple(fields))


def field_comments(definition: Definition) -> dict[str, str]:
    """Return the comments that stand behind fields in the text, by field."""
    found: dict[str, str] = {}
    for line in definition.text.split("\n"):
        clean, _, comment = line.partition("#")
        if comment.strip() and clean.strip() and "=" not in clean:
            found[_words(clean)[-1]] = comment.strip()
    return found


def split_parts(name: str, text: str, parts: int) -> tuple[str, ...]:
    """Cut a .srv or .action text at its ``---`` lines into exactly ``parts`` texts.

    A service without a separator has an empty response, and later separators of a service add
    nothing, as in genmsg.

    Raises:
        DefinitionError: an action has another number of parts.
    """
    texts = [""]
    for line in text.replace("\r\n", "\n").split("\n"):
        if not line.startswith(SEPARATOR):
            texts[-1] += line + "\n"
        elif parts != 2 or len(texts) < parts:
            texts.append("")
    if parts == 2 and len(texts) == 1:
        texts.append("")
    if len(texts) != parts:
        raise DefinitionError(f"{name}: {len(texts)} parts between '---' lines, expected {parts}.")
    return tuple(texts)


def _parse_field(clean: str, package: str) -> Field:
    words = _words(clean)
    if len(words) != 2:
        raise ValueError(f"expected 'type name', got {clean!r}.")
    declared, name = words
    match = _FIELD_TYPE.fullmatch(declared)
    if not match:
        raise ValueError(f"{declared!r} is not a field type.")
    if not _IDENTIFIER.fullmatch(name):
        raise ValueError(f"{name!r} is not a field name.")
    length = int(match["length"]) if match["length"] else None
    if length is not None and length > MAX_FIXED_ARRAY:
        raise ValueError(f"fixed array of {length} elements, at most {MAX_FIXED_ARRAY} can be.")
    base = HEADER if declared == "Header" else match["base"]
    if base not in BUILTINS and "/" not in base:
        base = f"{package}/{base}"
    return Field(name, declared, base, bool(match["array"]), length)


def _words(text: str) -> list[str]:
    """Cut at blanks; genmsg takes tabs for parts of words, except around them."""
    return [word.strip() for word in text.split(" ") if word.strip()]


def _parse_constant(line: str, clean: str) -> MessageConstant:
    primitive = clean.split(" ", 1)[0]
    if primitive not in PRIMITIVES:
        raise ValueError(f"{primitive!r} is not a type for a constant.")
    if primitive == "string":
        # Everything right of '=' is the value, comment signs included; the name starts after the
        # first blank of the raw line, so that leading blanks enter the md5 as in genmsg.
        head, _, value = line.partition("=")
        words = head[head.find(" ") + 1 :].strip()
    else:
        head, _, value = clean[len(primitive) :].partition("=")
        words = " ".join(_words(head))
        if "=" in value:
            raise ValueError(f"expected 'type NAME=value', got {clean!r}.")
    # genmsg takes any words for the name, so the md5 has them all; the last is what people mean.
    name, value = words.split(" ")[-1], value.strip()
    return MessageConstant(
        name, primitive, _convert(primitive, value), f"{primitive} {words}={value}"
    )


def _convert(primitive: str, value: str) -> bool | int | float | str:
    if primitive == "string":
        return value
    if primitive == "bool":
        return _BOOLEANS[value] if value in _BOOLEANS else bool(int(value))
    if primitive.startswith("float"):
        return float(value)
    return _in_range(primitive, int(value))


_BOOLEANS = {"True": True, "False": False}


def integer_range(primitive: str) -> tuple[int, int]:
    """Return the least and the greatest value of an integer type; byte is int8, char is uint8."""
    alias = {"byte": "int8", "char": "uint8"}.get(primitive, primitive)
    bits = int(alias.lstrip("uint"))
    return (0, (1 << bits) - 1) if alias[0] == "u" else (-(1 << bits - 1), (1 << bits - 1) - 1)


def _in_range(primitive: str, value: int) -> int:
    low, high = integer_range(primitive)
    if not low <= value <= high:
        raise ValueError(f"{value} is out of range of {primitive}.")
    return value


def _check_unique(name: str, fields: list[Field]) -> None:
    seen: set[str] = set()
    for field in fields:
        if field.name in seen:
            raise DefinitionError(f"{name}: two fields are named {field.name!r}.")
        seen.add(field.name)


def md5_text(definition: Definition, md5_of: Callable[[str], str]) -> str:
    """Return the text whose md5 identifies a message type.

    Constants come first, then fields in order; the type of a message field is replaced by its
    md5, without array suffix (genmsg ``compute_md5_text``).

    Args:
        definition: the message.
        md5_of: gives the md5 of a message type by its full name.
    """
    lines = [constant.md5_line for constant in definition.constants]
    lines += [
        f"{field.declared if field.is_builtin else md5_of(field.base)} {field.name}"
        for field in definition.fields
    ]
    return "\n".join(lines).strip()
