"""The heap of one program in C: an area of PLC memory, and malloc and its relations on it.

The C library holds the algorithm, for any heap (libc/src/heap.h). A small module binds it to this
one, so what a program allocates is its own: its use is known, and a restart frees all of it.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Final

from plcsim.core.heap_use import HeapUse
from plcsim.core.tag import Tag
from plcsim.machine.encoder import ModuleWriter, Signature, sleb, uleb
from plcsim.machine.opcodes import CALL, I32, I32_CONST, LOCAL_GET
from st_types.types.derived import Member, StructType
from st_types.types.elementary import UDINT

if TYPE_CHECKING:
    from plcsim.ansi_c.c_library import CLibrary
    from plcsim.machine import Extern, Machine

_STRUCT_SIZE = 0x800  # struct plc_heap, rounded up
_ALIGNMENT = 8
_FUNCTIONS: Final = {
    "malloc": ("plc_malloc", 1, 1),
    "calloc": ("plc_calloc", 2, 1),
    "realloc": ("plc_realloc", 2, 1),
    "reallocarray": ("plc_reallocarray", 3, 1),
    "aligned_alloc": ("plc_aligned_alloc", 2, 1),
    "free": ("plc_free", 1, 0),
    "strdup": ("plc_strdup", 1, 1),
    "strndup": ("plc_strndup", 2, 1),
    "vasprintf": ("plc_vasprintf", 3, 1),
    "asprintf": ("plc_vasprintf", 3, 1),  # what "..." holds lies in memory
    "getdelim": ("plc_getdelim", 4, 1),
    "getline": ("plc_getline", 3, 1),
    # operators new, new[], delete and delete[] of C++, the latter also with a size
    "_Znwm": ("plc_new", 1, 1),
    "_Znam": ("plc_new", 1, 1),
    "_ZdlPv": ("plc_free", 1, 0),
    "_ZdaPv": ("plc_free", 1, 0),
    "_ZdlPvm": ("plc_delete", 2, 0),
    "_ZdaPvm": ("plc_delete", 2, 0),
}
"""By the name that programs use: the function of the C library, its further parameters, results."""


USE: Final = "plc_heap"
"""The variable of a program that tells how much of its heap is in use."""

_USE_TYPE: Final[StructType[object]] = StructType(
    USE, [Member(name, UDINT) for name in ("Size", "Used", "Most", "Areas", "Refused")]
)
_USE_OFFSET = 4  # of what `HeapUse` tells, in struct plc_heap


class ProgramHeap:
    """The heap of a program.

    Args:
        name: of the program, unique on the machine.
        machine: its controller's.
        library: the C library on it.
        size: in bytes.
    """

    def __init__(self, name: str, machine: Machine, library: CLibrary, size: int) -> None:
        self._memory = machine.memory
        self._size = size
        self._struct = self._memory.allocate(_STRUCT_SIZE + size, _ALIGNMENT)
        functions = {f for f, _, _ in _FUNCTIONS.values()}
        imports = {("c", f): extern for f in functions if (extern := library.extern(f))}
        code = machine.compile(_binding(f"heap of {name}", self._struct))
        self._instance = machine.instantiate(code, imports)
        self.reset()

    def extern(self, name: str) -> Extern:
        """Return malloc or one of its relations, for programs to import."""
        return self._instance.extern(name)

    def reset(self) -> None:
        """Forget all that was allocated, as before the program's first call."""
        head = struct.pack("<II", self._struct + _STRUCT_SIZE, self._size)
        self._memory.write(self._struct, head.ljust(_STRUCT_SIZE, b"\0"))

    def use(self) -> HeapUse:
        """Return how much of it is in use now."""
        return HeapUse(*struct.unpack("<5I", self._memory.read(self._struct + _USE_OFFSET, 20)))

    def tag(self, program: str) -> Tag:
        """Return `use` as a variable of the program, which nobody else writes."""
        held = StructType[object](program, [Member(USE, _USE_TYPE)])
        return Tag(program, held, self._struct + _USE_OFFSET, is_constant=True)


def is_of_heap(name: str) -> bool:
    """Return whether a function of this name works on the heap of who calls it."""
    return name in _FUNCTIONS


def _binding(name: str, heap: int) -> bytes:
    """Return a module whose functions are those of the C library with the heap filled in."""
    writer = ModuleWriter(name)
    targets = {
        target: writer.import_function("c", target, _signature(1 + count, results))
        for target, count, results in dict.fromkeys(_FUNCTIONS.values())
    }
    for function, (target, count, results) in _FUNCTIONS.items():
        index = writer.function(_signature(count, results), function)
        values = b"".join(LOCAL_GET + uleb(number) for number in range(count))
        writer.body(index, I32_CONST + sleb(heap) + values + CALL + uleb(targets[target]))
        writer.export_function(function, index)
    return writer.encode().wasm


def _signature(params: int, results: int) -> Signature:
    return Signature(bytes([I32] * params), bytes([I32] * results))
