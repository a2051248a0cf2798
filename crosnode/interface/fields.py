"""A message field by field."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from crosnode.interface.handles import (
    LATIN_1,
    FieldHandle,
    MessageHandle,
    handles_of,
    put_text,
    text_at,
)
from crosnode.interface.interface import (
    CROS_TEXT_LENGTH,
    CrosMessageType,
    crosERR_CUT,
    crosERR_FIELD,
    crosERR_HANDLE,
    crosERR_VALUE,
)
from crosnode.messages import Duration, Time
from crosnode.messages.definition import HEADER
from crosnode.messages.message import attribute_name
from crosnode.messages.values import DTYPES
from plcsim.library.executable import function
from plcsim.library.runtime import ERR_OK

if TYPE_CHECKING:
    from crosnode.messages.definition import Definition, Field
    from plcsim.core.context import Context

_STEP: Final = re.compile(r"([A-Za-z]\w*)(?:\[(\d{1,9})\])?")
_LONGEST: Final = 1_000_000
"""Elements that an array may be made long."""

_TYPES: Final = {
    **{
        name: f"CROS_STD_MSGS_{name.upper()}"
        for name in ("int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64",
                     "float32", "float64", "string", "bool", "time", "duration", "char", "byte")
    },
    HEADER: "CROS_STD_MSGS_HEADER",
}  # fmt: skip


@function("cRosMessageGetField")
def get_field(context: Context, msg: int, path: int) -> int:
    """Return the handle of a field by its path."""
    handles = handles_of(context)
    found = handles.find(MessageHandle, msg)
    if found is None:
        return 0
    made = _found(found, text_at(context, path, CROS_TEXT_LENGTH))
    if made is None:
        return 0
    handle = handles.add(made)
    found.fields.append(handle)
    return handle


def _found(msg: MessageHandle, path: str) -> FieldHandle | None:
    """Return the field of a path such as ``points[3].positions``, None where there is none."""
    holder: Any = msg.message
    definition: Definition = msg.message_type.definition
    *outer, last = path.split(".")
    for step in outer:
        match = _STEP.fullmatch(step)
        field = _field(definition, match[1]) if match else None
        if match is None or field is None or field.is_builtin:
            return None
        holder = getattr(holder, attribute_name(field.name))
        if field.is_array:
            if match[2] is None or int(match[2]) >= len(holder):
                return None
            holder = holder[int(match[2])]
        definition = msg.types.definition(field.base)
    field = _field(definition, last)
    return FieldHandle(holder, attribute_name(last), field, msg.types) if field else None


def _field(definition: Definition, name: str) -> Field | None:
    return next((each for each in definition.fields if each.name == name), None)


@function("cRosMessageGetFieldType")
def type_of_field(context: Context, field: int) -> int:
    """Return the number of a field's type."""
    found = handles_of(context).find(FieldHandle, field)
    name = _TYPES.get(found.field.base) if found else None
    return CrosMessageType[name].value if name else 0


@function("cRosMessageGetArraySize")
def array_size(context: Context, field: int) -> int:
    """Return the elements of an array."""
    found = handles_of(context).find(FieldHandle, field)
    if found is None or not found.field.is_array:
        return -1
    return len(getattr(found.holder, found.attribute))


@function("cRosMessageSetArraySize")
def set_array_size(context: Context, field: int, size: int) -> int:
    """Make an array so long; new elements have defaults."""
    found = handles_of(context).find(FieldHandle, field)
    if found is None:
        return crosERR_HANDLE
    if not found.field.is_array or found.field.length is not None:
        return crosERR_FIELD
    if size > _LONGEST:
        return crosERR_VALUE
    before = getattr(found.holder, found.attribute)
    setattr(found.holder, found.attribute, _resized(found, before, size))
    return ERR_OK


