"""The linear memory of the controller: 32-bit addresses, every access through one is checked.

All variables of all programs lie in one mapping::

    0                nil: never valid, so a forgotten pointer is found at once, a member of it too
    SYSTEM_AREA - s  the stack of compiled programs, s bytes where one was opened; it grows
                     downwards, and what overflows it runs into nil
    SYSTEM_AREA      one page for compiled code (`plcsim.core.system_area`)
    LIBRARY_AREA     data of the C library, always at the same address, so that it is compiled once
    FIRST            the variables, up to the last allocated page
    above            not valid

Compiled programs have the same bytes at the same addresses, guarded by the processor
(`plcsim.machine`); so pages are as large as any Linux system has them, and a page of WebAssembly.
"""

from __future__ import annotations

import errno
import gc
import mmap
import os
import weakref
from typing import TYPE_CHECKING, Any, TypeVar, cast, overload

from plcsim.core.errors import ConfigurationError, PageFault
from plcsim.core.system_area import SystemArea
from st_types.types.derived import ArrayType, StructType, resolve_alias
from st_types.types.layout import align_up
from st_types.types.paths import find
from st_types.types.values import decode, encode, initial_image
from st_types.types.views import Struct, address_of, type_of, view_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from st_types.types.arrays import Array
    from st_types.types.elementary import DataType

V = TypeVar("V")
S = TypeVar("S", bound=Struct)

PAGE = 0x1_0000
"""Bytes; the unit in which addresses become valid."""

SYSTEM_AREA = 0x10_0000
"""Address of the page that the controller shares with compiled code."""

LIBRARY_AREA = SYSTEM_AREA + PAGE
"""Address of the data of the C library, one page."""

FIRST = LIBRARY_AREA + PAGE
"""Address of the first variable."""

MAX_STACK = SYSTEM_AREA - PAGE
"""Bytes; a page of nil must stay below the stack."""

DEFAULT_SIZE = 16 * 1024 * 1024
"""Bytes for the variables of a controller where plc.toml does not say otherwise."""

MAX_SIZE = (1 << 31) - FIRST
"""Bytes; every address must be positive as a DINT too."""


