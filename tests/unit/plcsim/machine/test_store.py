import gc
import os
import signal
import traceback
from pathlib import Path

import pytest

from plcsim.core.errors import CycleTimeViolation
from plcsim.core.memory import FIRST, PAGE, SYSTEM_AREA
from plcsim.core.system_area import STALLED, STOPPED
from plcsim.machine import FaultKind, Frame, MachineFault, frames_of, trace_inside

from .units import FAULTS, Rig

KINDS = [
    ("load", (0,), FaultKind.PAGE_FAULT, "page fault: address 16#00000000"),
    ("load", (4,), FaultKind.PAGE_FAULT, "page fault: address 16#00000004"),
    ("store", (FIRST + PAGE,), FaultKind.PAGE_FAULT, "page fault: address 16#00130000"),
    ("store", (FIRST + PAGE - 2,), FaultKind.PAGE_FAULT, "page fault: address 16#0013"),
    ("load", (0xFFFF_FFFF,), FaultKind.PAGE_FAULT, "page fault: address 16#FFFFFFFF"),
    ("divide", (1, 0), FaultKind.DIVISION_BY_ZERO, "division by zero"),
    ("divide", (-(2**31), -1), FaultKind.INTEGER_OVERFLOW, "integer overflow"),
    ("truncate", (1e10,), FaultKind.INTEGER_OVERFLOW, "integer overflow"),
    ("truncate", (float("nan"),), FaultKind.INVALID_CONVERSION, "conversion of a value that is no"),
    ("recurse", (), FaultKind.STACK_OVERFLOW, "stack overflow"),
    ("indirect", (0,), FaultKind.NIL_FUNCTION, "call through a function pointer that is nil"),
    ("indirect", (1,), FaultKind.WRONG_FUNCTION, "function pointer of another type"),
    ("indirect", (4,), FaultKind.WRONG_FUNCTION, "function pointer of another type"),
    ("unreachable", (), FaultKind.UNREACHABLE, "unreachable code"),
]


@pytest.mark.parametrize(("name", "values", "kind", "message"), KINDS)
def test_each_trap_is_a_fault_of_its_kind_and_the_instance_goes_on(
    rig, name, values, kind, message
):
    unit = rig.load(FAULTS)
    for _ in range(2):
        with pytest.raises(MachineFault, match=message) as caught:
            unit.function(name)(*values)
        assert caught.value.kind is kind
        assert unit.function("fine")() == 42


@pytest.mark.parametrize(("name", "values", "kind", "message"), KINDS)
def test_addresses_that_are_compared_fault_as_well(name, values, kind, message):
    unit = Rig(compare=True).load(FAULTS)
    with pytest.raises(MachineFault) as caught:
        unit.function(name)(*values)
    assert caught.value.kind is kind
    assert unit.function("fine")() == 42


@pytest.mark.parametrize(
    "address", [0, PAGE - 1, SYSTEM_AREA - 1, FIRST + PAGE, FIRST + 17 * PAGE, 2**31, 2**32 - 4]
)
def test_every_address_that_is_not_valid_traps_and_is_told(rig, address):
    with pytest.raises(MachineFault) as caught:
        rig.load(FAULTS).function("load")(address)
    assert caught.value.address == address


def test_the_offset_of_an_instruction_does_not_wrap(rig):
    unit = rig.load('(func (export "f") (result i32) (i32.load offset=0x7fffffff (i32.const -1)))')
    with pytest.raises(MachineFault, match="page fault"):
        unit.function("f")()


def test_a_fault_names_the_call_chain(rig):
    with pytest.raises(MachineFault) as caught:
        rig.load(FAULTS).function("loads")(8)
    inner, outer = caught.value.frames
    assert (inner.module, inner.function, inner.number) == ("unit", "load", 0)
    assert (outer.function, outer.number) == ("loads", 2)
    assert 0 < inner.offset < outer.offset
    assert isinstance(inner, Frame)


