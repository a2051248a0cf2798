"""Messages as ``rostopic echo`` prints them: YAML, a field a line."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from crosnode.messages.json_values import to_json

if TYPE_CHECKING:
    from collections.abc import Iterator

    from crosnode.messages.message import Message
    from crosnode.messages.registry import MessageType, MessageTypes


def to_yaml(types: MessageTypes, message_type: MessageType, message: Message) -> str:
    """Return a message as lines of YAML."""
    return "".join(line + "\n" for line in _lines(to_json(types, message_type, message), ""))


def _lines(fields: dict[str, Any], indent: str) -> Iterator[str]:
    for name, value in fields.items():
        if isinstance(value, dict):
            yield f"{indent}{name}:" + ("" if value else " {}")
            yield from _lines(value, indent + "  ")
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            yield f"{indent}{name}:"
            yield from _elements(value, indent + "  ")
        else:
            yield f"{indent}{name}: {_plain(value)}"


def _elements(values: list[dict[str, Any]], indent: str) -> Iterator[str]:
    for value in values:
        first, *others = _lines(value, "") if value else ["{}"]
        yield f"{indent}- {first}"
        yield from (f"{indent}  {line}" for line in others)


def _plain(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_plain, value))}]"
    # Bytes that are not UTF-8 are lone surrogates: escapes of JSON, as which YAML has them too.
    text = json.dumps(value, ensure_ascii=False)
    return text.encode(errors="backslashreplace").decode()
