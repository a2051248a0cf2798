"""What messages look like in ROS 2, from the definitions of ROS 1.

A type is bridged where both have the same fields, but for two things that are known: time and
duration are messages in ROS 2 (builtin_interfaces), and std_msgs/Header has no ``seq`` there. One
that ROS 2 has with other fields is refused; one that rosbags does not know (a package of the user)
is taken for the same in both.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, NamedTuple

from rosbags.typesys import Stores, get_typestore

from crosnode.errors import DefinitionError
from crosnode.messages.definition import BUILTINS, HEADER, split_type_name

if TYPE_CHECKING:
    from crosnode.messages import MessageTypes

TIMES: Final = {"time": "builtin_interfaces/Time", "duration": "builtin_interfaces/Duration"}
DISTRIBUTION: Final = Stores.ROS2_HUMBLE
FILLER: Final = "structure_needs_at_least_one_member"
"""Field of a message without fields: IDL knows no empty structure."""

_SYNONYMS: Final = {"byte": "uint8", "char": "uint8", "octet": "uint8"}


class Ros2Field(NamedTuple):
    """A field as ROS 2 has it.

    Attributes:
        name: of the field.
        base: primitive type, or ``pkg/Name``.
        is_array: True for fixed and variable arrays.
        length: elements of a fixed array, None where variable or no array.
    """

    name: str
    base: str
    is_array: bool = False
    length: int | None = None


class Shapes:
    """The fields of messages in ROS 2.

    Args:
        types: knows the definitions.
    """

    def __init__(self, types: MessageTypes) -> None:
        self._types = types
        self._known = get_typestore(DISTRIBUTION).fielddefs
        self._found: dict[str, tuple[Ros2Field, ...]] = {}

    def fields(self, name: str) -> tuple[Ros2Field, ...]:
        """Return the fields of a message, after those of all messages in it were looked at.

        Raises:
            MessageTypeError: the type cannot be had, or is another one in ROS 2.
        """
        if name not in self._found:
            self._found[name] = found = self._fields(name)
            for field in found:
                if "/" in field.base:
                    self.fields(field.base)
            self._check(name, found)
        return self._found[name]

    def _fields(self, name: str) -> tuple[Ros2Field, ...]:
        if name in TIMES.values():
            second = "int32"
            return Ros2Field("sec", second), Ros2Field("nanosec", "uint32")
        found = tuple(
            Ros2Field(each.name, TIMES.get(each.base, each.base), each.is_array, each.length)
            for each in self._types.definition(name).fields
            if (name, each.name) != (HEADER, "seq")
        )
        return found or (Ros2Field(FILLER, "uint8"),)

    def _check(self, name: str, found: tuple[Ros2Field, ...]) -> None:
        package, base = split_type_name(name)
        known = self._known.get(f"{package}/msg/{base}")
        if known is None:
            return
        theirs = tuple(_field_of(each, described) for each, described in known[1])
        ours = tuple(each._replace(base=_SYNONYMS.get(each.base, each.base)) for each in found)
        if ours != theirs:
            names = ", ".join(each.name for each in theirs)
            raise DefinitionError(f"{name} is another type in ROS 2, with the fields {names}.")


def _field_of(name: str, described: Any) -> Ros2Field:
    """Return a field from rosbags' description of it."""
    kind, what = described
    if kind.name in ("ARRAY", "SEQUENCE"):
        element = _field_of(name, what[0])
        return element._replace(is_array=True, length=what[1] if kind.name == "ARRAY" else None)
    if kind.name == "BASE":
        return Ros2Field(name, _SYNONYMS.get(what[0], what[0]))
    return Ros2Field(name, what.replace("/msg/", "/"))


def is_primitive(base: str) -> bool:
    """Return whether a type is a number or a text."""
    return base in BUILTINS
