"""Samples: every cycle, none lost, never half of a cycle of another class."""

import pytest

from plcsim import Program
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, TaskClassSetup
from plcsim.shared_image import (
    Cancel,
    CommandOutcome,
    ImageError,
    ImageReader,
    SampleCommand,
    samples,
)
from plcsim.shared_image.events import EventKind
from plcsim.shared_image.samples import sample_of
from plcsim.shared_image.stream import StreamReader
from st_types import UINT, var

from .conftest import MS, Fast, Make, Slow, World


def span(world: World, path: str) -> tuple[int, int]:
    tag = world.controller.tags.find(path)
    return tag.address, tag.data_type.size


def ask(
    world: World, number: int, *paths: str, task_class: int = 0, period_ns: int = 0
) -> CommandOutcome:
    spans = tuple(span(world, path) for path in paths)
    ticket = world.reader.send(SampleCommand(number, task_class, period_ns, spans))
    world.controller.run(cycles=1)
    return world.reader.outcome(ticket)


def taken(reader: StreamReader) -> list[samples.Sample]:
    records = reader.read()
    assert {record.kind for record in records} <= {EventKind.SAMPLE.value}
    return [sample_of(record.data) for record in records]


@pytest.fixture
def world(make: Make) -> World:
    return make(streams={"modbus": 64 * 1024})


def test_a_sample_is_taken_in_every_cycle_from_the_next_publish_on(world: World) -> None:
    reader = world.reader.samples()
    world.controller.run(cycles=2)
    assert ask(world, 7, "fast.copy", "fast.count") is CommandOutcome.APPLIED
    world.controller.run(cycles=3)
    found = taken(reader)
    assert [(s.number, s.task_class, s.cycle) for s in found] == [(7, 1, n) for n in (3, 4, 5, 6)]
    assert [s.data for s in found] == [n.to_bytes(4, "little") * 2 for n in (3, 4, 5, 6)]
    assert reader.lost == 0


