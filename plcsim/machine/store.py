"""The run-time state of one machine, and what becomes of a trap or an exception in it."""

from __future__ import annotations

import ctypes
import re
import sys
from ctypes import byref, c_uint8, c_uint64, c_void_p
from functools import partial
from typing import TYPE_CHECKING, Any, NoReturn

from plcsim.core.errors import CycleTimeViolation
from plcsim.machine.api import (
    ByteVec,
    GlobalHandle,
    ValueStructure,
    items_of,
    library,
    passed,
    quick,
    take_message,
    text_of,
)
from plcsim.machine.errors import FaultKind, Frame, MachineError, MachineFault, note_frames

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import TracebackType

    from plcsim.core.system_area import SystemArea
    from plcsim.machine.engine import Engine

_UNREACHABLE = 9
_NO_OFFSET = (1 << 64) - 1

_KINDS = {
    0: FaultKind.STACK_OVERFLOW,
    1: FaultKind.PAGE_FAULT,
    3: FaultKind.WRONG_FUNCTION,  # beyond the table
    4: FaultKind.NIL_FUNCTION,
    5: FaultKind.WRONG_FUNCTION,
    6: FaultKind.INTEGER_OVERFLOW,
    7: FaultKind.DIVISION_BY_ZERO,
    8: FaultKind.INVALID_CONVERSION,
    _UNREACHABLE: FaultKind.UNREACHABLE,
    11: FaultKind.FUEL,
}
"""By wasmtime_trap_code_enum."""

_ADDRESS = re.compile(r"wasm address 0x([0-9a-f]+)")


