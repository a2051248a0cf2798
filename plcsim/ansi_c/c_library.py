"""The C library on the machine of a controller: one instance for all that is compiled.

It comes along as a module, built from the sources beside it by ``python tools/build_c_library.py``,
so nobody needs a compiler to use it. Its data always lies in the same page of PLC memory.
"""

from __future__ import annotations

import hashlib
import sys
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NoReturn

from plcsim.ansi_c.headers import INCLUDE
from plcsim.ansi_c.module import CModule
from plcsim.core.memory import LIBRARY_AREA, PAGE
from plcsim.machine.errors import FaultKind, MachineError, MachineFault
from plcsim.machine.shared_module import read_shared

if TYPE_CHECKING:
    from plcsim.machine import Extern, Machine
    from plcsim.machine.shared_module import SharedModule

SOURCES: Final = Path(__file__).parent / "libc" / "src"
BINARY: Final = Path(__file__).parent / "libc" / "libc.wasm"
MUSL: Final = Path(__file__).parent / "libc" / "musl"
OPTIONS: Final = (
    *("-g0", "-fno-builtin", "-Wall", "-Wextra"),
    # the manner of musl's sources
    *("-Wno-shift-op-parentheses", "-Wno-ignored-pragmas", "-Wno-unknown-pragmas"),
)
"""Of the compiler; it must not take a loop in memcpy for a call of memcpy."""

STAMP: Final = "plcsim.sources"
"""Custom section that holds the hash of what the module was built from."""

STACK_SIZE: Final = 0x4_0000
"""Bytes of the stack that the library and all programs in C share."""

_STDERR = 2
_LONGEST_REASON = 500


class _Host:
    """What the C library asks of the controller around it (libc/src/host.h)."""

    def __init__(self, machine: Machine) -> None:
        self._memory = machine.memory
        self._functions = {
            "plc_write": machine.host_function(self._write, "III"),
            "plc_fault": machine.host_function(self._fault, "I"),
        }

    def variable(self, _name: str) -> int | None:
        return None

    def function(self, name: str) -> Extern | None:
        return self._functions.get(name)

    def _write(self, file: int, address: int, length: int) -> None:
        text = self._memory.read(address, length).decode("utf-8", "backslashreplace")
        (sys.stderr if file == _STDERR else sys.stdout).write(text)

    def _fault(self, address: int) -> NoReturn:
        reason = self._memory.string(address, _LONGEST_REASON).decode("utf-8", "backslashreplace")
        raise MachineFault(FaultKind.OTHER, detail=reason)


class CLibrary:
    """The C library, placed and ready.

    Args:
        machine: that it is for; it has one.
    """

    def __init__(self, machine: Machine) -> None:
        linked = linked_library()
        if linked.memory_size > PAGE:
            raise MachineError(f"the C library has {linked.memory_size} bytes of data")
        machine.memory.open_stack(STACK_SIZE)
        host = _Host(machine)
        self._module = CModule("C library", linked, machine, host, LIBRARY_AREA)
        self._externs: dict[str, Extern] = {}
        self.reset()

    def extern(self, name: str) -> Extern | None:
        """Return a function for others to import, None where there is none of this name."""
        if name not in self._externs and name in self._module:
            self._externs[name] = self._module.extern(name)
        return self._externs.get(name)

    def function(self, name: str, params: str | None = None, results: str | None = None) -> Any:
        """Return a function as a Python callable."""
        return self._module.function(name, params, results)

    def variable(self, name: str) -> int | None:
        """Return the address of a variable such as ``errno``, None where there is none."""
        return self._module.address_of(name)

    def reset(self) -> None:
        """Forget what it knows from earlier calls, as at a restart of the controller."""
        self._module.reset()


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
