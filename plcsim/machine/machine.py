"""The machine: compiled code on the memory of one controller."""

from __future__ import annotations

from ctypes import byref, c_uint64, c_void_p, cast
from typing import TYPE_CHECKING, Any, TypeVar

from plcsim.core.memory import PAGE, SYSTEM_AREA
from plcsim.machine.address_space import AddressSpace
from plcsim.machine.api import (
    FUNCTION,
    GLOBAL,
    ExternStructure,
    FunctionHandle,
    GlobalHandle,
    InstanceHandle,
    ValueStructure,
    library,
    raise_error,
)
from plcsim.machine.calls import WASM_CODES, host_callback, prepare
from plcsim.machine.encoder import ModuleWriter, sleb
from plcsim.machine.engine import MachineCode, Type, default_cache, engine_of, offered
from plcsim.machine.errors import Frame, MachineError
from plcsim.machine.opcodes import I32, I32_CONST
from plcsim.machine.signals import keep_handlers
from plcsim.machine.store import Store
from plcsim.machine.watch import MemoryWatch

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.core.memory import Memory
    from plcsim.machine.cache import CodeCache

T = TypeVar("T")

FUEL = 1 << 62
"""Instructions of a machine that has run no unit yet, where they are counted."""

UNIT_FUEL = 5_000_000_000
"""Instructions that a unit of a program may take, some seconds' worth; more is an endless loop."""

ENOUGH_FUEL = UNIT_FUEL // 2
"""Instructions that may be left over for what calls compiled code outside of units."""

MEMORY_NAME = ("env", "memory")
TABLE_NAME = ("env", "__indirect_function_table")
STACK_POINTER_NAME = ("env", "__stack_pointer")
"""What every module may import without being given it (names of the tool conventions for C)."""


class Extern:
    """Something that a module can import: an export of an instance, or a function in Python."""

    __slots__ = ("structure", "type")

    def __init__(self, structure: ExternStructure, type_: Type) -> None:
        self.structure = structure
        self.type = type_


class Instance:
    """A module, linked and ready to run on the machine's memory."""

    def __init__(self, store: Store, code: MachineCode, handle: InstanceHandle) -> None:
        self._store = store
        self._code = code
        self._handle = handle

    def __contains__(self, name: str) -> bool:
        return name in self._code.exports

    def extern(self, name: str) -> Extern:
        """Return an export, for the imports of other modules.

        Raises:
            MachineError: there is no such export.
        """
        structure = ExternStructure()
        data = name.encode()
        if not library().wasmtime_instance_export_get(
            self._store.context, byref(self._handle), data, len(data), byref(structure)
        ):
            raise MachineError(f"a module has no export {name!r}")
        return Extern(structure, self._code.exports[name])

    def function(
        self, name: str, params: str | None = None, results: str | None = None
    ) -> Callable[..., Any]:
        """Return an exported function as a Python callable.

        Calling it raises what a Python function has raised that the compiled code has called,
        MachineFault where the code has trapped, or CycleTimeViolation where it was ended by its
        budget. In each case the machine goes on.

        Args:
            name: of the export.
            params: codes of its parameters (see `plcsim.machine.calls`) where they are not signed.
            results: code of its result where that is not signed.

        Raises:
            MachineError: there is no such function, or it has other parameters.
        """
        extern = self.extern(name)
        if extern.type.kind != FUNCTION:
            raise MachineError(f"{name!r} is not a function")
        params = extern.type.params if params is None else params
        results = extern.type.results if results is None else results
        asked = Type(FUNCTION, _signed(params), _signed(results))
        if asked != extern.type:
            raise MachineError(
                f"{name!r} takes {extern.type.params!r} and gives {extern.type.results!r}, "
                f"not {params!r} and {results!r}"
            )
        # a copy, as the address of it is handed over in every call
        handle = FunctionHandle.from_buffer_copy(extern.structure.of.function)
        return prepare(self._store, handle, params, results)

    def value(self, name: str) -> int:
        """Return the value of an exported global variable of type i32 or i64, unsigned.

        Raises:
            MachineError: there is no such variable.
        """
        return self.variable(name)()

    def variable(self, name: str) -> Callable[[], int]:
        """Return what reads an exported global variable, as `value` does.

        Raises:
            MachineError: there is no such variable.
        """
        extern = self.extern(name)
        if extern.type.kind != GLOBAL:
            raise MachineError(f"{name!r} is not a global variable")
        value, handle, store = ValueStructure(), extern.structure.of, self._store
        get = library().wasmtime_global_get

        def read() -> int:
            get(store.context, byref(handle), byref(value))
            number: int = value.of.i64 if value.kind else value.of.i32 & 0xFFFF_FFFF
            return number

        return read


