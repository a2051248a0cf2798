"""Values of IEC 61131-3 types as OPC UA has them, both ways.

Source of the table of types: OPC 30000, 5.2 (mapping of elementary data types): TIME is a Duration
in milliseconds, dates and times of day are DateTimes.
"""

from __future__ import annotations

import math
from datetime import UTC, datetime, timedelta
from itertools import chain
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from asyncua import ua

from st_types.errors import ValueRangeError
from st_types.types.derived import (
    EnumerationType,
    ReferenceType,
    StringType,
    SubrangeType,
    WStringType,
)
from st_types.types.elementary import LONG_TIMES, ElementaryType
from st_types.types.values import decode, encode

if TYPE_CHECKING:
    from plcsim.opcua.model import Leaf
    from st_types.types.elementary import DataType

_VARIANT = ua.VariantType

_ELEMENTARY: Final = {
    "BOOL": _VARIANT.Boolean,
    "SINT": _VARIANT.SByte,
    "USINT": _VARIANT.Byte,
    "BYTE": _VARIANT.Byte,
    "INT": _VARIANT.Int16,
    "UINT": _VARIANT.UInt16,
    "WORD": _VARIANT.UInt16,
    "CHAR": _VARIANT.Byte,
    "WCHAR": _VARIANT.UInt16,
    "DINT": _VARIANT.Int32,
    "UDINT": _VARIANT.UInt32,
    "DWORD": _VARIANT.UInt32,
    "LINT": _VARIANT.Int64,
    "ULINT": _VARIANT.UInt64,
    "LWORD": _VARIANT.UInt64,
    "REAL": _VARIANT.Float,
    "LREAL": _VARIANT.Double,
    "TIME": _VARIANT.Double,
    "DATE": _VARIANT.DateTime,
    "TIME_OF_DAY": _VARIANT.DateTime,
    "DATE_AND_TIME": _VARIANT.DateTime,
    **dict.fromkeys(LONG_TIMES, _VARIANT.Int64),
}

_EPOCH: Final = datetime(1970, 1, 1, tzinfo=UTC)
_UNITS: Final = {
    "DATE": timedelta(seconds=1),
    "DATE_AND_TIME": timedelta(seconds=1),
    "TIME_OF_DAY": timedelta(milliseconds=1),
}


class MismatchError(Exception):
    """A value of a wrong type, or that does not fit.

    Args:
        code: the status code for it.
    """

    def __init__(self, code: int, text: str) -> None:
        super().__init__(text)
        self.code = code


class BuiltinType(NamedTuple):
    """How OPC UA has an elementary type.

    Attributes:
        variant: type of the values.
        data_type: the node that stands for it.
    """

    variant: ua.VariantType
    data_type: ua.NodeId


def builtin_of(data_type: DataType[Any]) -> BuiltinType:
    """Return how OPC UA has a type that is no ARRAY and no STRUCT."""
    match data_type:
        case SubrangeType(base=base) | EnumerationType(base=base):
            return builtin_of(base)
        case ReferenceType():
            variant = _VARIANT.UInt32
        case StringType() | WStringType():
            variant = _VARIANT.String
        case ElementaryType(name="TIME"):
            return BuiltinType(_VARIANT.Double, ua.NodeId(ua.ObjectIds.Duration))
        case ElementaryType(name=name):
            variant = _ELEMENTARY[name]
        case _:
            raise TypeError(f"{data_type} is no value")
    return BuiltinType(variant, ua.NodeId(variant.value))


class VariableCodec:
    """Converts the values of one variable.

    Args:
        leaf: the variable.
    """

    def __init__(self, leaf: Leaf) -> None:
        self.leaf = leaf
        self._element = leaf.element
        self._note = leaf.note
        self.builtin = builtin_of(self._element)
        self._dimensions = list(leaf.dimensions)

    def variant(self, data: bytes) -> ua.Variant:
        """Return the value that bytes of memory are."""
        value: Any = decode(self.leaf.tag.data_type, data)
        if not self._dimensions:
            return ua.Variant(self._out(value), self.builtin.variant)
        values = [self._out(element) for element in value]
        return ua.Variant(
            _nested(values, self._dimensions), self.builtin.variant, self._dimensions, is_array=True
        )

    def data(self, variant: ua.Variant) -> bytes:
        """Return the bytes of a value that a client writes.

        Raises:
            MismatchError: it is of another type, or does not fit.
        """
        if variant.VariantType != self.builtin.variant:
            raise MismatchError(ua.StatusCodes.BadTypeMismatch, "is of another type")
        value = variant.Value
        is_array = isinstance(value, list)
        if is_array != bool(self._dimensions):
            raise MismatchError(ua.StatusCodes.BadTypeMismatch, "is an array, or is none")
        try:
            value = self._elements(value) if is_array else self._in(value)
            return encode(self.leaf.tag.data_type, value)
        except (ValueRangeError, OverflowError) as err:
            raise MismatchError(ua.StatusCodes.BadOutOfRange, str(err)) from None

    def _elements(self, value: list[Any]) -> list[Any]:
        values = _flat(value)
        if len(values) != math.prod(self._dimensions):
            raise MismatchError(ua.StatusCodes.BadOutOfRange, f"has {len(values)} elements")
        return [self._in(element) for element in values]

    def _out(self, value: Any) -> Any:
        unit = _UNITS.get(self._element.name)
        if unit is not None:
            return _EPOCH + value * unit
        return float(value) if self._element.name == "TIME" else value

    def _in(self, value: Any) -> Any:
        """Return an element as `encode` takes it."""
        if value is None:
            raise MismatchError(ua.StatusCodes.BadTypeMismatch, "is null")
        name = self._element.name
        if name in _UNITS:
            moment = value if value.tzinfo else value.replace(tzinfo=UTC)
            value = (moment - _EPOCH) // _UNITS[name]
        elif name == "TIME":
            value = round(value) if math.isfinite(value) else value
        self._check(value)
        return value

    def _check(self, value: Any) -> None:
        if isinstance(value, float) and not math.isfinite(value):
            raise ValueRangeError(f"{value} is no number")
        if isinstance(value, str):
            self._check_text(value)
        elif isinstance(self._element, EnumerationType):
            if value not in self._element.values.values():
                raise ValueRangeError(f"{value} is no value of {self._element}")
        elif self._is_outside(value):
            raise ValueRangeError(f"{value} is outside the limits of the tag map")

    def _is_outside(self, value: float) -> bool:
        low, high = self._note.minimum, self._note.maximum
        return (low is not None and value < low) or (high is not None and value > high)

    def _check_text(self, text: str) -> None:
        element = self._element
        if "\0" in text:
            raise ValueRangeError("text with NUL")
        units = len(text.encode("utf-16-le", "surrogatepass")) // 2
        if isinstance(element, StringType | WStringType) and units > element.length:
            raise ValueRangeError(f"{units} characters, {element} has {element.length}")


def _nested(values: list[Any], dimensions: list[int]) -> list[Any]:
    """Return a list of lists, the last index running fastest."""
    for count in reversed(dimensions[1:]):
        values = [values[at : at + count] for at in range(0, len(values), count)]
    return values


def _flat(value: list[Any]) -> list[Any]:
    while value and isinstance(value[0], list):
        value = list(chain.from_iterable(value))
    return value