def test_where_the_stack_is_full_the_callers_are_told(rig):
    with pytest.raises(MachineFault) as caught:
        rig.load(FAULTS).function("recurse")()
    full, caller, *_ = caught.value.frames
    assert (full.function, caller.function) == ("recurse", "recurse")
    assert full.offset == 0 < caller.offset < 1000


def test_a_call_chain_over_two_modules_names_both(rig):
    library = rig.load(FAULTS)
    user = rig.load(
        '(import "lib" "load" (func $load (param i32) (result i32)))'
        '(func $main (export "main") (drop (call $load (i32.const 4))))',
        {("lib", "load"): library.extern("load")},
    )
    with pytest.raises(MachineFault) as caught:
        user.function("main")()
    assert [f.function for f in caught.value.frames] == ["load", "main"]


# Exceptions of Python functions that compiled code has called

CALLER = """
(import "host" "call" (func $call))
(func $inner (call $call))
(func $outer (export "outer") (call $inner))
"""


class Unusual(BaseException):
    __slots__ = ()


@pytest.mark.parametrize(
    "error", [ValueError("text"), KeyboardInterrupt(), Unusual(), CycleTimeViolation("x")]
)
def test_an_exception_comes_out_unchanged(rig, error):
    def call():
        raise error

    unit = rig.load(CALLER, {("host", "call"): rig.machine.host_function(call)})
    with pytest.raises(type(error)) as caught:
        unit.function("outer")()
    assert caught.value is error
    assert caught.value.__cause__ is None
    assert caught.value.__context__ is None
    assert "call" in [entry.name for entry in caught.traceback]
    assert [f.function for f in frames_of(error)] == ["inner", "outer"]


def test_an_exception_caught_in_between_goes_no_further(rig):
    def call():
        with pytest.raises(MachineFault):
            faulty.function("load")(0)

    faulty = rig.load(FAULTS)
    unit = rig.load(CALLER, {("host", "call"): rig.machine.host_function(call)})
    unit.function("outer")()


def test_a_fault_passes_python_and_collects_the_outer_frames(rig):
    def call():
        faulty.function("load")(0)

    faulty = rig.load(FAULTS)
    unit = rig.load(CALLER, {("host", "call"): rig.machine.host_function(call)})
    with pytest.raises(MachineFault, match="page fault") as caught:
        unit.function("outer")()
    assert [f.function for f in caught.value.frames] == ["load", "inner", "outer"]


def test_endless_recursion_through_python_ends(rig):
    unit = None

    def call():
        unit.function("outer")()

    unit = rig.load(CALLER, {("host", "call"): rig.machine.host_function(call)})
    with pytest.raises((RecursionError, MachineFault)):
        unit.function("outer")()
    with pytest.raises((RecursionError, MachineFault)):
        unit.function("outer")()


# The stack of compiled code

STACK = """
(import "env" "__stack_pointer" (global $sp (mut i32)))
(import "host" "call" (func $call))
(func (export "sp") (result i32) (global.get $sp))
(func (export "faults") (global.set $sp (i32.sub (global.get $sp) (i32.const 64))) unreachable)
(func (export "calls")
  (global.set $sp (i32.sub (global.get $sp) (i32.const 64)))
  (call $call)
  (global.set $sp (i32.add (global.get $sp) (i32.const 64))))
"""


def test_after_a_fault_the_stack_pointer_is_at_the_top_again(rig):
    unit = rig.load(STACK, {("host", "call"): rig.machine.host_function(lambda: None)})
    with pytest.raises(MachineFault):
        unit.function("faults")()
    assert unit.function("sp")() == SYSTEM_AREA


def test_a_fault_inside_leaves_the_stack_of_the_outer_call_alone(rig):
    seen = []

    def call():
        with pytest.raises(MachineFault):
            unit.function("faults")()
        seen.append(unit.function("sp")())

    unit = rig.load(STACK, {("host", "call"): rig.machine.host_function(call)})
    unit.function("calls")()
    assert seen == [SYSTEM_AREA - 128]
    with pytest.raises(MachineFault):
        unit.function("faults")()
    assert unit.function("sp")() == SYSTEM_AREA


# The end of a program that does not return


