"""The C library on the machine of a controller: one instance for all that is compiled.

It comes along as a module, built from the sources beside it by ``python tools/build_c_library.py``,
so nobody needs a compiler to use it. Its data always lies in the same page of PLC memory.
"""

from __future__ import annotations

import errno
import hashlib
import re
import struct
import sys
from functools import cache, cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple, NoReturn, Protocol

from plcsim.ansi_c.headers import INCLUDE
from plcsim.ansi_c.module import CModule
from plcsim.ansi_c.nonlocal_jumps import NonlocalJumps
from plcsim.core.memory import LIBRARY_AREA, PAGE
from plcsim.machine.errors import FaultKind, MachineError, MachineFault
from plcsim.machine.shared_module import read_shared

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.machine import Extern, Machine
    from plcsim.machine.engine import Type
    from plcsim.machine.shared_module import SharedModule

SOURCES: Final = Path(__file__).parent / "libc" / "src"
BINARY: Final = Path(__file__).parent / "libc" / "libc.wasm"
MUSL: Final = Path(__file__).parent / "libc" / "musl"
OPTIONS: Final = (
    *("-g0", "-fno-builtin", "-Wall", "-Wextra"),
    "-fstrict-float-cast-overflow",  # its own numbers fit
    # the manner of musl's sources
    *("-Wno-shift-op-parentheses", "-Wno-ignored-pragmas", "-Wno-unknown-pragmas"),
)
"""Of the compiler; it must not take a loop in memcpy for a call of memcpy."""

STAMP: Final = "plcsim.sources"
"""Custom section that holds the hash of what the module was built from."""

STACK_SIZE: Final = 0x4_0000
"""Bytes of the stack that the library, all programs in C, and functions in Structured Text that
call themselves share."""

LONGEST_PATH: Final = 259
"""Bytes of the path of a file."""

_STDERR = 2
_LONGEST_REASON = 500


class FolderEntry(NamedTuple):
    """A file or a folder.

    Attributes:
        is_folder: whether it is a folder.
        size: of a file, in bytes.
        date_s: of the last change, in seconds since 1970-01-01.
        name: in its folder.
    """

    is_folder: bool
    size: int
    date_s: int
    name: bytes = b""


_ENTRY = struct.Struct("<IIq256s")  # struct plc_entry


class Files(Protocol):
    """The files that fopen and its relations find.

    All raise OSError for what cannot be done. A file is a number that `open` gives.
    """

    def open(self, path: bytes, flags: int) -> int:
        """Open a file; flags are those of libc/src/host.h."""

    def close(self, file: int) -> None:
        """Close it."""

    def read(self, file: int, address: int, count: int, place: int) -> int:
        """Read bytes into memory; return how many there were."""

    def write(self, file: int, address: int, count: int, place: int) -> int:
        """Write bytes of memory; return how many."""

    def size(self, file: int) -> int:
        """Return the bytes of a file."""

    def remove(self, path: bytes) -> None:
        """Delete a file."""

    def rename(self, old: bytes, new: bytes) -> None:
        """Rename a file."""

    def entry(self, path: bytes) -> FolderEntry:
        """Tell of a file or a folder, without its name."""

    def entry_of_file(self, file: int) -> FolderEntry:
        """Tell of an open file, without its name."""

    def open_folder(self, path: bytes) -> int:
        """Open a folder; return a number for it."""

    def next_entry(self, folder: int) -> FolderEntry | None:
        """Return the next entry of a folder, None behind the last one."""

    def close_folder(self, folder: int) -> None:
        """Close a folder."""

    def make_folder(self, path: bytes) -> None:
        """Make a folder."""

    def remove_folder(self, path: bytes) -> None:
        """Delete an empty folder."""