class Machine:
    """Runs compiled code on a memory.

    A fault or an exception ends the call and nothing else: machine and instances go on.

    Args:
        memory: of the controller; compiled code sees it at the same addresses.
        fuel: count instructions, exactly and alike on every machine; about half as fast.
        cache: where compiled code is kept; the user's own by default.
        compare: see `plcsim.machine.engine.Engine`; None lets the limits of the process decide.
        watch: called behind each instruction of compiled code that stores or calls, while the cell
            `WATCH` of the system area is 1, with its place as a frame; None for nobody.

    Raises:
        MachineError: the host has no room for it.
    """

    def __init__(
        self,
        memory: Memory,
        *,
        fuel: bool = False,
        cache: CodeCache | None = None,
        compare: bool | None = None,
        watch: Callable[[Frame], None] | None = None,
    ) -> None:
        self.memory = memory
        self._watch: MemoryWatch | None = None
        self._cache = cache or default_cache()
        self._engine = engine_of(fuel=fuel, compare=compare)
        keep_handlers()
        self._store = Store(self._engine, memory.system)
        self._spent = 0
        self._deducted: list[Callable[[], int]] = []
        if fuel:
            self._store.set_fuel(FUEL)
        space = AddressSpace(memory, compare=self._engine.compare)
        holder = self.compile(_holder(space.size // PAGE))
        with offered(space):
            self._holder = self.instantiate(holder, {})
        self._common = {
            name: self._holder.extern(name[1])
            for name in (MEMORY_NAME, TABLE_NAME, STACK_POINTER_NAME)
        }
        pointer = self._common[STACK_POINTER_NAME].structure.of.variable
        handle = GlobalHandle.from_buffer_copy(pointer)
        self._store.watch_stack(handle, SYSTEM_AREA, lambda: memory.stack)
        self._shared: dict[object, Any] = {}
        if watch is not None:
            entry = self.reserve_functions(1)
            self._watch = MemoryWatch(watch, entry)
            self.set_function(entry, self.host_function(self._watch.told, "q"))

    def close(self) -> None:
        """Give everything back at once; the instances must not be used any more."""
        self._shared.clear()
        self._store.close()

    def compile(self, wasm: bytes) -> MachineCode:
        """Return a module as machine code.

        Raises:
            MachineError: it is no valid module, or needs features that PLC programs do not have.
        """
        return self.compile_made(wasm, lambda: wasm)

    def compile_made(self, identity: bytes, make: Callable[[], bytes]) -> MachineCode:
        """Return a module as machine code that need not be made where it was compiled before.

        Args:
            identity: all that the module depends on.
            make: makes it.

        Raises:
            MachineError: as for `compile`.
        """
        if self._watch is not None:
            wasm = identity = self._watch.instrument(make())
            return self._engine.compile(identity, lambda: wasm, self._cache)
        return self._engine.compile(identity, make, self._cache)

    def instantiate(
        self, code: MachineCode, imports: Mapping[tuple[str, str], Extern | int]
    ) -> Instance:
        """Link a module, fill its part of memory and table, and run its start function.

        Args:
            code: compiled with the same settings.
            imports: by module and name; an int is a constant of type i32. Memory, table and stack
                pointer need not be given.

        Raises:
            MachineError: an import is missing or of another type; the message names it.
            MachineFault: its data lies at an address that is not valid, or its start has trapped.
        """
        if code.engine is not self._engine:
            raise MachineError("the module was compiled with other settings")
        wanted = [self._import(name, imports) for name in code.imports]
        array = (ExternStructure * len(wanted))(*wanted)
        handle, store = InstanceHandle(), self._store
        error = library().wasmtime_instance_new(
            store.context, code.handle, array, len(wanted), byref(handle), byref(store.trap)
        )
        raise_error(error, "a module cannot be linked")
        if store.trap:
            store.raise_fault(None)
        return Instance(store, code, handle)

    def _import(
        self, name: tuple[str, str], imports: Mapping[tuple[str, str], Extern | int]
    ) -> ExternStructure:
        found = imports.get(name) if name in imports else self._common.get(name)
        if found is None:
            raise MachineError(f"a module needs {'.'.join(name)}, which is not there")
        return self._constant(found) if isinstance(found, int) else found.structure

    def _constant(self, number: int) -> ExternStructure:
        """Return a global constant of type i32."""
        api, extern, value = library(), ExternStructure(), ValueStructure()
        value.of.i32 = (number ^ 0x8000_0000) - 0x8000_0000
        kind = api.wasm_globaltype_new(api.wasm_valtype_new(0), 0)
        extern.kind = GLOBAL
        error = api.wasmtime_global_new(self._store.context, kind, byref(value), byref(extern.of))
        api.wasm_globaltype_delete(kind)
        raise_error(error, "a constant")
        return extern

    def shared(self, make: Callable[[Machine], T]) -> T:
        """Return something that the machine has one of, made by ``make`` at the first call."""
        if make not in self._shared:
            self._shared[make] = make(self)
        found: T = self._shared[make]
        return found

    def unit(self, function: Callable[..., T]) -> Callable[..., T]:
        """Return a function as the unit of a program: where instructions are counted, it ends.

        So does a block or a function that Python calls; inside another unit it is part of that.
        Calling it raises CycleTimeViolation after `UNIT_FUEL` instructions.
        """
        if not self._engine.fuel:
            return function
        store = self._store
        allow, left = store.ration(UNIT_FUEL)

        def run(*arguments: Any) -> T:
            if store.depth:
                return function(*arguments)
            allow()
            try:
                return function(*arguments)
            finally:
                rest = left()
                self._spent += UNIT_FUEL - rest
                if rest < ENOUGH_FUEL:
                    store.set_fuel(FUEL)

        return run

    @property
    def meter(self) -> Callable[[], int] | None:
        """What tells the instructions of all units so far; None where they are not counted."""
        return self._instructions if self._engine.fuel else None

    def _instructions(self) -> int:
        if not self._deducted:
            return self._spent
        return self._spent - sum(told() for told in self._deducted)

    def deduct(self, told: Callable[[], int]) -> None:
        """Leave out of the meter what ``told`` gives: instructions that only measure others."""
        self._deducted.append(told)

    def host_function(
        self, call: Callable[..., Any], params: str = "", results: str = ""
    ) -> Extern:
        """Return a Python callable as something that modules can import.

        What it raises ends the compiled code that called it and comes out of the outer call
        unchanged.

        Args:
            call: the callable.
            params: codes of its parameters (see `plcsim.machine.calls`).
            results: code of its result, "" for none; integers wrap.
        """
        type_, callback = host_callback(self._store, call, params, results)
        extern = ExternStructure()
        extern.kind = FUNCTION
        library().wasmtime_func_new_unchecked(
            self._store.context, type_, cast(callback, c_void_p), None, None, byref(extern.of)
        )
        self._store.kept.append(callback)
        return Extern(extern, Type(FUNCTION, _signed(params), _signed(results)))

    def reserve_functions(self, count: int) -> int:
        """Make room in the table of functions; return the index of the first new entry.

        The new entries are nil.
        """
        entry, before = ValueStructure(), c_uint64()
        entry.kind = 5
        table = self._common[TABLE_NAME].structure.of
        error = library().wasmtime_table_grow(
            self._store.context, byref(table), count, byref(entry), byref(before)
        )
        raise_error(error, "the table of functions")
        return before.value

    def set_function(self, index: int, function: Extern) -> None:
        """Put a function into the table: a function pointer is an index in it."""
        entry = ValueStructure()
        entry.kind = 5
        entry.of.function = function.structure.of.function
        table = self._common[TABLE_NAME].structure.of
        error = library().wasmtime_table_set(self._store.context, byref(table), index, byref(entry))
        raise_error(error, f"entry {index} of the table of functions")

    @property
    def counts_fuel(self) -> bool:
        """Whether instructions are counted."""
        return self._engine.fuel

    @property
    def fuel(self) -> int:
        """Instructions left; what a call has used is the difference before and after it.

        Raises:
            MachineError: they are not counted.
        """
        self._require_fuel()
        return self._store.fuel()

    @fuel.setter
    def fuel(self, instructions: int) -> None:
        self._require_fuel()
        self._store.set_fuel(instructions)

    def _require_fuel(self) -> None:
        if not self._engine.fuel:
            raise MachineError("this machine does not count instructions")


def _signed(codes: str) -> str:
    return "".join(WASM_CODES[code] for code in codes)


def _holder(pages: int) -> bytes:
    """Return the module that owns memory, function table and stack pointer, to export them.

    A memory that is made by itself would not ask for ours; one that a module defines does.
    """
    writer = ModuleWriter("plc")
    writer.memory(pages, pages)
    writer.table(1)  # entry 0 stays nil
    pointer = writer.global_(I32, I32_CONST + sleb(SYSTEM_AREA))
    writer.export_memory(MEMORY_NAME[1])
    writer.export_table(TABLE_NAME[1])
    writer.export_global(STACK_POINTER_NAME[1], pointer)
    return writer.encode().wasm
