"""Engines: compilers of WebAssembly with one set of settings, one of each kind in a process.

Settings that wasmtime cannot combine would end the process, so they are fixed here
(`plcsim.machine.api.SETTINGS`) but for two that are tested together.
"""

from __future__ import annotations

import contextlib
import ctypes
import faulthandler
from collections import OrderedDict
from ctypes import byref, c_void_p
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

from plcsim.host import helper_process, realtime
from plcsim.machine.address_space import GUARD, RESERVATION, AddressSpace, must_compare
from plcsim.machine.api import (
    FINALIZER,
    FUNCTION,
    MEMORY_GETTER,
    MEMORY_GROWER,
    NEW_MEMORY,
    SETTINGS,
    VALUE_KINDS,
    ByteVec,
    MemoryCreator,
    items_of,
    library,
    library_version,
    raise_error,
    text_of,
)
from plcsim.machine.cache import CodeCache, default_folder, key_of
from plcsim.machine.errors import MachineError
from plcsim.machine.reader import DATA, sections

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

CODES_KEPT = 64
"""Modules an engine remembers besides the cache on disk, for many controllers in one process."""


class Type(NamedTuple):
    """What a module imports or exports.

    Attributes:
        kind: `plcsim.machine.api.FUNCTION`, GLOBAL, TABLE or MEMORY.
        params: of a function, one code of `VALUE_KINDS` each.
        results: of a function.
    """

    kind: int
    params: str = ""
    results: str = ""


class MachineCode:
    """A compiled module.

    Attributes:
        handle: wasmtime_module_t.
        engine: that compiled it.
        imports: module and name of each import, in order.
        exports: types by name.
        is_new: it had to be compiled for who asked for it last.
    """

    is_new = False

    def __init__(self, handle: int, engine: Engine) -> None:
        self.handle = handle
        self.engine = engine
        self.imports = _imports(handle)
        self.exports = _exports(handle)
        self._delete = library().wasmtime_module_delete

    def __del__(self) -> None:
        self._delete(self.handle)


class Engine:
    """A compiler with its settings; get one by `engine_of`, an engine lives as long as the process.

    Args:
        fuel: compiled code counts its instructions.
        compare: compiled code compares addresses with the end of the memory.
    """

    def __init__(self, *, fuel: bool, compare: bool) -> None:
        _let_faulthandler_be_first()
        api = library()
        self.fuel = fuel
        self.compare = compare
        settings: dict[str, bool | int] = {
            **SETTINGS,
            "consume_fuel": fuel,
            "memory_reservation": 0 if compare else RESERVATION,
            "memory_guard_size": 0 if compare else GUARD,
        }
        config = api.wasm_config_new()
        for name, value in settings.items():
            kind = ctypes.c_bool if isinstance(value, bool) else ctypes.c_uint64
            api[f"wasmtime_config_{name}_set"](c_void_p(config), kind(value))
        api.wasmtime_config_host_memory_creator_set(config, byref(_CREATOR))
        self.handle: int = api.wasm_engine_new_with_config(config)
        self._settings = f"{library_version()} {settings}"
        self._codes: OrderedDict[str, MachineCode] = OrderedDict()

    def compile(self, identity: bytes, make: Callable[[], bytes], cache: CodeCache) -> MachineCode:
        """Return a module as machine code, compiled now or before.

        Args:
            identity: what the module depends on, if not the module itself.
            make: makes the module; called only where it has not been compiled before.
            cache: where compiled code is kept.

        Raises:
            MachineError: it is no valid module, or needs features that PLC programs do not have.
        """
        key = key_of(identity, self._settings)
        known = self._codes.pop(key, None) or self._load(key, cache)
        code = known or self._made(make(), key, cache)
        code.is_new = known is None
        self._codes[key] = code
        if len(self._codes) > CODES_KEPT:
            self._codes.popitem(last=False)
        return code

    def _load(self, key: str, cache: CodeCache) -> MachineCode | None:
        data = cache.load(key)
        if data is None:
            return None
        module, api = c_void_p(), library()
        error = api.wasmtime_module_deserialize(self.handle, data, len(data), byref(module))
        if error:  # of another version of wasmtime, or for another processor
            api.wasmtime_error_delete(error)
            return None
        return MachineCode(module.value or 0, self)

    def _made(self, wasm: bytes, key: str, cache: CodeCache) -> MachineCode:
        """Compile a module; a process with real-time rights has a copy of itself do it.

        What compiling takes of a processor and of memory is then neither in the way of others nor
        locked.
        """
        if cache.keeps and realtime.is_held() and helper_process.is_alone():
            with helper_process.helper_process(lambda: self._compile(wasm, key, cache)) as wait:
                wait()
            found = self._load(key, cache)
            if found is not None:
                return found
        return self._compile(wasm, key, cache)

    def _compile(self, wasm: bytes, key: str, cache: CodeCache) -> MachineCode:
        _refuse_data(wasm)
        module, api = c_void_p(), library()
        error = api.wasmtime_module_new(self.handle, wasm, len(wasm), byref(module))
        raise_error(error, "a module cannot be compiled")
        code = MachineCode(module.value or 0, self)
        data = ByteVec()
        raise_error(api.wasmtime_module_serialize(code.handle, byref(data)), "serialize")
        cache.store(key, ctypes.string_at(data.data, data.size))
        api.wasm_byte_vec_delete(byref(data))
        return code


