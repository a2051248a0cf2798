"""The linear memory of the controller: 32-bit addresses, every access through one is checked.

All variables of all programs lie in one mapping. Address 0 is nil and the first page is never
valid, so a forgotten pointer is found at once; what lies above the last allocated page is not valid
either.
"""

from __future__ import annotations

import mmap
import re
from typing import TYPE_CHECKING, Any, TypeVar, cast, overload

from plcsim.core.errors import ConfigurationError, PageFault
from st_types.types.derived import ArrayType, StructType, resolve_alias
from st_types.types.layout import align_up
from st_types.types.values import decode, encode, initial_image
from st_types.types.views import Struct, address_of, type_of, view_of

if TYPE_CHECKING:
    from st_types.types.arrays import Array
    from st_types.types.elementary import DataType

V = TypeVar("V")
S = TypeVar("S", bound=Struct)

PAGE = 4096
"""Bytes; the unit in which addresses become valid."""

DEFAULT_SIZE = 16 * 1024 * 1024
"""Bytes of memory of a controller where plc.toml does not say otherwise."""

MAX_SIZE = 1 << 31
"""Bytes; the mapping must be able to lie below 2 GiB for C units."""


class Memory:
    """The memory of one controller.

    Args:
        size: bytes, a multiple of the page size.
    """

    def __init__(self, size: int = DEFAULT_SIZE) -> None:
        if size % PAGE or not 2 * PAGE <= size <= MAX_SIZE:
            raise ConfigurationError(
                f"memory of {size} bytes: must be a multiple of {PAGE}, at most {MAX_SIZE}."
            )
        self._map = mmap.mmap(-1, size)
        self._top = PAGE
        self._limit = PAGE
        self.size = size

    @property
    def used(self) -> int:
        """Bytes allocated, the first page included."""
        return self._top

    def allocate(self, size: int, alignment: int = 4) -> int:
        """Reserve ``size`` zeroed bytes and return their address.

        Raises:
            ConfigurationError: the memory is full.
        """
        address = align_up(self._top, alignment)
        if address + size > self.size:
            raise ConfigurationError(
                f"the PLC memory of {self.size} bytes is full: {size} more bytes do not fit."
            )
        self._top = address + size
        self._limit = align_up(self._top, PAGE)
        return address

    def new(self, view: type[S], context: object = None) -> S:
        """Allocate a variable of a Struct class, give it its initial values, return its view."""
        data_type = type_of(view)
        address = self.allocate(data_type.size, data_type.alignment)
        self._map[address : address + data_type.size] = initial_image(data_type)
        return cast("S", view_of(data_type, self._map, address, address, context))

    def check(self, address: int, size: int) -> None:
        """Raise PageFault unless all ``size`` bytes at ``address`` are valid."""
        if size < 0 or not PAGE <= address <= self._limit - size:
            raise PageFault(address, size)

    def read(self, address: int, size: int) -> bytes:
        """Return a copy of ``size`` bytes.

        Raises:
            PageFault: some of them are not valid.
        """
        self.check(address, size)
        return self._map[address : address + size]

    def view(self, address: int, size: int) -> memoryview:
        """Return a view of ``size`` bytes, which changes with them.

        Raises:
            PageFault: some of them are not valid.
        """
        self.check(address, size)
        return memoryview(self._map)[address : address + size]

    def write(self, address: int, data: bytes | bytearray | memoryview) -> None:
        """Store ``data``.

        Raises:
            PageFault: some of the bytes are not valid; then none is stored.
        """
        self.check(address, len(data))
        self._map[address : address + len(data)] = data

    def string(self, address: int, limit: int) -> bytes:
        """Return the bytes of a NUL-terminated STRING, at most ``limit``, without the NUL.

        Raises:
            PageFault: the string runs into an address that is not valid.
        """
        self.check(address, 1)
        end = min(address + limit, self._limit)
        found = self._map.find(b"\0", address, end)
        if found < 0:
            self.check(address, limit)
        return self._map[address : end if found < 0 else found]

    @overload
    def access(self, data_type: type[S], address: int) -> S: ...
    @overload
    def access(self, data_type: ArrayType[V], address: int) -> V: ...
    @overload
    def access(self, data_type: StructType[V], address: int) -> V: ...
    def access(self, data_type: Any, address: int) -> object:
        """Return a view of the STRUCT or ARRAY at ``address``, as ``ref ACCESS address`` does.

        Raises:
            PageFault: some of its bytes are not valid.
        """
        kind = resolve_alias(type_of(data_type))
        self.check(address, kind.size)
        return view_of(kind, self._map, address, address, None)

    def get(self, data_type: DataType[V], address: int) -> V:
        """Return the plain value of a variable (see `st_types.types.values.decode`).

        Raises:
            PageFault: some of its bytes are not valid.
        """
        return cast("V", decode(data_type, self.read(address, data_type.size)))

    def set(self, data_type: DataType[V], address: int, value: V) -> None:
        """Store a plain value.

        Raises:
            PageFault: some of its bytes are not valid.
            ValueRangeError: the value does not fit the type.
        """
        self.write(address, encode(data_type, value))


_STEP = re.compile(r"\w+|\[[^][]*\]")
_PATH = re.compile(rf"({_STEP.pattern})(\.\w+|\[[^][]*\])*")


def find(data_type: DataType[object], path: str) -> tuple[DataType[Any], int]:
    """Return the type and the offset in bytes of ``path`` inside a variable.

    Args:
        data_type: the variable's type.
        path: such as ``"motor.speed"``, ``"axes[3].name"``, ``"grid[1, 2]"``; "" is the variable.

    Raises:
        KeyError: there is no such member, an index is wrong, or it is not a path; the argument
            says which.
    """
    if path and not _PATH.fullmatch(path):
        raise KeyError(f"{path} is not a path such as axes[3].name")
    found = resolve_alias(data_type)
    offset = 0
    for step in _STEP.findall(path):
        if step.startswith("["):
            found, inner = _element(found, step)
        elif isinstance(found, StructType):
            found, inner = _member(found, step)
        else:
            raise KeyError(f"{found} has no members ({step})")
        offset += inner
    return found, offset


def _element(data_type: DataType[Any], step: str) -> tuple[DataType[Any], int]:
    if not isinstance(data_type, ArrayType):
        raise KeyError(f"{data_type} has no elements ({step})")
    try:
        place = data_type.index_of(*(int(i) for i in step.strip("[]").split(",")))
    except (ValueError, IndexError) as err:
        raise KeyError(f"{step}: {err}") from None
    element = resolve_alias(data_type.element)
    return element, place * element.size


def _member(data_type: StructType[Any], step: str) -> tuple[DataType[Any], int]:
    try:
        member, offset = data_type.find(step)
    except KeyError:
        raise KeyError(f"{data_type} has no member {step}") from None
    return resolve_alias(member.data_type), offset


def adr(view: Struct | Array[Any], path: str = "") -> int:
    """Return the PLC address of a variable, or of a part of it: ADR() of Structured Text.

    Args:
        view: a STRUCT, an ARRAY or a program.
        path: the part, such as ``"counter"`` or ``"axes[3].name"``.

    Raises:
        PageFault: the view does not lie in PLC memory.
        KeyError: there is no such part.
    """
    base = address_of(view)
    if not base:
        raise PageFault(0, type_of(view).size)
    return base + find(type_of(view), path)[1]


def sizeof(variable: Struct | Array[Any] | type[Struct] | DataType[object], path: str = "") -> int:
    """Return the size in bytes of a variable, a part of it, or a type: SIZEOF()."""
    return find(type_of(variable), path)[0].size