def test_the_time_of_a_sample_is_the_release_of_its_cycle(world: World) -> None:
    reader = world.reader.samples()
    ask(world, 1, "fast.count")
    world.controller.run(cycles=2)
    origin_ns = world.controller.scan.origin_ns - world.controller.origin_ns
    times_ns = [record.time_ns - origin_ns for record in reader.read()]
    assert times_ns == [MS // 2, MS + MS // 2, 2 * MS + MS // 2]


def test_a_period_leaves_cycles_out(world: World) -> None:
    reader = world.reader.samples()
    ask(world, 1, "fast.count", period_ns=3 * MS)
    world.controller.run(cycles=7)
    assert [s.cycle for s in taken(reader)] == [1, 4, 7]


def test_a_request_may_be_of_one_class(make: Make) -> None:
    world = make(
        TaskClassSetup(1, MS, [ProgramSetup("fast", PythonCode(Fast))]),
        TaskClassSetup(3, 4 * MS, [ProgramSetup("slow", PythonCode(Slow))]),
        streams={"modbus": 64 * 1024},
    )
    reader = world.reader.samples()
    ask(world, 1, "slow.seen", task_class=3)
    ask(world, 2, "slow.seen", task_class=1)
    world.controller.run_for(6 * MS)
    found = taken(reader)
    assert {s.task_class for s in found if s.number == 1} == {3}
    assert {s.task_class for s in found if s.number == 2} == {1}
    assert [s.number for s in found].count(1) == 2


def test_a_second_request_of_a_number_replaces_the_first(world: World) -> None:
    reader = world.reader.samples()
    ask(world, 1, "fast.count")
    ask(world, 1, "fast.setpoint")
    world.controller.run(cycles=1)
    assert [len(s.data) for s in taken(reader)] == [4, 2, 2]


def test_a_cancelled_request_is_over(world: World) -> None:
    reader = world.reader.samples()
    for number in (1, 2, 3):
        ask(world, number, "fast.count")
    assert world.reader.samples_of(0) == 3
    world.reader.send(Cancel(2))
    world.controller.run(cycles=1)
    reader.read()
    world.controller.run(cycles=1)
    assert [s.number for s in taken(reader)] == [1, 3]
    world.reader.send(Cancel(0))
    world.controller.run(cycles=2)
    assert taken(reader) == []
    assert world.reader.samples_of(0) == 0


def test_what_lies_nowhere_is_refused(world: World) -> None:
    address = world.address("fast.count")
    for bad in ((0, 4), (address, 0), (address, 1 << 30)):
        ticket = world.reader.send(SampleCommand(1, 0, 0, [bad]))
        world.controller.run(cycles=1)
        assert world.reader.outcome(ticket) is CommandOutcome.NO_SUCH_ADDRESS
    assert world.reader.samples_of(0) == 0


def test_too_many_requests_are_refused(world: World) -> None:
    outcomes = [ask(world, number, "fast.count") for number in range(1, samples.MOST + 2)]
    assert outcomes == [*[CommandOutcome.APPLIED] * samples.MOST, CommandOutcome.TOO_MANY]
    assert ask(world, 1, "fast.count") is CommandOutcome.APPLIED  # replaces one


def test_a_service_without_a_stream_gets_no_samples(make: Make) -> None:
    world = make()
    assert ask(world, 1, "fast.count") is CommandOutcome.NO_COMMAND
    with pytest.raises(ImageError, match="no stream"):
        world.reader.samples()
    with pytest.raises(ImageError, match="no stream"):
        ImageReader(world.fd).samples()


def test_a_reader_that_is_too_slow_counts_what_it_lost(make: Make) -> None:
    world = make(streams={"modbus": 1024})
    reader = world.reader.samples()
    ask(world, 1, "fast.count")
    world.controller.run(cycles=99)
    found = taken(reader)
    assert len(found) + reader.lost == 100
    assert found[-1].cycle == 100
    assert [s.cycle for s in found] == list(range(101 - len(found), 101))


class Half(Program):
    value = var(UINT)
    untouched = var(UINT)

    def cyclic(self) -> None:
        self.value += 1
        self.context.memory.clock.spend_ns(3 * MS)  # type: ignore[attr-defined]  # set by the test


def test_a_preempted_class_is_as_in_the_sample_before(make: Make) -> None:
    setups = [ProgramSetup(name, PythonCode(Half)) for name in ("half", "second")]
    world = make(
        TaskClassSetup(1, MS, [ProgramSetup("fast", PythonCode(Fast))], 20 * MS),
        TaskClassSetup(4, 20 * MS, setups, 20 * MS, first_release_ns=10 * MS),
        streams={"modbus": 64 * 1024},
    )
    world.controller.memory.clock = world.clock  # type: ignore[attr-defined]
    reader = world.reader.samples()
    ask(world, 1, "fast.count", "half.value", "second.value", task_class=1)
    world.controller.run_for(40 * MS)
    found = taken(reader)
    pairs = [(s.data[4:6], s.data[6:8]) for s in found]
    assert all(one == two for one, two in pairs)  # never one program of the cycle alone
    assert pairs[-1] == (b"\2\0", b"\2\0")
    counts = [int.from_bytes(s.data[:4], "little") for s in found]
    assert counts == [s.cycle for s in found]


def test_a_first_sample_that_would_be_half_a_cycle_is_not_taken(make: Make) -> None:
    setups = [ProgramSetup(name, PythonCode(Half)) for name in ("half", "second")]
    world = make(
        TaskClassSetup(1, MS, [ProgramSetup("fast", PythonCode(Fast))], 20 * MS),
        TaskClassSetup(4, 20 * MS, setups, 20 * MS, first_release_ns=10 * MS),
        streams={"modbus": 64 * 1024},
    )
    world.controller.memory.clock = world.clock  # type: ignore[attr-defined]
    reader = world.reader.samples()
    asked = []

    def ask_when_preempted(_: object) -> None:
        if world.controller.image.held() and not asked:
            asked.append(True)
            world.reader.send(SampleCommand(1, 0, 0, [span(world, "half.value")]))

    world.controller.image.inputs.insert(0, ask_when_preempted)
    world.controller.run_for(20 * MS)
    assert asked
    assert {s.data for s in taken(reader)} == {b"\1\0"}
