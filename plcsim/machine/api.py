"""The C API of wasmtime as far as it is used, called without giving up the interpreter lock.

The library comes out of the ``wasmtime`` wheel, but its Python package is not imported: that takes
75 ms and each of its calls into WebAssembly 10 us, against 2 ms and 0.4 us here. Handles are
addresses, as ints. Misuse of this interface ends the process, so nothing outside this package
imports it.

Source: the headers wasm.h and wasmtime/*.h of wasmtime 50.
"""

from __future__ import annotations

import ctypes
import platform
import sys
from ctypes import byref, c_bool, c_char_p, c_int8, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from plcsim.machine.errors import MachineError

FUNCTION, GLOBAL, TABLE, MEMORY = range(4)
"""Kinds of what a module imports or exports (WASMTIME_EXTERN_*)."""

VALUE_KINDS = "iqfd"
"""i32, i64, f32, f64 in the order of wasm_valkind_t, as codes of the module ``struct``."""


class ByteVec(ctypes.Structure):
    """wasm_byte_vec_t, and any other vector of the API: the items are pointers there."""

    _fields_ = (("size", c_size_t), ("data", c_void_p))


class FunctionHandle(ctypes.Structure):
    """wasmtime_func_t."""

    _fields_ = (("store", c_uint64), ("private", c_void_p))


class InstanceHandle(ctypes.Structure):
    """wasmtime_instance_t."""

    _fields_ = (("store", c_uint64), ("private", c_size_t))


class GlobalHandle(ctypes.Structure):
    """wasmtime_global_t, the largest of the handles."""

    _fields_ = (("store", c_uint64), ("private", c_uint32 * 3))


class Handle(ctypes.Union):
    """wasmtime_extern_union_t."""

    _fields_ = (("function", FunctionHandle), ("variable", GlobalHandle), ("table", c_uint64 * 2))


class ExternStructure(ctypes.Structure):
    """wasmtime_extern_t."""

    _fields_ = (("kind", c_uint8), ("of", Handle))


class _Value(ctypes.Union):
    _fields_ = (
        ("i32", ctypes.c_int32),
        ("i64", c_uint64),
        ("function", FunctionHandle),
        ("v128", c_uint64 * 2),
    )


class ValueStructure(ctypes.Structure):
    """wasmtime_val_t; kind 0 is i32, 1 i64, 5 a reference to a function."""

    _fields_ = (("kind", c_uint8), ("of", _Value))


MEMORY_GETTER = ctypes.CFUNCTYPE(
    c_size_t, c_void_p, ctypes.POINTER(c_size_t), ctypes.POINTER(c_size_t)
)
MEMORY_GROWER = ctypes.CFUNCTYPE(c_size_t, c_void_p, c_size_t)
FINALIZER = ctypes.CFUNCTYPE(None, c_void_p)


class LinearMemory(ctypes.Structure):
    """wasmtime_linear_memory_t."""

    _fields_ = (
        ("env", c_void_p),
        ("get_memory", MEMORY_GETTER),
        ("grow_memory", MEMORY_GROWER),
        ("finalizer", FINALIZER),
    )


NEW_MEMORY = ctypes.CFUNCTYPE(
    c_size_t, c_void_p, c_void_p, *[c_size_t] * 4, ctypes.POINTER(LinearMemory)
)


class MemoryCreator(ctypes.Structure):
    """wasmtime_memory_creator_t."""

    _fields_ = (("env", c_void_p), ("new_memory", NEW_MEMORY), ("finalizer", FINALIZER))


HOST_CALLBACK = ctypes.CFUNCTYPE(c_void_p, c_int8, c_int8, c_size_t)
"""wasmtime_func_unchecked_callback_t, of which only the third argument is looked at.

That is the address of arguments and results, in slots of `SLOT` bytes. Each argument that becomes
a Python object takes its time, so the two before come as bytes and the fourth not at all; calling
conventions that pass arguments in registers allow it.
"""

PLAIN_CALLBACK = ctypes.CFUNCTYPE(c_void_p)
"""The same for functions without arguments and results."""

SLOT = 16
"""Bytes of a wasmtime_val_raw_t."""

