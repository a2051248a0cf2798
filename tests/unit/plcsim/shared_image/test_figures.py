"""Figures of the scan in a service's stream, while it follows them and not before."""

import pytest

from plcsim.core.clock import VirtualClock
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, TaskClassSetup
from plcsim.shared_image import Cancel, CommandOutcome, Follow
from plcsim.shared_image.events import EventKind
from plcsim.shared_image.figures import Measured, buckets_of, cycle_of

from .conftest import MS, Fast, Make, Slow, World


@pytest.fixture
def world(make: Make) -> World:
    return make(
        TaskClassSetup(1, MS, [ProgramSetup("fast", PythonCode(Fast))]),
        TaskClassSetup(3, 4 * MS, [ProgramSetup("slow", PythonCode(Slow))]),
        streams={"modbus": 256 * 1024},
    )


def send(world: World, command: Follow | Cancel) -> None:
    ticket = world.reader.send(command)
    world.controller.run(cycles=1)
    assert world.reader.outcome(ticket) is CommandOutcome.APPLIED


def test_cycles_are_told_with_their_runs_until_nobody_follows(world: World) -> None:
    reader, scan = world.reader.samples(), world.controller.scan
    world.controller.run(cycles=2)
    assert reader.read() == []
    assert scan.run_follower is None
    send(world, Follow(cycles=True))
    world.controller.run(cycles=4)
    cycles = [cycle_of(r.data) for r in reader.read() if r.kind == EventKind.CYCLE.value]
    assert [(c.task_class, c.number) for c in cycles] == [
        (3, 1), (1, 3), (1, 4), (1, 5), (1, 6), (3, 2), (1, 7),
    ]  # fmt: skip
    tasks = {task.index: task.name for task in world.controller.tasks}
    assert [[tasks[run.task] for run in c.runs] for c in cycles[:2]] == [["slow"], ["fast"]]
    origin_ns = world.controller.scan.origin_ns - world.controller.origin_ns
    assert [c.release_ns - origin_ns for c in cycles[:2]] == [2 * MS, 2 * MS + MS // 2]
    assert cycles[0].release_ns <= cycles[0].start_ns <= cycles[0].end_ns
    send(world, Cancel(0))
    reader.read()
    world.controller.run(cycles=3)
    assert reader.read() == []
    assert scan.run_follower is None


def test_histograms_come_by_turns_while_the_scan_is_idle(world: World) -> None:
    reader, scan = world.reader.samples(), world.controller.scan
    send(world, Follow(histograms=True))
    assert len(scan.idlers) == 2
    world.controller.run(cycles=600)
    found = [buckets_of(r.data) for r in reader.read() if r.kind == EventKind.HISTOGRAM.value]
    kinds = {(each.measured, each.number) for each in found}
    assert kinds == {(m, n) for m in Measured if m is not Measured.PROGRAM for n in (1, 3)} | {
        (Measured.PROGRAM, task.index) for task in world.controller.tasks
    }
    lateness = [e for e in found if (e.measured, e.number) == (Measured.LATENESS, 1)]
    counts = [sum(each.counts) for each in lateness]
    assert counts == sorted(counts)
    assert counts[-1] >= 300
    assert isinstance(world.controller.clock, VirtualClock)
    assert (lateness[-1].minimum_ns, lateness[-1].maximum_ns) == (0, 0)
    send(world, Follow())
    assert len(scan.idlers) == 1