class Store:
    """A store of wasmtime, with what its calls share.

    Args:
        engine: what its code is compiled by.
        system: where the budget lies.

    Attributes:
        engine: wasm_engine_t.
        context: wasmtime_context_t.
        enter: calls a function.
        trap: where a call puts a trap.
        depth: functions in Python that compiled code has called and that have not returned.
        kept: what must live as long as the store.
    """

    def __init__(self, engine: Engine, system: SystemArea) -> None:
        api = library()
        self.engine = engine.handle
        self.handle: int | None = api.wasmtime_store_new(engine.handle, None, None)
        self.context: int = api.wasmtime_store_context(self.handle)
        self.enter = quick("wasmtime_func_call_unchecked")
        self.trap: Any = c_void_p()  # the stubs do not know that it is false where it is nil
        self.depth = 0
        self.kept: list[Any] = []
        self._delete = api.wasmtime_store_delete
        self._process_ends = sys.is_finalizing
        self._system = system
        self._suspended: BaseException | None = None
        self._stack_pointer: tuple[GlobalHandle, int] | None = None
        self._bottom: Callable[[], int] | None = None

    def __del__(self) -> None:
        # at the end of the process what gives the memory back may be gone already
        if not self._process_ends():
            self.close()

    def close(self) -> None:
        """Give everything back; no compiled code of this store may run any more."""
        if self.handle:
            self._delete(self.handle)
            self.handle = None

    def watch_stack(self, pointer: GlobalHandle, top: int, bottom: Callable[[], int]) -> None:
        """Name the global variable that is the stack pointer.

        Args:
            pointer: the variable.
            top: its value outside of calls.
            bottom: gives the lowest address of the stack.
        """
        self._stack_pointer = pointer, top
        self._bottom = bottom

    def suspend(self, error: BaseException) -> int:
        """Keep an exception while compiled code is unwound; return the trap that unwinds it."""
        self._suspended = error
        trap: int = library().wasmtime_trap_new_code(_UNREACHABLE)
        return trap

    def raise_fault(self, error: int | None) -> NoReturn:
        """Raise what has ended a call: an exception that was kept, or a fault.

        Args:
            error: wasmtime_error_t of the call; without it the trap tells.
        """
        if error:
            raise MachineError(f"a compiled function cannot be called: {take_message(error)}")
        fault = self._take_trap()
        suspended, self._suspended = self._suspended, None
        if suspended is not None:
            note_frames(suspended, fault.frames)
            raise suspended
        raise self._judged(fault)

    def interrupted(self, interruption: BaseException) -> None:
        """Note where compiled code was when a signal handler raised on the return from it."""
        if self.trap:
            fault = self._take_trap()
            self._suspended = None
            note_frames(interruption, fault.frames)

    def _judged(self, fault: MachineFault) -> BaseException:
        """Return a fault as what it means for the scan: the end of a program is a violation."""
        verdict = self._system.verdict
        if fault.kind is FaultKind.UNREACHABLE and verdict:
            fault.kind = FaultKind.BUDGET
        elif fault.kind is FaultKind.FUEL:
            verdict = "the program did not return within its instructions"
        else:
            return fault
        violation = CycleTimeViolation(verdict)
        note_frames(violation, fault.frames)
        violation.__cause__ = fault
        return violation

    def _take_trap(self) -> MachineFault:
        """Return the trap of a call as a fault, and make the store ready for the next call."""
        trap, self.trap.value = self.trap.value, None
        is_eaten = self._is_stack_eaten()
        if self._stack_pointer is not None and not self.depth:
            self._reset_stack(*self._stack_pointer)
        assert trap is not None
        fault = _fault(trap)
        library().wasm_trap_delete(trap)
        if is_eaten and fault.kind is FaultKind.PAGE_FAULT:
            eaten = MachineFault(FaultKind.STACK_OVERFLOW)
            note_frames(eaten, fault.frames)
            return eaten
        return fault

    def _is_stack_eaten(self) -> bool:
        """Return whether the frame of the function that runs begins below the stack."""
        if self._stack_pointer is None or self._bottom is None:
            return False
        value = ValueStructure()
        pointer, _ = self._stack_pointer
        library().wasmtime_global_get(self.context, byref(pointer), byref(value))
        address: int = value.of.i32 & 0xFFFFFFFF
        return address < self._bottom()

    def _reset_stack(self, pointer: GlobalHandle, top: int) -> None:
        value = ValueStructure()
        value.of.i32 = top
        library().wasmtime_global_set(self.context, byref(pointer), byref(value))

    def set_fuel(self, instructions: int) -> None:
        """Allow so many instructions from now on."""
        library().wasmtime_context_set_fuel(self.context, instructions)

    def fuel(self) -> int:
        """Return how many instructions are left."""
        left = c_uint64()
        library().wasmtime_context_get_fuel(self.context, byref(left))
        return left.value

    def ration(self, instructions: int) -> tuple[Callable[[], Any], Callable[[], int]]:
        """Return what allows so many instructions, and what tells how many are left of them.

        That is done in every cycle; both have nothing left to prepare.
        """
        left = c_uint64()
        arguments = passed(self.context), byref(left)
        allow = partial(quick("wasmtime_context_set_fuel"), arguments[0], c_uint64(instructions))
        look = partial(quick("wasmtime_context_get_fuel"), *arguments)

        def tell() -> int:
            look()
            return left.value

        return allow, tell


def trace_inside(error: BaseException) -> TracebackType | None:
    """Return the part of a traceback that was inside of compiled code: functions it has called."""
    trace = error.__traceback__
    while trace is not None and trace.tb_frame.f_code is not Store.raise_fault.__code__:
        trace = trace.tb_next
    return None if trace is None else trace.tb_next


def _fault(trap: int) -> MachineFault:
    api, code, message, trace = library(), c_uint8(255), ByteVec(), ByteVec()
    api.wasmtime_trap_code(trap, byref(code))
    api.wasm_trap_message(trap, byref(message))
    text = text_of(ctypes.addressof(message))
    api.wasm_byte_vec_delete(byref(message))
    api.wasm_trap_trace(trap, byref(trace))
    frames = tuple(map(_frame, items_of(trace)))
    api.wasm_frame_vec_delete(byref(trace))
    kind = _KINDS.get(code.value, FaultKind.OTHER)
    found = _ADDRESS.search(text) if kind is FaultKind.PAGE_FAULT else None
    detail = text if kind is FaultKind.OTHER else ""
    fault = MachineFault(kind, int(found[1], 16) if found else None, detail)
    note_frames(fault, frames)
    return fault


def _frame(frame: int) -> Frame:
    api = library()
    offset = api.wasm_frame_module_offset(frame)
    return Frame(
        text_of(api.wasmtime_frame_module_name(frame)),
        text_of(api.wasmtime_frame_func_name(frame)),
        api.wasm_frame_func_index(frame),
        0 if offset == _NO_OFFSET else offset,
    )