_P = c_void_p
_PROTOTYPES: dict[str, tuple[object, list[object]]] = {
    "wasm_config_new": (_P, []),
    "wasmtime_config_host_memory_creator_set": (None, [_P, _P]),
    "wasm_engine_new_with_config": (_P, [_P]),
    "wasm_byte_vec_delete": (None, [_P]),
    "wasmtime_error_new": (_P, [c_char_p]),
    "wasmtime_error_message": (None, [_P, _P]),
    "wasmtime_error_delete": (None, [_P]),
    "wasmtime_module_new": (_P, [_P, c_char_p, c_size_t, _P]),
    "wasmtime_module_serialize": (_P, [_P, _P]),
    "wasmtime_module_deserialize": (_P, [_P, c_char_p, c_size_t, _P]),
    "wasmtime_module_delete": (None, [_P]),
    "wasmtime_module_imports": (None, [_P, _P]),
    "wasmtime_module_exports": (None, [_P, _P]),
    "wasm_importtype_module": (_P, [_P]),
    "wasm_importtype_name": (_P, [_P]),
    "wasm_importtype_type": (_P, [_P]),
    "wasm_importtype_vec_delete": (None, [_P]),
    "wasm_exporttype_name": (_P, [_P]),
    "wasm_exporttype_type": (_P, [_P]),
    "wasm_exporttype_vec_delete": (None, [_P]),
    "wasm_externtype_kind": (c_uint8, [_P]),
    "wasm_externtype_as_functype_const": (_P, [_P]),
    "wasm_functype_new": (_P, [_P, _P]),
    "wasm_functype_params": (_P, [_P]),
    "wasm_functype_results": (_P, [_P]),
    "wasm_valtype_new": (_P, [c_uint8]),
    "wasm_valtype_kind": (c_uint8, [_P]),
    "wasm_valtype_vec_new": (None, [_P, c_size_t, _P]),
    "wasm_globaltype_new": (_P, [_P, c_uint8]),
    "wasm_globaltype_delete": (None, [_P]),
    "wasmtime_store_new": (_P, [_P, _P, _P]),
    "wasmtime_store_context": (_P, [_P]),
    "wasmtime_store_delete": (None, [_P]),
    "wasmtime_context_set_fuel": (_P, [_P, c_uint64]),
    "wasmtime_context_get_fuel": (_P, [_P, _P]),
    "wasmtime_func_new_unchecked": (None, [_P, _P, _P, _P, _P, _P]),
    "wasmtime_global_new": (_P, [_P, _P, _P, _P]),
    "wasmtime_global_set": (_P, [_P, _P, _P]),
    "wasmtime_global_get": (None, [_P, _P, _P]),
    "wasmtime_table_grow": (_P, [_P, _P, c_uint64, _P, _P]),
    "wasmtime_table_set": (_P, [_P, _P, c_uint64, _P]),
    "wasmtime_instance_new": (_P, [_P, _P, _P, c_size_t, _P, _P]),
    "wasmtime_instance_export_get": (c_bool, [_P, _P, c_char_p, c_size_t, _P]),
    "wasmtime_trap_new_code": (_P, [c_uint8]),
    "wasmtime_trap_code": (c_bool, [_P, _P]),
    "wasm_trap_message": (None, [_P, _P]),
    "wasm_trap_trace": (None, [_P, _P]),
    "wasm_trap_delete": (None, [_P]),
    "wasm_frame_vec_delete": (None, [_P]),
    "wasm_frame_func_index": (c_uint32, [_P]),
    "wasm_frame_module_offset": (c_size_t, [_P]),
    "wasmtime_frame_func_name": (_P, [_P]),
    "wasmtime_frame_module_name": (_P, [_P]),
}

SETTINGS = {
    "parallel_compilation": False,  # it leaves threads behind
    "memory_may_move": False,
    "memory_init_cow": False,  # it would map its own pages over ours
    "native_unwind_info": False,  # backtraces go by frame pointers
    "wasm_component_model_more_async_builtins": False,
    "wasm_component_model_async_stackful": False,
    "wasm_component_model_async": False,
    "wasm_component_model": False,
    "concurrency_support": False,
    "wasm_exceptions": False,
    "wasm_gc": False,
    "wasm_function_references": False,
    "wasm_relaxed_simd": False,
    "wasm_simd": False,
    "wasm_reference_types": False,
    "wasm_bulk_memory": False,  # memory.fill on a page that is not valid kills the process
    "wasm_multi_memory": False,
    "wasm_memory64": False,
    "wasm_tail_call": False,
}
"""Settings of every engine; the order matters, some features need others."""


@cache
def library() -> ctypes.PyDLL:
    """Return the library with all prototypes set.

    Raises:
        MachineError: there is none for this system, in plain words.
    """
    api = ctypes.PyDLL(str(_file()))
    for function, (result, arguments) in _PROTOTYPES.items():
        entry = api[function]
        entry.restype = result  # type: ignore[assignment]  # any ctypes type may stand in the table
        entry.argtypes = arguments  # type: ignore[assignment]
        setattr(api, function, entry)
    return api


def _file() -> Path:
    spec = find_spec("wasmtime")
    if spec is None or not spec.submodule_search_locations:
        raise MachineError("compiled programs need the package wasmtime: pip install wasmtime")
    machine = {"AMD64": "x86_64", "arm64": "aarch64"}.get(platform.machine(), platform.machine())
    folder = Path(spec.submodule_search_locations[0]) / f"{sys.platform}-{machine}"
    file = folder / "_libwasmtime.so"
    if not file.is_file():
        raise MachineError(f"the installed package wasmtime has no library for {folder.name}")
    return file


def passed(number: int) -> Any:
    """Return what ctypes passes on as this number, an address or a size, with the least work."""
    return byref(ctypes.c_char.from_address(number))  # never looked at: only the address is taken


def quick(name: str) -> Any:
    """Return a function of the library for arguments that are ctypes objects already."""
    function = ctypes.PYFUNCTYPE(c_void_p)((name, library()))
    function.argtypes = None  # type: ignore[assignment]  # no conversion: that is most of the cost
    return function


@cache
def library_version() -> str:
    """Return the version of wasmtime."""
    try:
        return version("wasmtime")
    except PackageNotFoundError:
        return "unknown"


def text_of(vector: int | None) -> str:
    """Return the text of a wasm_byte_vec_t, "" where there is none."""
    if not vector:
        return ""
    found = ByteVec.from_address(vector)
    return ctypes.string_at(found.data, found.size).decode("utf-8", "replace").rstrip("\0")


def items_of(vector: ByteVec) -> list[int]:
    """Return the pointers in a vector of pointers."""
    return list((c_void_p * vector.size).from_address(vector.data)) if vector.size else []


def raise_error(error: int | None, what: str) -> None:
    """Raise MachineError where a function of the API has returned an error."""
    if error:
        raise MachineError(f"{what}: {take_message(error)}")


def take_message(error: int) -> str:
    """Return the message of an error as one line, and free it."""
    api, message = library(), ByteVec()
    api.wasmtime_error_message(error, ctypes.byref(message))
    text = text_of(ctypes.addressof(message))
    api.wasm_byte_vec_delete(ctypes.byref(message))
    api.wasmtime_error_delete(error)
    return " ".join(text.replace("\n\nCaused by:\n", ": ").split())
