"""The C library on the machine of a controller: one instance for all that is compiled.

It comes along as a module, built from the sources beside it by ``python tools/build_c_library.py``,
so nobody needs a compiler to use it. Its data always lies in the same page of PLC memory.
"""

from __future__ import annotations

import hashlib
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from plcsim.ansi_c.headers import INCLUDE
from plcsim.ansi_c.module import CModule
from plcsim.core.memory import LIBRARY_AREA, PAGE
from plcsim.machine.errors import MachineError
from plcsim.machine.shared_module import read_shared

if TYPE_CHECKING:
    from plcsim.machine import Extern, Machine
    from plcsim.machine.shared_module import SharedModule

SOURCES: Final = Path(__file__).parent / "libc" / "src"
BINARY: Final = Path(__file__).parent / "libc" / "libc.wasm"
OPTIONS: Final = ("-g0", "-fno-builtin", "-Wall", "-Wextra")
"""Of the compiler; it must not take a loop in memcpy for a call of memcpy."""

STAMP: Final = "plcsim.sources"
"""Custom section that holds the hash of what the module was built from."""


class _Nothing:
    """The C library needs nothing from outside."""

    def variable(self, _name: str) -> int | None:
        return None

    def function(self, _name: str) -> Extern | None:
        return None


class CLibrary:
    """The C library, placed and ready.

    Args:
        machine: that it is for.
    """

    def __init__(self, machine: Machine) -> None:
        linked = linked_library()
        if linked.memory_size > PAGE:
            raise MachineError(f"the C library has {linked.memory_size} bytes of data")
        self._module = CModule("C library", linked, machine, _Nothing(), LIBRARY_AREA)
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

    def reset(self) -> None:
        """Forget what it knows from earlier calls, as at a restart of the controller."""
        self._module.reset()


@cache
def linked_library() -> SharedModule:
    """Return the module as it was built."""
    return read_shared(BINARY.read_bytes())


def sources() -> list[Path]:
    """Return the files that it is built from, without headers."""
    return sorted(SOURCES.glob("*.c"))


def stamp() -> bytes:
    """Return the hash of sources, headers and options of the compiler."""
    state = hashlib.blake2b("\0".join(OPTIONS).encode(), digest_size=16)
    for file in sorted([*SOURCES.glob("*.[ch]"), *INCLUDE.rglob("*.h")]):
        state.update(file.name.encode() + b"\0" + file.read_bytes() + b"\0")
    return state.digest()
