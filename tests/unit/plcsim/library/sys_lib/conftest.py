"""A controller with two tasks whose variables have names."""

import pytest

from plcsim import Program
from plcsim.core.clock import VirtualClock
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from st_types import ARRAY, BOOL, REAL, STRING, UINT, Struct, var


class Step(Struct):
    time = var(UINT)
    level = var(REAL)


class Mixer(Program):
    steps = var(ARRAY(Step, (0, 4)))
    weights = var(ARRAY(UINT, (1, 3)))
    name = var(STRING(20))
    on = var(BOOL)
    calls = var(UINT)
    first = var(Step)

    def cyclic(self):
        self.calls += 1
        for act in acts.pop(self.calls, ()):
            act()


acts = {}
"""What Mixer does in a cycle, by its number."""


class Tasks:
    """The controller, and shortcuts."""

    def __init__(self, functions):
        self.clock = VirtualClock(0)
        classes = [
            TaskClassSetup(1, 10_000_000, [ProgramSetup("mix", PythonCode(Mixer))]),
            TaskClassSetup(4, 20_000_000, [ProgramSetup("fill", PythonCode(Mixer))]),
        ]
        self.controller = make_controller(Setup(classes), clock=self.clock)
        self.context = self.controller.context
        self.memory = self.controller.memory
        self.functions = functions
        self.out = self.bytes(bytes(64))
        self.controller.boot()

    def bytes(self, data):
        address = self.memory.allocate(len(data), 8)
        self.memory.write(address, data)
        return address

    def text(self, text):
        return self.bytes(text.encode("latin-1") + b"\0")

    def function(self, name):
        return self.functions.find_function(name)[1].bind(self.context)

    def number(self, offset=0, size=4):
        return int.from_bytes(self.memory.read(self.out + offset, size), "little")

    def string(self, offset=0):
        return self.memory.string(self.out + offset, 64).decode("latin-1")

    def run_as(self, task):
        self.controller.scan.active = self.controller.tasks[task]


@pytest.fixture
def tasks():
    from plcsim.program.loader import installed_catalogue

    acts.clear()
    yield Tasks(installed_catalogue())
    acts.clear()


@pytest.fixture
def in_cycle():
    """``in_cycle(number, act)``: have the first task do something in a cycle."""

    def plan(number, act):
        acts.setdefault(number, []).append(act)

    return plan