@pytest.mark.parametrize(
    ("why", "message"), [(STALLED, "the program did not return"), (STOPPED, "stopped by SIGINT")]
)
def test_a_budget_below_zero_ends_a_loop(rig, why, message):
    endless = rig.load(FAULTS).function("endless")
    rig.memory.system.end_program(why)
    with pytest.raises(CycleTimeViolation, match=message) as caught:
        endless()
    assert isinstance(caught.value.__cause__, MachineFault)
    assert caught.value.__cause__.kind is FaultKind.BUDGET
    assert frames_of(caught.value)[0].module == "unit"


def test_other_faults_stay_faults_while_a_program_shall_end(rig):
    rig.memory.system.end_program(STALLED)
    with pytest.raises(MachineFault, match="division by zero"):
        rig.load(FAULTS).function("divide")(1, 0)


def test_fuel_ends_a_loop():
    rig = Rig(fuel=True)
    unit = rig.load(FAULTS)
    rig.machine.fuel = 10_000
    with pytest.raises(CycleTimeViolation, match="within its instructions") as caught:
        unit.function("endless")()
    assert caught.value.__cause__.kind is FaultKind.FUEL
    assert frames_of(caught.value)[0].module == "unit"
    rig.machine.fuel = 10_000
    assert unit.function("fine")() == 42


def fork_watchdog(rig, *acts):
    """Start a process that acts as soon as the loop runs; PLC memory is shared with it."""
    child = os.fork()
    if child:
        return child
    try:
        while not rig.memory.read(FIRST, 1)[0]:
            os.sched_yield()
        for act in acts:
            act()
    finally:
        os._exit(0)


def test_another_process_ends_a_loop_that_holds_the_interpreter(rig):
    endless = rig.load(FAULTS).function("endless")
    child = fork_watchdog(rig, lambda: rig.memory.system.end_program(STALLED))
    with pytest.raises(CycleTimeViolation):
        endless()
    assert os.waitpid(child, 0)[1] == 0


def test_a_signal_handler_that_raises_on_the_return_keeps_the_frames(rig):
    """The handler runs as soon as Python does, before the trap has been looked at."""

    class Ended(BaseException):
        pass

    def handler(_number, _frame):
        raise Ended

    endless = rig.load(FAULTS).function("endless")
    before = signal.signal(signal.SIGUSR1, handler)
    parent = os.getpid()
    child = fork_watchdog(
        rig,
        lambda: os.kill(parent, signal.SIGUSR1),
        lambda: rig.memory.system.end_program(STALLED),
    )
    try:
        with pytest.raises(Ended) as caught:
            endless()
    finally:
        signal.signal(signal.SIGUSR1, before)
        os.waitpid(child, 0)
    assert [f.module for f in frames_of(caught.value)] == ["unit"]
    rig.memory.system.rearm()
    assert rig.load(FAULTS).function("fine")() == 42


# Nothing leaks


def resident():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4


def test_a_thousand_faults_of_every_kind_leak_nothing(rig):
    unit = rig.load(FAULTS)
    functions = [(unit.function(name), values) for name, values, *_ in KINDS]

    def fail():
        raise KeyError("boom")

    outer = rig.load(CALLER, {("host", "call"): rig.machine.host_function(fail)}).function("outer")

    def once():
        for function, values in functions:
            with pytest.raises(MachineFault):
                function(*values)
        with pytest.raises(KeyError):
            outer()

    for _ in range(100):
        once()
    gc.collect()
    before = resident()
    for _ in range(1000):
        once()
    gc.collect()
    assert resident() - before < 2048
    assert unit.function("fine")() == 42


def test_a_traceback_has_a_part_inside_of_compiled_code(rig):
    def fail():
        raise KeyError("boom")

    outer = rig.load(CALLER, {("host", "call"): rig.machine.host_function(fail)}).function("outer")
    with pytest.raises(KeyError) as caught:
        outer()
    inside = trace_inside(caught.value)
    assert "fail" in [frame.name for frame in traceback.extract_tb(inside)]
    assert "test_a_traceback" not in str(traceback.extract_tb(inside))
    assert trace_inside(KeyError()) is None
