"""The same program with the same inputs gives the same trace of tags on both clocks."""

import time

import pytest

from plcsim.core.clock import MonotonicClock, VirtualClock
from plcsim.core.memory import PAGE
from plcsim.core.task import Policy
from plcsim.library.standard import CTU, R_TRIG, TON, TP
from plcsim.program.python.language import PythonCode
from plcsim.program.python.program import Program
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from st_types import ARRAY, BOOL, DINT, LREAL, REAL, STRING, TIME, USINT, var

MS = 1_000_000
CYCLES = 50
REAL_CYCLES = 27
"""On the real clock the host has to leave them all alone: twice the time that inputs repeat in."""

PATIENCE_S = 250.0
"""So long a moment is waited for in which the host does."""

LATE_NS = 4 * MS
"""A cycle as late as this may come after one of the other class that it should precede."""


class Conveyor(Program):
    """Timers, counters, edges, wrap-around, floating point and text."""

    start = var(BOOL)
    speed = var(REAL)
    delay = var(TIME, 35)
    running = var(BOOL)
    turns = var(USINT, 250)
    way = var(LREAL)
    text = var(STRING(12))
    history = var(ARRAY(DINT, (0, 7)))
    on_delay = var(TON)
    pulse = var(TP)
    edge = var(R_TRIG)
    starts = var(CTU)

    def cyclic(self) -> None:
        self.on_delay(IN=self.start, PT=self.delay)
        self.edge(CLK=self.on_delay.Q)
        self.pulse(IN=self.edge.Q, PT=25)
        self.starts(CU=self.edge.Q, PV=3)
        self.running = self.on_delay.Q or self.pulse.Q
        if self.running:
            self.turns += 1
            self.way += self.speed * 0.01
        self.text = f"{self.way:.6f}"
        self.history[self.turns % 8] = self.on_delay.ET - 20


class Lamp(Program):
    """Blinks by itself, in a class of its own."""

    on = var(BOOL)
    timer = var(TON)

    def cyclic(self) -> None:
        self.timer(IN=not self.timer.Q, PT=50)
        if self.timer.Q:
            self.on = not self.on


SETUP = Setup(
    [
        TaskClassSetup(number, 10 * number * MS, [ProgramSetup(name, code)], policy=Policy.LOG)
        for number, name, code in (
            (1, "conveyor", PythonCode(Conveyor)),
            (2, "lamp", PythonCode(Lamp)),
        )
    ],
    memory_size=16 * PAGE,
)


def trace_of(clock, cycles=CYCLES):
    """Run on ``clock``; return the controller and, for each cycle, all tags and all bytes.

    On the real clock it ends where the host has disturbed it.
    """
    controller = make_controller(SETUP, network=None, clock=clock)
    tags = list(controller.tags)
    conveyor = controller.tasks[0].cyclic.__self__
    trace = []

    def set_inputs(task_class):
        if task_class.number == 1:
            conveyor.start = task_class.cycles % 13 > 4
            conveyor.speed = task_class.cycles * 0.1

    def watch(task_class):
        values = {tag.path: controller.tags.read(tag) for tag in tags}
        data = [controller.memory.read(a.address, a.data_type.size) for a in controller.areas]
        trace.append((task_class.number, task_class.cycles, values, data))
        if not clock.is_virtual and disturbance(controller):
            controller.stop()

    controller.image.inputs.append(set_inputs)
    controller.image.watchers.append(watch)
    controller.boot()
    controller.run(cycles=cycles)
    return controller, trace


def disturbance(controller):
    """What the host did to a run, "" where nothing that could be seen in the trace."""
    missed = sum(c.missed for c in controller.classes)
    late_ns = max(c.lateness.maximum_ns for c in controller.classes)
    if missed:
        return f"{missed} grid points were missed"
    return f"a cycle was {late_ns} ns late" if late_ns >= LATE_NS else ""


def test_the_trace_is_the_same_on_both_clocks():
    deadline = time.monotonic() + PATIENCE_S
    real, on_real = trace_of(MonotonicClock(), REAL_CYCLES)
    while disturbed := disturbance(real):
        if time.monotonic() > deadline:
            pytest.fail(f"the host disturbed all runs on the real clock: {disturbed}")
        real, on_real = trace_of(MonotonicClock(), REAL_CYCLES)
    virtual, on_virtual = trace_of(VirtualClock(start_ns=real.scan.origin_ns), REAL_CYCLES)
    assert virtual.scan.origin_ns == real.scan.origin_ns
    assert len(on_virtual) > REAL_CYCLES
    for seen, expected in zip(on_real, on_virtual, strict=True):
        assert seen == expected


def test_the_trace_is_the_same_in_every_run_on_the_virtual_clock():
    first, second = trace_of(VirtualClock())[1], trace_of(VirtualClock())[1]
    assert first == second
    values = [values for _, _, values, _ in first]
    assert len({v["conveyor.turns"] for v in values}) > 10
    assert {v["conveyor.running"] for v in values} == {True, False}
    assert {v["lamp.on"] for v in values} == {True, False}
    assert values[-1]["conveyor.starts.CV"] == 4