def _resized(found: FieldHandle, before: Any, size: int) -> Any:
    base = found.field.base
    if base in DTYPES:
        after = np.zeros(size, DTYPES[base])
        kept = min(size, len(before))
        after[:kept] = before[:kept]
        return after
    makers: dict[str, Any] = {"string": str, "time": Time, "duration": Duration}
    make = makers.get(base) or found.types.message_class(base)
    return [*before[:size], *(make() for _ in range(size - len(before)))]


def _read(found: FieldHandle | None, index: int) -> Any:
    """Return a value, of an array an element; None where there is none."""
    if found is None:
        return None
    value = getattr(found.holder, found.attribute)
    if not found.field.is_array:
        return value
    return value[index] if index < len(value) else None


def _number(context: Context, field: int, index: int) -> int | float:
    value = _read(handles_of(context).find(FieldHandle, field), index)
    if isinstance(value, (Time, Duration)):
        return value.to_ns()
    if isinstance(value, np.generic):
        value = value.item()
    return value if isinstance(value, (int, float)) else 0


@function("cRosMessageGetFieldInt")
def get_int(context: Context, field: int, index: int) -> int:
    """Return a whole number; a time in nanoseconds."""
    value = _number(context, field, index)
    if isinstance(value, float) and not math.isfinite(value):
        return 0
    return max(-(2**63), min(int(value), 2**63 - 1))


@function("cRosMessageGetFieldReal")
def get_real(context: Context, field: int, index: int) -> float:
    """Return a number."""
    return float(_number(context, field, index))


@function("cRosMessageGetFieldString")
def get_string(context: Context, field: int, index: int, address: int, size: int) -> int:
    """Write a text to an address."""
    found = handles_of(context).find(FieldHandle, field)
    if found is None:
        return crosERR_HANDLE
    value = _read(found, index)
    if not isinstance(value, str):
        return crosERR_FIELD
    return crosERR_CUT if put_text(context, address, size, value) else ERR_OK


def _write(found: FieldHandle | None, index: int, value: Any) -> int:
    if found is None:
        return crosERR_HANDLE
    if not found.field.is_array:
        setattr(found.holder, found.attribute, value)
        return ERR_OK
    elements = getattr(found.holder, found.attribute)
    if index >= len(elements):
        return crosERR_FIELD
    elements[index] = value
    return ERR_OK


@function("cRosMessageSetFieldInt")
def set_int(context: Context, field: int, index: int, value: int) -> int:
    """Set a whole number, a number, or a time by its nanoseconds."""
    found = handles_of(context).find(FieldHandle, field)
    base = found.field.base if found else ""
    if base == "time":
        return _write(found, index, Time.from_ns(value)) if value >= 0 else crosERR_VALUE
    if base == "duration":
        return _write(found, index, Duration.from_ns(value))
    if found is not None and base not in DTYPES:
        return crosERR_FIELD
    return _write_number(found, index, value)


def _write_number(found: FieldHandle | None, index: int, value: float) -> int:
    if found is None:
        return crosERR_HANDLE
    dtype = DTYPES[found.field.base]
    if dtype.kind == "b":
        return _write(found, index, bool(value))
    if dtype.kind == "f":
        return _write(found, index, float(value))
    limits = np.iinfo(dtype)
    if not math.isfinite(value) or not int(limits.min) <= value <= int(limits.max):
        return crosERR_VALUE
    return _write(found, index, int(value))


@function("cRosMessageSetFieldReal")
def set_real(context: Context, field: int, index: int, value: float) -> int:
    """Set a number."""
    found = handles_of(context).find(FieldHandle, field)
    if found is not None and found.field.base not in DTYPES:
        return crosERR_FIELD
    return _write_number(found, index, value)


@function("cRosMessageSetFieldValueString")
def set_string(context: Context, field: int, index: int, value: int) -> int:
    """Set a text."""
    found = handles_of(context).find(FieldHandle, field)
    if found is not None and found.field.base != "string":
        return crosERR_FIELD
    text = context.memory.string(value, CROS_TEXT_LENGTH).decode(LATIN_1)
    return _write(found, index, text)
