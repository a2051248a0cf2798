"""Faults of compiled programs: reason, line and calls."""

import pytest

from plcsim.core.errors import CycleTimeViolation
from plcsim.core.memory import FIRST, PAGE, Memory
from plcsim.core.system_area import STALLED
from plcsim.machine import CodeCache, Machine
from plcsim.program.compiled import fault_of
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.generate import generate
from plcsim.program.structured_text.codegen.link import Linker
from plcsim.program.structured_text.fault import locator

from .codegen.build import (
    address,
    call,
    evaluate,
    function,
    load,
    module,
    number,
    op,
    store,
    unit,
)

DEEP = ir.Function(
    "DEEP",
    "function",
    (),
    None,
    ("i32",),
    [
        ir.Store(8, "w32", ir.Place(ir.Local("i32", 0), 4), number(1)),
        ir.Evaluate(9, call("DEEP")),
    ],
    frame=ir.StackFrame(0x1000, 0),
)
"""A function that calls itself for ever, with 4 KiB on the stack for each call."""


@pytest.fixture
def memory():
    memory = Memory(2 * PAGE)
    memory.allocate(4096)
    return memory


@pytest.fixture
def fault(memory):
    """``fault(body, ...)``: what the fault of an action called in line 3 means."""

    def run(*body, imports=None, provide=None, prepare=lambda: None, others=()):
        machine = Machine(memory, cache=CodeCache(None))
        linker = Linker(machine)
        action = function("ACTION", (), None, *body, kind="action", exported=False)
        units = unit(evaluate(call("ACTION"), line=3)), action, *others
        whole = module(*units, imports=imports)
        code = generate(whole)
        instance = linker.link(
            code,
            linker.compiled(code, {"program": FIRST}),
            lambda wanted: machine.host_function(provide, "I"),
        )
        cyclic = instance.function("CYCLIC")
        prepare()
        try:
            cyclic()
        except BaseException as error:
            return fault_of(error, {code.name: locator(code.lines)}.get)
        finally:
            machine.close()
        raise AssertionError("nothing was raised")

    return run


def chain(line):
    return ("Main.st:3 in CYCLIC", f"Main.st:{line} in ACTION")


def test_division_by_zero(fault):
    body = store(0, ir.Binary("i32", "div_s", number(1), load(4)), line=12)
    assert fault(body) == ("Main.st:12", "division by zero", chain(12))


def test_a_page_fault_tells_the_address(fault):
    wild = ir.Load("i32", "w32", ir.Place(load(4), 16, 0))
    found = fault(store(0, 1, line=11), store(0, wild, line=14))
    assert found == ("Main.st:14", "page fault: address 16#00000010", chain(14))


def test_an_index_outside_its_array(fault):
    body = store(0, ir.Checked(op("add", load(4), 10), 10), line=20)
    assert fault(body) == ("Main.st:20", "index outside the bounds of its array", chain(20))


def test_a_stack_that_is_full(fault):
    found = fault(evaluate(call("DEEP"), line=5), others=[DEEP])
    assert (found.location, found.reason) == ("Main.st:1", "stack overflow")
    assert found.calls[-2:] == ("Main.st:9 in DEEP", "Main.st:1 in DEEP")


def test_what_happens_in_a_helper_is_told_at_its_call(fault):
    nil = call("rt.string_assign", load(4), address(8), number(80))
    location, reason, calls = fault(evaluate(nil, line=9))
    assert (location, calls) == ("Main.st:9", chain(9))
    assert reason.startswith("page fault")


def test_the_end_of_the_budget(fault, memory):
    loop = ir.Loop(7, 1, [store(0, 1, line=8)])
    found = fault(loop, prepare=lambda: memory.system.end_program(STALLED))
    assert found.location == "Main.st:7"
    assert found.reason == "the program did not return"


@pytest.mark.parametrize("error", [ValueError("no such thing"), CycleTimeViolation("too long")])
def test_what_a_block_in_python_raises(fault, error):
    imports = {"FB": ir.Import("block", "FB", ir.Signature(("i32",), None))}

    def block(_address):
        raise error

    found = fault(evaluate(call("FB", address(8)), line=31), imports=imports, provide=block)
    here = f"{__file__}:{block.__code__.co_firstlineno + 1}"
    assert found.location == here
    assert str(error) in found.reason
    assert found.calls[:2] == chain(31)
    assert found.calls[-1] == f"{here} in block"


def test_what_no_compiled_code_has_raised_has_no_line():
    assert fault_of(ValueError("x"), lambda _: None) == ("", "ValueError: x", ())
