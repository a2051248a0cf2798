"""Views of ARRAYs: indices as declared, every access checked."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from st_types.errors import ValueRangeError
from st_types.types.derived import ArrayType, StringType, StructType, resolve_alias
from st_types.types.values import encode

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from st_types.types.elementary import DataType

V = TypeVar("V")

Index = int | tuple[int, ...]


def _same_type(one: DataType[object], other: DataType[object]) -> bool:
    """True for one type; STRING[20] twice, or an ARRAY of as many such elements, is one, too."""
    one, other = resolve_alias(one), resolve_alias(other)
    if isinstance(one, ArrayType) and isinstance(other, ArrayType):
        return one.count == other.count and _same_type(one.element, other.element)
    return one is other or (one.name == other.name and not isinstance(one, StructType))


class Array(Generic[V]):
    """An ARRAY variable; ``a[3]``, for two dimensions ``a[1, 2]``, indices as declared.

    Iteration and ``len`` run over all elements, the last index fastest. ``bytes(a)`` copies the
    bytes; ``a.write(b"...")`` stores bytes from the first element on.

    Attributes:
        data_type: the ARRAY type.
        address: what ADR() gives, 0 where the array does not lie in PLC memory.
    """

    __slots__ = ("_count", "_low", "_raw", "address", "data_type")

    def __init__(self, data_type: ArrayType[Any], raw: Any, address: int) -> None:
        self.data_type = data_type
        self._raw = raw
        self.address = address
        self._low = data_type.bounds[0][0]
        self._count = data_type.count if len(data_type.bounds) == 1 else 0

    def _position(self, index: Index) -> int:
        if isinstance(index, int):
            position = index - self._low
            if 0 <= position < self._count:
                return position
            return self.data_type.index_of(index)
        return self.data_type.index_of(*index)

    def _load(self, position: int) -> V:
        value: V = self._raw[position]
        return value

    def _store(self, position: int, value: V) -> None:
        try:
            self._raw[position] = value
        except TypeError:
            raise ValueRangeError(f"{value!r} is not a {self.data_type.element}.") from None

    def __getitem__(self, index: Index) -> V:
        return self._load(self._position(index))

    def __setitem__(self, index: Index, value: V) -> None:
        self._store(self._position(index), value)

    def __len__(self) -> int:
        return self.data_type.count

    def __iter__(self) -> Iterator[V]:
        return (self._load(position) for position in range(self.data_type.count))

    def __bytes__(self) -> bytes:
        return bytes(self._raw)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Array):
            return list(self) == list(other)
        return list(self) == other if isinstance(other, list) else NotImplemented

    __hash__ = None  # type: ignore[assignment]  # a view changes with its bytes

    def __repr__(self) -> str:
        return f"{self.data_type}({list(self)!r})"

    def assign(self, value: object) -> None:
        """Copy another ARRAY of as many such elements, or a sequence of values.

        Elements that a sequence does not give are initialised.

        Raises:
            ValueRangeError: an element does not fit, there are too many, or the ARRAY is of another
                type.
        """
        if isinstance(value, Array):
            if not _same_type(value.data_type, self.data_type):
                raise ValueRangeError(f"{self.data_type} cannot take {value.data_type}.")
            data = bytes(value)
        else:
            data = encode(self.data_type, value)
        self.write(data)

    def write(self, data: bytes) -> None:
        """Store ``data`` over the first bytes of the array.

        Raises:
            ValueRangeError: there are more bytes than the array has.
        """
        if len(data) > self.data_type.size:
            raise ValueRangeError(f"{len(data)} bytes are too many for {self.data_type}.")
        ctypes.memmove(ctypes.addressof(self._raw), data, len(data))


class BoolArray(Array[bool]):
    """Elements that ctypes would give the truth of any value."""

    __slots__ = ()

    def _store(self, position: int, value: bool) -> None:
        if value not in (False, True):
            raise ValueRangeError(f"{value!r} is not a BOOL.")
        self._raw[position] = value


class ConvertedArray(Array[V]):
    """Elements that need a conversion: enumerations, STRING, WSTRING."""

    __slots__ = ("_load_raw",)

    def __init__(
        self, data_type: ArrayType[Any], raw: Any, address: int, load: Callable[[Any], V]
    ) -> None:
        super().__init__(data_type, raw, address)
        self._load_raw = load

    def _load(self, position: int) -> V:
        raw = self._raw[position]
        return self._load_raw(getattr(raw, "value", raw))

    def _store(self, position: int, value: V) -> None:
        element = self.data_type.element
        data = encode(element, value)
        if isinstance(resolve_alias(element), StringType):
            data = data[: data.index(0) + 1]  # an assignment does not fill up with zeros
        ctypes.memmove(ctypes.addressof(self._raw) + position * element.size, data, len(data))


class ViewArray(Array[V]):
    """Elements that are views: STRUCTs, data blocks, ARRAYs; each is made at its first use."""

    __slots__ = ("_made", "_make", "_set")

    def __init__(
        self,
        data_type: ArrayType[Any],
        raw: Any,
        address: int,
        make: Callable[[int], V],
        store: Callable[[V, object], None],
    ) -> None:
        super().__init__(data_type, raw, address)
        self._make = make
        self._set = store
        self._made: dict[int, V] = {}

    def _load(self, position: int) -> V:
        view = self._made.get(position)
        if view is None:
            view = self._made[position] = self._make(position)
        return view

    def _store(self, position: int, value: V) -> None:
        self._set(self._load(position), value)
