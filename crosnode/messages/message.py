"""Classes of messages: fields are attributes, all with defaults."""

from __future__ import annotations

from keyword import iskeyword
from typing import TYPE_CHECKING, Any, ClassVar, Final

import numpy as np

from crosnode.errors import DefinitionError
from crosnode.messages.values import DTYPES

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from crosnode.messages.definition import Definition, Field

_SCALARS: Final[dict[str, bool | int | float | str]] = {
    "bool": False,
    "string": "",
    "float32": 0.0,
    "float64": 0.0,
}
_NEW: Final = object()
"""Stands for a default that is made anew for each message."""


class Message:
    """Base of all message classes; fields are attributes, all with defaults.

    A field whose name is a Python keyword has an underscore appended. Two messages are equal when
    they are of one type and all fields are equal, arrays element by element.
    """

    __slots__ = ()
    __hash__ = None  # type: ignore[assignment]  # messages are mutable
    _attributes: ClassVar[tuple[str, ...]] = ()

    if TYPE_CHECKING:  # the fields of a type are known only at run time

        def __init__(self, *values: Any, **fields: Any) -> None: ...
        def __getattr__(self, name: str) -> Any: ...
        def __setattr__(self, name: str, value: Any) -> None: ...

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return all(_equal(getattr(self, name), getattr(other, name)) for name in self._attributes)

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={getattr(self, name)!r}" for name in self._attributes)
        return f"{type(self).__name__}({values})"


def _equal(a: object, b: object) -> bool:
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        one, other = np.asarray(a), np.asarray(b)
        return np.array_equal(one, other)
    return a == b


def attribute_name(field_name: str) -> str:
    """Return the attribute that holds a field: its name, or ``name_`` for a keyword."""
    return f"{field_name}_" if iskeyword(field_name) else field_name


def message_class(
    definition: Definition, classes: Mapping[str, Callable[[], Any]]
) -> type[Message]:
    """Make the class of a message type.

    Args:
        definition: of the type.
        classes: of the messages, times and durations in its fields, by name of their type.

    Raises:
        DefinitionError: two fields would be one attribute.
    """
    names = tuple(attribute_name(field.name) for field in definition.fields)
    if twice := {name for name in names if names.count(name) > 1}:
        raise DefinitionError(f"{definition.name}: two fields are the attribute {min(twice)!r}.")
    namespace: dict[str, Any] = {"_NEW": _NEW}
    parameters, lines = ["_self"], []
    for name, field in zip(names, definition.fields, strict=True):
        if _is_constant(field):
            namespace[f"_{name}"] = _SCALARS.get(field.base, 0)
            parameters.append(f"{name}=_{name}")
            lines.append(f"    _self.{name} = {name}")
        else:
            namespace[f"_{name}"] = _default(field, classes)
            parameters.append(f"{name}=_NEW")
            lines.append(f"    _self.{name} = _{name}() if {name} is _NEW else {name}")
    head = f"def __init__({', '.join(parameters)}):"
    # Names of fields are ASCII identifiers that begin with a letter (`definition`).
    exec("\n".join([head, *(lines or ["    pass"])]), namespace)  # noqa: S102  # as a dataclass is made
    body = {
        "__slots__": names,
        "__doc__": definition.name,
        "__msgtype__": definition.name,
        "__init__": namespace["__init__"],
        "_attributes": names,
    }
    return type(definition.name.partition("/")[2], (Message,), body)


def _is_constant(field: Field) -> bool:
    """Whether all messages may share the default."""
    return not field.is_array and (field.base in DTYPES or field.base == "string")


def _default(field: Field, classes: Mapping[str, Callable[[], Any]]) -> Callable[[], object]:
    length = field.length or 0
    if field.base in DTYPES:
        return lambda: np.zeros(length, DTYPES[field.base])
    one = classes.get(field.base, str)
    return (lambda: [one() for _ in range(length)]) if field.is_array else one
