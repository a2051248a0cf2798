"""Messages to JSON values and back.

A message is an object of its fields, an array a list (of integers for uint8[]), a time or a
duration ``{"secs": …, "nsecs": …}``. JSON has no NaN and no infinities: they are the strings "NaN",
"Infinity" and "-Infinity". A byte of a string that is not UTF-8 is a lone surrogate from U+DC80 to
U+DCFF, which JSON can hold as an escape.
"""

from __future__ import annotations

import base64
import binascii
import math
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from crosnode.errors import MessageValueError
from crosnode.messages.message import Message, attribute_name
from crosnode.messages.values import DTYPES, Duration, Time

if TYPE_CHECKING:
    from collections.abc import Mapping

    from crosnode.messages.definition import Definition, Field
    from crosnode.messages.registry import MessageType, MessageTypes

JsonValue: TypeAlias = Any

_TIMES: Final = {"time": Time, "duration": Duration}
_NOT_FINITE: Final = {"NaN": math.nan, "Infinity": math.inf, "-Infinity": -math.inf}


def to_json(types: MessageTypes, message_type: MessageType, message: Message) -> JsonValue:
    """Return a message as a JSON value, fields in order of declaration."""
    return _object(types, message_type.definition, message)


def from_json(types: MessageTypes, message_type: MessageType, value: JsonValue) -> Message:
    """Return the message that a JSON value stands for; fields left out have their defaults.

    For uint8[] a string is read as base64, as rosbridge writes it.

    Raises:
        MessageValueError: an unknown field, or a value that no field can hold; it names the field.
    """
    return _message(types, message_type.definition, value, message_type.name)


def _object(types: MessageTypes, definition: Definition, message: object) -> dict[str, JsonValue]:
    return {
        field.name: _field_value(types, field, getattr(message, attribute_name(field.name)))
        for field in definition.fields
    }


def _field_value(types: MessageTypes, field: Field, value: Any) -> JsonValue:
    if field.is_array:
        elements = value.tolist() if field.base in DTYPES else value
        return [_element_value(types, field, element) for element in elements]
    return _element_value(types, field, value)


def _element_value(types: MessageTypes, field: Field, value: Any) -> JsonValue:
    if field.base in _TIMES:
        return {"secs": value.secs, "nsecs": value.nsecs}
    if not field.is_builtin:
        return _object(types, types.definition(field.base), value)
    if isinstance(value, float) and not math.isfinite(value):
        return "NaN" if math.isnan(value) else "Infinity" if value > 0 else "-Infinity"
    return value


def _message(types: MessageTypes, definition: Definition, value: JsonValue, path: str) -> Message:
    fields = {field.name: field for field in definition.fields}
    values = {
        attribute_name(name): _parse_field(types, fields[name], element, f"{path}.{name}")
        for name, element in _members(value, fields, path).items()
    }
    return types.message_class(definition.name)(**values)


def _members(value: JsonValue, names: Mapping[str, object], path: str) -> dict[str, JsonValue]:
    if not isinstance(value, dict):
        raise MessageValueError(f"{path}: expected an object, got {value!r:.40}.")
    if unknown := value.keys() - names:
        raise MessageValueError(f"{path}: no field {min(unknown)!r}.")
    return value


def _parse_field(types: MessageTypes, field: Field, value: JsonValue, path: str) -> object:
    if not field.is_array:
        return _parse_element(types, field, value, path)
    if isinstance(value, str) and field.base in ("uint8", "char"):
        return _parse_base64(value, path)
    if not isinstance(value, list):
        raise MessageValueError(f"{path}: expected a list, got {value!r:.40}.")
    return [
        _parse_element(types, field, element, f"{path}[{index}]")
        for index, element in enumerate(value)
    ]


def _parse_element(types: MessageTypes, field: Field, value: JsonValue, path: str) -> object:
    if field.base in _TIMES:
        return _TIMES[field.base](**_members(value, {"secs": 0, "nsecs": 0}, path))
    if not field.is_builtin:
        return _message(types, types.definition(field.base), value, path)
    if field.base.startswith("float") and isinstance(value, str):
        if value not in _NOT_FINITE:
            raise MessageValueError(f"{path}: expected a number, got {value!r}.")
        return _NOT_FINITE[value]
    return value


def _parse_base64(value: str, path: str) -> bytes:
    try:
        return base64.b64decode(value, validate=True)
    except (binascii.Error, ValueError) as error:
        raise MessageValueError(f"{path}: neither a list nor base64 ({error}).") from error