def engine_of(*, fuel: bool, compare: bool | None = None) -> Engine:
    """Return the engine of this process with these settings.

    Args:
        fuel: compiled code counts its instructions.
        compare: see `Engine`; None lets the limits of the process decide.
    """
    return _engine(fuel, must_compare() if compare is None else compare)


@cache
def _engine(fuel: bool, compare: bool) -> Engine:  # a key of the cache
    return Engine(fuel=fuel, compare=compare)


@cache
def default_cache() -> CodeCache:
    """Return the cache in the user's own folder."""
    return CodeCache(default_folder())


def compile_wasm(wasm: bytes, *, fuel: bool = False, cache: CodeCache | None = None) -> MachineCode:
    """Return a module as machine code, for any machine with the same settings in this process.

    The parent of the scan process may call this, so that the scan process finds it in the cache.

    Args:
        wasm: the module.
        fuel: it counts its instructions.
        cache: where compiled code is kept; the user's own by default.

    Raises:
        MachineError: it is no valid module, or needs features that PLC programs do not have.
    """
    return engine_of(fuel=fuel).compile(wasm, lambda: wasm, cache or default_cache())


def _refuse_data(wasm: bytes) -> None:
    """Refuse initial data: wasmtime copies it without a check that would meet our guards."""
    if any(section.number == DATA for section in sections(wasm)):
        raise MachineError(
            "a module cannot be compiled: it has data, which its loader must take out"
        )


def _let_faulthandler_be_first() -> None:
    """Have Python's handler of SIGSEGV below that of wasmtime, which passes on what is not its own.

    The other way round the first page fault of a compiled program would end the process. Who
    enables faulthandler later only changes where it writes.
    """
    if not faulthandler.is_enabled():
        faulthandler.enable(file=2)


def _imports(module: int) -> list[tuple[str, str]]:
    api, vector = library(), ByteVec()
    api.wasmtime_module_imports(module, byref(vector))
    found = [
        (text_of(api.wasm_importtype_module(item)), text_of(api.wasm_importtype_name(item)))
        for item in items_of(vector)
    ]
    api.wasm_importtype_vec_delete(byref(vector))
    return found


def _exports(module: int) -> dict[str, Type]:
    api, vector = library(), ByteVec()
    api.wasmtime_module_exports(module, byref(vector))
    found = {
        text_of(api.wasm_exporttype_name(item)): _type(api.wasm_exporttype_type(item))
        for item in items_of(vector)
    }
    api.wasm_exporttype_vec_delete(byref(vector))
    return found


def _type(extern: int) -> Type:
    api = library()
    kind = api.wasm_externtype_kind(extern)
    if kind != FUNCTION:
        return Type(kind)
    function = api.wasm_externtype_as_functype_const(extern)
    return Type(
        kind,
        _codes(api.wasm_functype_params(function)),
        _codes(api.wasm_functype_results(function)),
    )


def _codes(values: int) -> str:
    kinds = [library().wasm_valtype_kind(item) for item in items_of(ByteVec.from_address(values))]
    return "".join(VALUE_KINDS[kind] for kind in kinds)


# The memory of a machine is given to the engine while its module of the memory is instantiated.

_offered: list[AddressSpace] = []
_spaces: dict[int, AddressSpace] = {}


@contextlib.contextmanager
def offered(space: AddressSpace) -> Iterator[None]:
    """Let the memory that a module defines meanwhile be this one; it then belongs to the store."""
    _offered.append(space)
    try:
        yield
    finally:
        _offered.clear()


def _new_memory(
    _env: int, _type: int, _minimum: int, _maximum: int, _reserved: int, _guard: int, out: object
) -> int:
    if not _offered:
        error: int = library().wasmtime_error_new(b"a module must import the memory of the PLC")
        return error
    space = _offered.pop()
    _spaces[space.base] = space
    memory = out.contents  # type: ignore[attr-defined]  # a pointer of ctypes
    memory.env = space.base
    memory.get_memory = _GETTER
    memory.grow_memory = _GROWER
    memory.finalizer = _RELEASER
    return 0


def _get_memory(base: int, size: object, capacity: object) -> int:
    size[0] = capacity[0] = _spaces[base].size  # type: ignore[index]  # pointers of ctypes
    return base


def _grow_memory(_base: int, _size: int) -> int:
    error: int = library().wasmtime_error_new(b"PLC memory does not grow")
    return error


def _release_memory(base: int) -> None:
    _spaces.pop(base).close()


_GETTER = MEMORY_GETTER(_get_memory)
_GROWER = MEMORY_GROWER(_grow_memory)
_RELEASER = FINALIZER(_release_memory)
_CREATOR = MemoryCreator(None, NEW_MEMORY(_new_memory), FINALIZER())
