"""The host's part of setjmp and longjmp; the C library's is ``libc/src/setjmp.c``.

A function of C that calls setjmp makes its further calls by ``invoke_RESULTPARAMETERS``, which
takes a pointer to a function and what that takes. longjmp ends the compiled code up to the nearest
of them, as a fault would; from it the function goes on.

Source: LLVM, WebAssemblyLowerEmscriptenEHSjLj.cpp.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final, NoReturn

from plcsim.machine.encoder import ModuleWriter, Signature, uleb
from plcsim.machine.errors import FaultKind, MachineFault, go_on
from plcsim.machine.machine import STACK_POINTER_NAME, TABLE_NAME
from plcsim.machine.opcodes import (
    CALL,
    CALL_INDIRECT,
    F32,
    F64,
    GLOBAL_GET,
    GLOBAL_SET,
    I32,
    I64,
    LOCAL_GET,
    LOCAL_SET,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.machine import Extern, Instance, Machine

_NAME: Final = re.compile(r"invoke_([vijfd])([ijfd]*)")
_TYPES: Final = {"i": I32, "j": I64, "f": F32, "d": F64}
_CODES: Final = str.maketrans("j", "q", "v")


_NOBODY: Final = "longjmp to a function that has returned or never called setjmp"


class NonlocalJump(MachineFault):
    """longjmp was called, or C++ throws; it is a fault where no function waits for it.

    Args:
        detail: what the fault says.
    """

    def __init__(self, detail: str = _NOBODY) -> None:
        super().__init__(FaultKind.OTHER, detail=detail)


class NonlocalJumps:
    """The jumps of one machine, and its functions ``invoke_...``.

    Args:
        machine: the machine; it has one of this.
    """

    def __init__(self, machine: Machine) -> None:
        self._machine = machine
        self._externs: dict[str, Extern] = {}
        self._ended = NonlocalJump()

    def jump(self, again: int, detail: str = _NOBODY) -> NoReturn:
        """End the compiled code up to the nearest call by ``invoke_...``.

        Args:
            again: not 0 for the jump that has ended such a call last, and is not meant for it.
            detail: what the fault says that it is where there is no such call.
        """
        jump = NonlocalJump(detail)
        if again:
            go_on(jump, self._ended)
        raise jump

    def extern(self, name: str) -> Extern | None:
        """Return one of them for modules to import, None where the name is another one."""
        found = _NAME.fullmatch(name)
        if found is None:
            return None
        if name not in self._externs:
            self._externs[name] = self._made(name, *found.groups())
        return self._externs[name]

    def _made(self, name: str, results: str, params: str) -> Extern:
        codes = f"I{params.translate(_CODES)}", results.translate(_CODES)
        calling = self._instance(_calling(name, results, params), {})
        guarded = self._machine.host_function(
            self._guarded(calling.function("call", *codes)), *codes
        )
        keeping = self._instance(_keeping(name, results, params), {("host", "call"): guarded})
        return keeping.extern(name)

    def _guarded(self, call: Callable[..., Any]) -> Callable[..., Any]:
        """Return what calls a function, up to a jump; what it gives then nobody reads."""

        def guarded(*values: Any) -> Any:
            try:
                return call(*values)
            except NonlocalJump as ended:
                self._ended = ended
                return 0

        return guarded

    def _instance(self, wasm: bytes, imports: dict[tuple[str, str], Extern | int]) -> Instance:
        return self._machine.instantiate(self._machine.compile(wasm), imports)


def _calling(name: str, results: str, params: str) -> bytes:
    """Return a module with ``call(pointer, ...)``, which calls what the pointer stands for."""
    writer = ModuleWriter(f"{name}: call")
    writer.import_table(*TABLE_NAME)
    index = writer.function(_signature(results, f"i{params}"), "call")
    target = writer.type_index(_signature(results, params))
    code = _values(range(1, 1 + len(params))) + LOCAL_GET + uleb(0)
    writer.body(index, code + CALL_INDIRECT + uleb(target) + uleb(0))
    writer.export_function("call", index)
    return writer.encode().wasm


def _keeping(name: str, results: str, params: str) -> bytes:
    """Return a module with ``invoke_...``, which keeps the stack of C as it is."""
    writer = ModuleWriter(name)
    signature = _signature(results, f"i{params}")
    call = writer.import_function("host", "call", signature)
    pointer = writer.import_global(*STACK_POINTER_NAME, I32, mutable=True)
    index = writer.function(signature, name)
    kept = uleb(1 + len(params))
    code = (
        *(GLOBAL_GET, uleb(pointer), LOCAL_SET, kept),
        *(_values(range(1 + len(params))), CALL, uleb(call)),
        *(LOCAL_GET, kept, GLOBAL_SET, uleb(pointer)),
    )
    writer.body(index, b"".join(code), bytes([I32]))
    writer.export_function(name, index)
    return writer.encode().wasm


def _values(numbers: range) -> bytes:
    return b"".join(LOCAL_GET + uleb(number) for number in numbers)


def _signature(results: str, params: str) -> Signature:
    return Signature(
        *(bytes(_TYPES[code] for code in codes) for codes in (params, results.strip("v")))
    )
