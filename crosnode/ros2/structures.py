"""Messages as structures of Cyclone DDS, which writes and reads their bytes (CDR)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, TypeAlias

from cyclonedds.idl import IdlStruct, make_idl_struct
from cyclonedds.idl import types as idl

from crosnode.messages.message import attribute_name
from crosnode.messages.values import Duration, Time
from crosnode.ros2.names import type_name
from crosnode.ros2.shapes import FILLER, TIMES, Shapes, is_primitive

if TYPE_CHECKING:
    from crosnode.messages import Message, MessageTypes

Structure: TypeAlias = Any
"""An instance of a class of `Structures`."""

_PRIMITIVES: Final[dict[str, Any]] = {
    "bool": bool, "byte": idl.uint8, "char": idl.uint8, "int8": idl.int8, "uint8": idl.uint8,
    "int16": idl.int16, "uint16": idl.uint16, "int32": idl.int32, "uint32": idl.uint32,
    "int64": idl.int64, "uint64": idl.uint64, "float32": idl.float32, "float64": idl.float64,
    "string": str,
}  # fmt: skip
"""A byte is signed in ROS 1 and an octet in ROS 2."""


class Structures:
    """Classes of Cyclone DDS for messages, and the way between the two.

    Args:
        types: knows the messages.
    """

    def __init__(self, types: MessageTypes) -> None:
        self._types = types
        self._shapes = Shapes(types)
        self._classes: dict[str, type[IdlStruct]] = {}

    def structure(self, name: str) -> type[IdlStruct]:
        """Return the class of a message.

        Raises:
            MessageTypeError: the type cannot be had, or is another one in ROS 2.
        """
        if name not in self._classes:
            fields = {
                each.name: self._annotation(each.base, each.is_array, each.length)
                for each in self._shapes.fields(name)
            }
            made = make_idl_struct(name.replace("/", "_"), type_name(name), fields)
            self._classes[name] = made
        return self._classes[name]

    def _annotation(self, base: str, is_array: bool, length: int | None) -> Any:  # as in a field
        element = _PRIMITIVES[base] if is_primitive(base) else self.structure(base)
        if not is_array:
            return element
        return idl.sequence[element] if length is None else idl.array[element, length]

    def to_structure(self, name: str, message: Message | Time | Duration) -> Structure:
        """Return the structure of a message."""
        made = self.structure(name)
        if isinstance(message, (Time, Duration)):
            return made(message.secs, message.nsecs)
        values = []
        for each in self._shapes.fields(name):
            value = 0 if each.name == FILLER else getattr(message, attribute_name(each.name))
            values.append(self._to_value(each.base, value, is_array=each.is_array))
        return made(*values)

    def _to_value(self, base: str, value: Any, *, is_array: bool) -> Any:
        if is_array:
            plain = value.tolist() if hasattr(value, "tolist") else value
            return [self._to_value(base, each, is_array=False) for each in plain]
        if not is_primitive(base):
            return self.to_structure(base, value)
        return value & 0xFF if base == "byte" else value

    def to_message(self, name: str, structure: Structure) -> Any:
        """Return the message of a structure."""
        if name in TIMES.values():
            kind = Time if name == TIMES["time"] else Duration
            return kind(max(0, structure.sec) if kind is Time else structure.sec, structure.nanosec)
        values = {
            attribute_name(each.name): self._from_value(
                each.base, getattr(structure, each.name), is_array=each.is_array
            )
            for each in self._shapes.fields(name)
            if each.name != FILLER
        }
        return self._types.message(name).new(**values)

    def _from_value(self, base: str, value: Any, *, is_array: bool) -> Any:
        if is_array:
            return [self._from_value(base, each, is_array=False) for each in value]
        if not is_primitive(base):
            return self.to_message(base, value)
        return value - 256 if base == "byte" and value > 127 else value  # signed
