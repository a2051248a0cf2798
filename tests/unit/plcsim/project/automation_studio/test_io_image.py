"""The simulated I/O image, on a controller with one program in each of two classes."""

import pytest

from plcsim import Program
from plcsim.core.clock import VirtualClock
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from plcsim.project.automation_studio.io_image import IoImage, Line, VariableCopy
from st_types import BOOL, UINT, var
from st_types.types.derived import Member, StructType

MS = 1_000_000


class Fast(Program):
    start = var(BOOL)
    stop = var(BOOL, True)
    count = var(UINT)
    other = var(UINT)
    seen = var(UINT)

    def cyclic(self) -> None:
        self.count += 1
        self.seen = self.seen + 1 if self.start else self.seen


class Slow(Program):
    copied = var(UINT)
    lamp = var(BOOL)


MODULE = StructType(
    "M",
    [*(Member(name, BOOL) for name in ("a", "b", "lamp")), Member("x", UINT), Member("y", UINT)],
)


@pytest.fixture
def plc():
    classes = [
        TaskClassSetup(1, 10 * MS, [ProgramSetup("fast", PythonCode(Fast))]),
        TaskClassSetup(2, 20 * MS, [ProgramSetup("slow", PythonCode(Slow))]),
    ]
    setup = Setup(classes, channels=StructType("IoMap", [Member("M", MODULE)]))
    return make_controller(setup, clock=VirtualClock())


@pytest.fixture
def at(plc):
    return plc.tags.find


def connect(plc, inputs=None, outputs=None, copies=()):
    IoImage(plc, inputs or {}, outputs or {}, copies)
    plc.boot()


def line(at, channel, variable, **more):
    return Line(
        at(f"IoMap.M.{channel}").address, at(variable).address, at(variable).data_type.size, **more
    )


def value(plc, path):
    return plc.tags.read(plc.tags.find(path))


def write(plc, path, value):
    plc.tags.write(plc.tags.find(path), value)


def test_a_channel_counts_from_its_first_value_on_and_at_each_latch(plc, at):
    connect(plc, {1: [line(at, "a", "fast.start")]})
    write(plc, "fast.start", True)
    plc.run_for(20 * MS)
    assert (value(plc, "fast.start"), value(plc, "fast.seen")) == (True, 2)
    write(plc, "IoMap.M.a", True)
    plc.run_for(10 * MS)
    write(plc, "IoMap.M.a", False)
    plc.run_for(10 * MS)
    assert (value(plc, "fast.start"), value(plc, "fast.seen")) == (False, 3)
    write(plc, "fast.start", True)
    plc.run_for(10 * MS)
    assert (value(plc, "fast.start"), value(plc, "fast.seen")) == (False, 3)


def test_an_inverse_channel(plc, at):
    lines = [
        line(at, "a", "fast.start", is_inverse=True),
        line(at, "b", "fast.stop", is_inverse=True),
    ]
    outputs = [line(at, "lamp", "fast.start", is_inverse=True)]
    connect(plc, {1: lines}, {1: outputs})
    write(plc, "IoMap.M.b", True)
    plc.run_for(10 * MS)
    assert (value(plc, "fast.stop"), value(plc, "IoMap.M.lamp")) == (False, True)
    write(plc, "IoMap.M.b", False)
    plc.run_for(10 * MS)
    assert value(plc, "fast.stop") is True


def test_outputs_are_published_by_their_class_neighbours_together(plc, at):
    outputs = [line(at, "x", "fast.count"), line(at, "y", "fast.other")]
    connect(plc, outputs={1: outputs, 2: [line(at, "lamp", "slow.lamp")]})
    write(plc, "fast.other", 7)
    write(plc, "slow.lamp", True)
    plc.run_for(6 * MS)
    assert (value(plc, "IoMap.M.x"), value(plc, "IoMap.M.y")) == (1, 7)
    assert value(plc, "IoMap.M.lamp") is False
    plc.run_for(10 * MS)
    assert value(plc, "IoMap.M.lamp") is True


def test_a_variable_goes_to_another_one_with_the_cycles_of_both(plc, at):
    copy = VariableCopy(at("fast.count").address, at("slow.copied").address, 2, 1, 2)
    connect(plc, copies=[copy])
    plc.run_for(12 * MS)
    assert (value(plc, "fast.count"), value(plc, "slow.copied")) == (1, 1)
    plc.run_for(10 * MS)
    assert (value(plc, "fast.count"), value(plc, "slow.copied")) == (2, 1)
    plc.run_for(10 * MS)
    assert (value(plc, "fast.count"), value(plc, "slow.copied")) == (3, 3)


def test_a_boot_disconnects_everything(plc, at):
    copy = VariableCopy(at("fast.count").address, at("slow.copied").address, 2, 1, 2)
    connect(plc, {1: [line(at, "a", "fast.start")]}, copies=[copy])
    write(plc, "IoMap.M.a", True)
    plc.run_for(20 * MS)
    plc.shutdown()
    plc.boot()
    write(plc, "fast.start", True)
    plc.run_for(5 * MS)
    assert (value(plc, "fast.start"), value(plc, "slow.copied")) == (True, 0)


def test_a_forced_tag_wins_over_its_channel(plc, at):
    connect(plc, {1: [line(at, "a", "fast.start")]})
    write(plc, "IoMap.M.a", True)
    plc.forces.force(at("fast.start"), b"\0", "test")
    plc.run_for(20 * MS)
    assert value(plc, "fast.seen") == 0


def test_channels_are_found_as_the_map_spells_them(plc):
    assert plc.tags.find('%IX."M".a').address == plc.tags.find("IoMap.M.a").address
    for path in ('%IX."M".none', "%IX.M.a", "%"):
        assert plc.tags.get(path) is None