class Memory:
    """The memory of one controller.

    Args:
        size: bytes for variables, a multiple of the page size.
        system_fd: file of a system area that is watched from outside; None makes one of its own.

    Attributes:
        size: bytes for variables.
        system: the page at `SYSTEM_AREA`.
        files: for a second mapping: descriptor, PLC address and bytes of each, later ones on top.
        stack: lowest address of the stack of compiled programs, which ends at `SYSTEM_AREA`.
    """

    def __init__(self, size: int = DEFAULT_SIZE, system_fd: int | None = None) -> None:
        if size % PAGE or not PAGE <= size <= MAX_SIZE:
            raise ConfigurationError(
                f"memory of {size} bytes: must be a multiple of {PAGE}, at most {MAX_SIZE}."
            )
        fd, self._map = _mapped(FIRST + size)
        files = [(fd, 0, FIRST + size)]
        self._top = FIRST
        self._limit = FIRST
        self._followers: list[Callable[[Memory], None]] = []
        self._kept: list[tuple[int, bytes]] = []
        self._at_boot: list[Callable[[], None]] = []
        self.stack = SYSTEM_AREA
        self.size = size
        if system_fd is None:
            self.system = SystemArea(memoryview(self._map)[SYSTEM_AREA : SYSTEM_AREA + PAGE])
            self.system.rearm()
        else:
            self.system = SystemArea.of_file(system_fd)
            files.append((os.dup(system_fd), SYSTEM_AREA, PAGE))
        self.files = tuple(files)
        for fd, _, _ in files:  # with us, or at the interpreter's end
            weakref.finalize(self, os.close, fd)

    @property
    def used(self) -> int:
        """Bytes allocated, from `FIRST`."""
        return self._top - FIRST

    @property
    def limit(self) -> int:
        """First address above the variables that is not valid, a multiple of `PAGE`."""
        return self._limit

    def allocate(self, size: int, alignment: int = 4) -> int:
        """Reserve ``size`` zeroed bytes and return their address, a multiple of 4 at least.

        Raises:
            ConfigurationError: the memory is full.
        """
        address = align_up(self._top, max(alignment, 4))
        if address + size > FIRST + self.size:
            raise ConfigurationError(
                f"the PLC memory of {self.size} bytes is full: {size} more bytes do not fit."
            )
        self._top = address + size
        limit = align_up(self._top, PAGE)  # by pages, as compiled code checks: all meet one fault
        if limit != self._limit:
            self._limit = limit
            self._tell()
        return address

    def keep(self, data: bytes, alignment: int = 4) -> int:
        """Reserve memory for bytes that are not variables, and return their address.

        They are there now, and each boot of the controller writes them again (`restore`).

        Raises:
            ConfigurationError: the memory is full.
        """
        address = self.allocate(len(data), alignment)
        self._kept.append((address, data))
        self.write(address, data)
        return address

    def restore(self) -> None:
        """Write what `keep` was given as it was, and call what `at_boot` was given."""
        for address, data in self._kept:
            self.write(address, data)
        for act in self._at_boot:
            act()

    def at_boot(self, act: Callable[[], None]) -> None:
        """Have ``act`` called at each boot of the controller, before the first program runs."""
        self._at_boot.append(act)

    def open_stack(self, size: int) -> None:
        """Make at least ``size`` bytes below `SYSTEM_AREA` valid as stack of compiled programs.

        Raises:
            ConfigurationError: it is more than `MAX_STACK`.
        """
        if not 0 <= size <= MAX_STACK:
            raise ConfigurationError(f"stack of {size} bytes: at most {MAX_STACK} can be had.")
        self.stack = min(self.stack, SYSTEM_AREA - align_up(size, PAGE))
        self._tell()

    def follow(self, moved: Callable[[Memory], None]) -> None:
        """Have ``moved`` called with this memory whenever `limit` or `stack` has moved."""
        self._followers.append(moved)

    def _tell(self) -> None:
        for moved in self._followers:
            moved(self)

    def new(self, view: type[S], context: object = None) -> S:
        """Allocate a variable of a Struct class, give it its initial values, return its view."""
        data_type = type_of(view)
        address = self.allocate(data_type.size, data_type.alignment)
        self._map[address : address + data_type.size] = initial_image(data_type)
        return cast("S", view_of(data_type, self._map, address, address, context))

    def check(self, address: int, size: int) -> None:
        """Raise PageFault unless all ``size`` bytes at ``address`` are valid."""
        # One comparison for nearly every access; the stack of compiled programs is the rare case.
        if size < 0 or not LIBRARY_AREA <= address <= self._limit - size:
            self._check_stack(address, size)

    def _check_stack(self, address: int, size: int) -> None:
        if size < 0 or not self.stack <= address < SYSTEM_AREA or size > SYSTEM_AREA - address:
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
        self.check(address, 1)  # the NUL may come before the end of what is valid, so no more yet
        end = min(address + limit, self._limit if address >= LIBRARY_AREA else SYSTEM_AREA)
        found = self._map.find(b"\0", address, end)
        if found < 0:
            self.check(address, limit)
        return self._map[address : end if found < 0 else found]

    @overload
    def access(self, data_type: type[S], address: int, context: object = None) -> S: ...
    @overload
    def access(self, data_type: ArrayType[V], address: int, context: object = None) -> V: ...
    @overload
    def access(self, data_type: StructType[V], address: int, context: object = None) -> V: ...
    def access(self, data_type: Any, address: int, context: object = None) -> object:
        """Return a view of the STRUCT or ARRAY at ``address``, as ``ref ACCESS address`` does.

        Args:
            data_type: what is taken to lie there.
            address: of its first byte.
            context: what function blocks in it work with.

        Raises:
            PageFault: some of its bytes are not valid.
        """
        kind = resolve_alias(type_of(data_type))
        self.check(address, kind.size)
        return view_of(kind, self._map, address, address, context)

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


def _mapped(size: int) -> tuple[int, mmap.mmap]:
    """Return a file in memory and its mapping.

    Where no descriptor is left, controllers that nobody uses any more may still hold some.
    """
    try:
        return _new_file(size)
    except OSError as err:
        if err.errno != errno.EMFILE:
            raise
    gc.collect()
    return _new_file(size)


def _new_file(size: int) -> tuple[int, mmap.mmap]:
    fd = os.memfd_create("plcsim-memory")
    try:
        os.ftruncate(fd, size)
        return fd, mmap.mmap(fd, size)
    except OSError:
        os.close(fd)
        raise


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
