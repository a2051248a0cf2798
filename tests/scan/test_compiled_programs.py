"""Compiled programs in the task classes of a controller, beside programs in Python."""

import pytest

from plcsim.core.clock import VirtualClock
from plcsim.core.memory import PAGE
from plcsim.core.system import State
from plcsim.core.tag import Tag
from plcsim.core.task import Task, Unit
from plcsim.machine import CodeCache, Machine
from plcsim.program.compiled import fault_of
from plcsim.program.language import PlacedProgram
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.generate import generate
from plcsim.program.structured_text.codegen.link import Linker
from plcsim.program.structured_text.fault import locator
from st_types import UDINT, Struct, var
from st_types.types.views import address_of, type_of

MS = 1_000_000
PROGRAM = ir.Segment("program")


class Variables(Struct):
    """The variables of the compiled program."""

    count = var(UDINT)
    limit = var(UDINT, 1)


COUNT, LIMIT = (ir.Load("i32", "w32", ir.Place(PROGRAM, 4 * n, n + 1)) for n in range(2))


def unit(name, *body):
    return ir.Function(name, "unit", (), None, (), body, exported=True)


class Counter:
    """A program as a compiler would hand it over: INIT sets 100, CYCLIC counts."""

    def __init__(self, *more):
        init = ir.Store(1, "w32", COUNT.place, ir.Const("i32", 100))
        step = ir.Store(3, "w32", COUNT.place, ir.Binary("i32", "add", COUNT, ir.Const("i32", 1)))
        units = unit("INIT", init), unit("CYCLIC", step, *more), unit("EXIT")
        self.code = generate(ir.Module("counter", units, {}, (PROGRAM,), ("Counter.st",)))

    def place(self, name, site):
        view = site.memory.new(Variables)
        linker = Linker(Machine(site.memory, cache=CodeCache(None)))
        tag = Tag(name, type_of(Variables), address_of(view))
        compiled = linker.compiled(self.code, {"program": tag.address})
        instance = linker.link(self.code, compiled, lambda _: None)
        lines = {"counter": locator(self.code.lines)}.get
        units = {one: instance.function(one.value) for one in Unit}
        task = Task(
            name,
            tag,
            units,
            fault_of=lambda error: fault_of(error, lines),
            interrupt=lambda reason: None,  # the machine ends it by its budget
        )
        return PlacedProgram(lambda: False, lambda: task)


@pytest.fixture
def controller_of():
    """``controller_of(code)``: a controller that runs the program every 10 ms, booted."""

    def controller_of(code):
        task_class = TaskClassSetup(1, 10 * MS, [ProgramSetup("counter", code)])
        setup = Setup([task_class], memory_size=16 * PAGE)
        controller = make_controller(setup, clock=VirtualClock())
        controller.boot()
        return controller

    return controller_of


def test_units_run_in_their_phases_and_variables_are_tags(controller_of):
    controller = controller_of(Counter())
    assert controller.tags.read(controller.tags.find("counter.count")) == 100
    controller.run_for(100 * MS)
    assert controller.tags.read(controller.tags.find("counter.count")) == 110


def test_a_fault_leads_to_service_with_line_and_calls(controller_of):
    divide = ir.Store(
        7,
        "w32",
        COUNT.place,
        ir.Binary("i32", "div_u", COUNT, ir.Binary("i32", "sub", LIMIT, COUNT)),
    )
    guard = ir.Arm(6, ir.Compare("i32", "eq", COUNT, ir.Const("i32", 103)), [divide])
    controller = controller_of(Counter(ir.If(6, [guard])))
    controller.tags.write(controller.tags.find("counter.limit"), 103)
    controller.run_for(100 * MS)
    assert controller.state is State.SERVICE
    fault = controller.fault
    assert (fault.program, fault.unit, fault.location) == ("counter", "CYCLIC", "Counter.st:7")
    assert fault.reason == "division by zero"
    assert fault.calls == ("Counter.st:7 in CYCLIC",)
    assert controller.tags.read(controller.tags.find("counter.count")) == 103
