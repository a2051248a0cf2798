"""Calls between Python and compiled code, prepared once so that each costs well below 1 us.

Values are described by the codes of the module ``struct``: "i" and "q" signed, "I" and "Q" unsigned
integers of 32 and 64 bits, "f" and "d" floating-point numbers.
"""

from __future__ import annotations

import ctypes
import struct
from ctypes import byref, c_uint32, c_void_p
from typing import TYPE_CHECKING, Any

from plcsim.machine.api import (
    HOST_CALLBACK,
    PLAIN_CALLBACK,
    SLOT,
    VALUE_KINDS,
    ByteVec,
    FunctionHandle,
    library,
    passed,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.machine.store import Store

CTYPES: dict[str, Any] = {
    "i": ctypes.c_int32,
    "I": ctypes.c_uint32,
    "q": ctypes.c_int64,
    "Q": ctypes.c_uint64,
    "f": ctypes.c_float,
    "d": ctypes.c_double,
}
"""By code; integers wrap in them."""

WASM_CODES = {"i": "i", "I": "i", "q": "q", "Q": "q", "f": "f", "d": "d"}
"""The value type, as its signed code, of each code."""

_function_types: dict[tuple[int, str, str], int] = {}
"""By engine and codes: a type belongs to the engine that it was first used with."""


def prepare(
    store: Store, function: FunctionHandle, params: str = "", results: str = ""
) -> Callable[..., Any]:
    """Return a Python callable that calls a compiled function.

    Args:
        store: the function's.
        function: the function; the callable keeps it.
        params: codes of its parameters; integers are taken signed or unsigned, and wrap.
        results: code of its result, "" for none.
    """
    slots = (ctypes.c_char * (SLOT * max(len(params), len(results), 1)))()
    trap = store.trap
    context = passed(store.context)
    target = byref(function)
    values = byref(slots)
    count = passed(max(len(params), len(results)))
    out = byref(trap)
    enter, raise_fault, interrupted = store.enter, store.raise_fault, store.interrupted

    def run() -> None:
        try:
            error = enter(context, target, values, count, out)
        except BaseException as interruption:  # by a signal handler, as soon as Python runs again
            interrupted(interruption)
            raise
        if error or trap:
            raise_fault(error)

    if not params and not results:
        return run
    holders = [CTYPES[code].from_buffer(slots, SLOT * i) for i, code in enumerate(params)]
    result = CTYPES[results].from_buffer(slots) if results else None
    return _with_values(run, holders, result)


def _with_values(run: Callable[[], None], holders: list[Any], result: Any) -> Callable[..., Any]:
    """Return ``run`` with values put into its slots before, and one taken out after."""

    def call(*values: Any) -> Any:
        if len(values) != len(holders):
            raise TypeError(f"{len(holders)} arguments are needed, not {len(values)}")
        for holder, value in zip(holders, values):  # noqa: B905  # equally many, and strict costs
            holder.value = value
        run()
        return result.value if result is not None else None

    def call_with_one(value: Any) -> Any:
        holder.value = value
        run()
        return result.value if result is not None else None

    if len(holders) != 1:
        return call
    (holder,) = holders
    return call_with_one


def host_callback(
    store: Store, call: Callable[..., Any], params: str, results: str
) -> tuple[int, Any]:
    """Return the type of a function in Python, and the callback by which it is called.

    What it raises is kept aside while the compiled code that called it is unwound.
    """
    type_ = _function_type(store.engine, params, results)
    if not params and not results:
        return type_, PLAIN_CALLBACK(_without_values(store, call))
    if (params, results) == ("I", ""):
        return type_, HOST_CALLBACK(_one_address(store, call))
    return type_, HOST_CALLBACK(_any_values(store, call, params, results))


def _without_values(store: Store, call: Callable[[], Any]) -> Callable[[], int | None]:
    suspend = store.suspend

    def callback() -> int | None:
        store.depth += 1
        try:
            call()
        except BaseException as error:  # it must not get lost in ctypes
            return suspend(error)
        finally:
            store.depth -= 1
        return None

    return callback


def _one_address(store: Store, call: Callable[[int], Any]) -> Callable[[int, int, int], int | None]:
    """Return the callback of what takes one address, as every block does.

    The slots lie on the stack, from cycle to cycle mostly at the same place.
    """
    from_address = c_uint32.from_address
    suspend = store.suspend
    known, slot = 0, c_uint32()

    def callback(_env: int, _caller: int, slots: int) -> int | None:
        nonlocal known, slot
        store.depth += 1
        try:
            if slots != known:
                known, slot = slots, from_address(slots)
            call(slot.value)
        except BaseException as error:  # it must not get lost in ctypes
            return suspend(error)
        finally:
            store.depth -= 1
        return None

    return callback


def _any_values(
    store: Store, call: Callable[..., Any], params: str, results: str
) -> Callable[[int, int, int], int | None]:
    given = ctypes.c_char * (SLOT * max(len(params), 1))
    packed = "<" + "".join(f"{c}{SLOT - struct.calcsize(c)}x" for c in params)
    take = struct.Struct(packed).unpack_from
    result = CTYPES[results].from_address if results else None
    suspend = store.suspend

    def callback(_env: int, _caller: int, slots: int) -> int | None:
        store.depth += 1
        try:
            value = call(*take(given.from_address(slots)))
            if result is not None:
                result(slots).value = value
        except BaseException as error:  # it must not get lost in ctypes
            return suspend(error)
        finally:
            store.depth -= 1
        return None

    return callback


def _function_type(engine: int, params: str, results: str) -> int:
    """Return a wasm_functype_t; there are few different ones, and they are never freed."""
    codes = ["".join(WASM_CODES[c] for c in given) for given in (params, results)]
    key = engine, codes[0], codes[1]
    if key not in _function_types:
        vectors = [_value_types(kinds) for kinds in codes]
        _function_types[key] = library().wasm_functype_new(*map(byref, vectors))
    return _function_types[key]


def _value_types(codes: str) -> ByteVec:
    api, vector = library(), ByteVec()
    kinds = [api.wasm_valtype_new(VALUE_KINDS.index(code)) for code in codes]
    api.wasm_valtype_vec_new(byref(vector), len(kinds), (c_void_p * len(kinds))(*kinds))
    return vector
