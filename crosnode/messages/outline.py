"""A type as an indented outline of constants and fields, as ``rosmsg show`` prints it."""

from __future__ import annotations

from itertools import chain
from typing import TYPE_CHECKING

from crosnode.messages.definition import SEPARATOR
from crosnode.messages.registry import ActionType, MessageType, MessageTypes, ServiceType

if TYPE_CHECKING:
    from collections.abc import Iterator

    from crosnode.messages.definition import Definition, Field

_INDENT = "  "


def outline(types: MessageTypes, found: MessageType | ServiceType | ActionType) -> str:
    """Return one line per constant and field, those of nested messages indented below theirs.

    The parts of a service or an action are separated as in their files.
    """
    parts = (found.goal, found.result, found.feedback) if isinstance(found, ActionType) else None
    lines = [_lines(types, part.definition, "") for part in parts or found.messages]
    return "\n".join(chain(lines[0], *((SEPARATOR, *each) for each in lines[1:])))


def _lines(types: MessageTypes, definition: Definition, indent: str) -> Iterator[str]:
    for constant in definition.constants:
        yield indent + constant.md5_line
    for field in definition.fields:
        yield f"{indent}{_full_type(field)} {field.name}"
        if not field.is_builtin:
            yield from _lines(types, types.definition(field.base), indent + _INDENT)


def _full_type(field: Field) -> str:
    _, bracket, length = field.declared.partition("[")
    return field.base + bracket + length
