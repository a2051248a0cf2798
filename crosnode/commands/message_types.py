"""What the commands of ``plcsim ros`` about types do; `crosnode.commands.ros` declares them."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from crosnode.errors import MessageTypeError, MessageValueError
from crosnode.messages import MessageType, MessageTypes, from_json, to_json
from crosnode.messages.outline import outline

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

STANDARD_INPUT: Final = "-"


def show(arguments: argparse.Namespace) -> None:
    """Print the outline of a type."""
    types = message_types(arguments.path)
    _print(outline(types, types.find(arguments.type)))


def md5(arguments: argparse.Namespace) -> None:
    """Print a line for each type that is found; the first error is raised after the last line."""
    types, fault = message_types(arguments.path), None
    for name in arguments.types:
        try:
            _print(f"{name} {types.find(name).md5sum}")
        except MessageTypeError as error:
            fault = fault or error
    if fault:
        raise fault


def encode(arguments: argparse.Namespace) -> None:
    """Print the bytes of the message that a JSON object stands for."""
    types = message_types(arguments.path)
    message_type = _message_type(types, arguments.type)
    try:
        value = json.loads(_text(arguments.json))
    except (ValueError, RecursionError) as error:
        raise MessageValueError(f"{message_type.name}: not JSON: {error}.") from error
    _print(message_type.encode(from_json(types, message_type, value)).hex())


def decode(arguments: argparse.Namespace) -> None:
    """Print the JSON object of a message."""
    types = message_types(arguments.path)
    message_type = _message_type(types, arguments.type)
    try:
        data = bytes.fromhex(_text(arguments.hex))
    except ValueError as error:
        raise MessageValueError(f"{message_type.name}: not hexadecimal: {error}.") from error
    message = message_type.decode(data)
    text = json.dumps(to_json(types, message_type, message), ensure_ascii=False)
    # Bytes that are not UTF-8 are lone surrogates, which can be written as JSON escapes only.
    _print(text.encode(errors="backslashreplace").decode())


def message_types(paths: Sequence[Path]) -> MessageTypes:
    """Return the types of ``--path``, then of ROS_PACKAGE_PATH, then the common ones.

    Raises:
        MessageTypeError: a path is no folder.
    """
    for path in paths:
        if not path.is_dir():
            raise MessageTypeError(f"{path}: no such folder.")
    environment = os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep)
    return MessageTypes([*paths, *(Path(path) for path in environment if path)])


def _message_type(types: MessageTypes, name: str) -> MessageType:
    found = types.find(name)
    if isinstance(found, MessageType):
        return found
    names = ", ".join(each.name for each in found.messages)
    raise MessageTypeError(f"{found.name} is no message; name one of {names}.")


def _text(argument: str) -> str:
    return sys.stdin.read() if argument == STANDARD_INPUT else argument


def _print(text: str) -> None:
    sys.stdout.write(text + "\n")