class _Host:
    """What the C library asks of the controller around it (libc/src/host.h)."""

    def __init__(self, machine: Machine) -> None:
        self._memory = machine.memory
        self._make = machine.host_function
        self._jumps = machine.shared(NonlocalJumps)
        self.files: Files | None = None
        self._functions = {
            "plc_write": self._make(self._write, "III"),
            "plc_fault": self._make(self._fault, "I"),
            "plc_longjmp": self._make(self._jumps.jump, "I"),
            "plc_throw": self._make(self._throw, "II"),
            "plc_file_open": self._of_files(lambda f, p, flags: f.open(self._path(p), flags), 2),
            "plc_file_close": self._of_files(lambda f, file: f.close(file), 1),
            "plc_file_read": self._of_files(lambda f, *values: f.read(*values), 4),
            "plc_file_write": self._of_files(lambda f, *values: f.write(*values), 4),
            "plc_file_size": self._of_files(lambda f, file: f.size(file), 1),
            "plc_file_remove": self._of_files(lambda f, p: f.remove(self._path(p)), 1),
            "plc_file_rename": self._of_files(
                lambda f, old, new: f.rename(self._path(old), self._path(new)), 2
            ),
            "plc_entry_of": self._of_files(
                lambda f, p, to: self._tell(f.entry(self._path(p)), to), 2
            ),
            "plc_entry_of_file": self._of_files(
                lambda f, file, to: self._tell(f.entry_of_file(file), to), 2
            ),
            "plc_folder_open": self._of_files(lambda f, p: f.open_folder(self._path(p)), 1),
            "plc_folder_next": self._of_files(
                lambda f, folder, to: self._tell(f.next_entry(folder), to), 2
            ),
            "plc_folder_close": self._of_files(lambda f, folder: f.close_folder(folder), 1),
            "plc_folder_make": self._of_files(lambda f, p: f.make_folder(self._path(p)), 1),
            "plc_folder_remove": self._of_files(lambda f, p: f.remove_folder(self._path(p)), 1),
        }

    def _of_files(self, act: Callable[..., int | None], count: int) -> Extern:
        """Return a function that gives a number, or one of errno.h below 0."""

        def call(*values: int) -> int:
            if self.files is None:
                return -_ERRNO["ENODEV"]
            try:
                return act(self.files, *values) or 0
            except OSError as error:
                return -_ERRNO.get(errno.errorcode.get(error.errno or 0, ""), _ERRNO["EIO"])

        return self._make(call, "I" * count, "i")

    def _path(self, address: int) -> bytes:
        path = self._memory.string(address, LONGEST_PATH + 1)
        if len(path) > LONGEST_PATH:
            raise OSError(errno.ENAMETOOLONG, "path")
        return path

    def _tell(self, entry: FolderEntry | None, address: int) -> int:
        """Write an entry; return whether there is one."""
        if entry is None:
            return 0
        self._memory.write(
            address, _ENTRY.pack(entry.is_folder, entry.size, entry.date_s, entry.name[:255])
        )
        return 1

    def variable(self, _name: str) -> int | None:
        return None

    def function(self, name: str, _wanted: Type | None = None) -> Extern | None:
        return self._functions.get(name)

    def _write(self, file: int, address: int, length: int) -> None:
        text = self._memory.read(address, length).decode("utf-8", "backslashreplace")
        (sys.stderr if file == _STDERR else sys.stdout).write(text)

    def _fault(self, address: int) -> NoReturn:
        raise MachineFault(FaultKind.OTHER, detail=self._reason(address))

    def _throw(self, address: int, again: int) -> NoReturn:
        self._jumps.jump(again, self._reason(address))

    def _reason(self, address: int) -> str:
        return self._memory.string(address, _LONGEST_REASON).decode("utf-8", "backslashreplace")


class CLibrary:
    """The C library, placed; the first function that somebody takes of it makes it ready.

    Args:
        machine: that it is for; it has one.
    """

    def __init__(self, machine: Machine) -> None:
        linked = linked_library()
        if linked.memory_size > PAGE:
            raise MachineError(f"the C library has {linked.memory_size} bytes of data")
        machine.memory.open_stack(STACK_SIZE)
        self._host = _Host(machine)
        self._placed = CModule("C library", linked, machine, self._host, LIBRARY_AREA)
        self._externs: dict[str, Extern] = {}

    def compile(self) -> bool:
        """Compile it to machine code; return whether that was in no cache."""
        return self._placed.compile()

    @cached_property
    def _module(self) -> CModule:
        """The module, ready."""
        module = self._placed.link()
        module.reset()
        return module

    def extern(self, name: str) -> Extern | None:
        """Return a function for others to import, None where there is none of this name."""
        if name not in self._externs and name in self._placed:
            self._externs[name] = self._module.extern(name)
        return self._externs.get(name)

    def function(self, name: str, params: str | None = None, results: str | None = None) -> Any:
        """Return a function as a Python callable."""
        return self._module.function(name, params, results)

    def variable(self, name: str) -> int | None:
        """Return the address of a variable such as ``errno``, None where there is none."""
        return self._placed.address_of(name)

    def use_files(self, files: Files) -> None:
        """Let fopen and its relations open files; without this there is no device for them."""
        self._host.files = files

    def reset(self) -> None:
        """Forget what it knows from earlier calls, as at a restart of the controller."""
        self._module.reset()


_ERRNO: Final = {
    name: int(number)
    for name, number in re.findall(r"#define (E\w+) (\d+)", (INCLUDE / "errno.h").read_text())
}
"""Numbers of the controller by their names, which the host has other numbers for."""


@cache
def linked_library() -> SharedModule:
    """Return the module as it was built."""
    return read_shared(BINARY.read_bytes())


def sources() -> list[Path]:
    """Return the files that it is built from, without headers."""
    return sorted([*SOURCES.glob("*.c"), *MUSL.glob("*.c")])


def stamp() -> bytes:
    """Return the hash of sources, headers and options of the compiler."""
    state = hashlib.blake2b("\0".join(OPTIONS).encode(), digest_size=16)
    for file in sorted([*SOURCES.glob("*.[ch]"), *MUSL.glob("*.[ch]"), *INCLUDE.rglob("*.h")]):
        state.update(file.name.encode() + b"\0" + file.read_bytes() + b"\0")
    return state.digest()
