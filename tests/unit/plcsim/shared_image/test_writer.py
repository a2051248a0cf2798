import os

import pytest

from plcsim import Program
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, TaskClassSetup
from plcsim.shared_image import CommandRefused, Mask, Store, layout
from plcsim.shared_image.command import encode_command
from plcsim.shared_image.writer import COMMANDS_PER_LATCH, STEPS_PER_COMMAND, _joined
from st_types import ARRAY, BYTE, UINT, var

from .conftest import MS, Fast, Make, Slow, World


def test_a_snapshot_shows_the_cycle_that_has_ended(world: World) -> None:
    for cycle in range(1, 6):
        world.controller.run(cycles=1)
        assert world.read("fast.count") == world.read("fast.copy") == cycle
    assert world.read("fast.name") == "fast"


def test_a_command_is_applied_in_the_next_latch_and_acknowledged_after_its_publish(
    world: World,
) -> None:
    world.controller.run(cycles=1)
    ticket = world.reader.send((Store(world.address("fast.setpoint"), b"\x2a\0"),))
    assert not world.reader.is_acknowledged(ticket)
    assert world.read("fast.setpoint") == 0
    world.controller.run(cycles=1)
    assert world.reader.is_acknowledged(ticket)
    assert world.read("fast.setpoint") == 42


def test_an_acknowledged_command_is_in_the_latest_snapshot(world: World) -> None:
    tickets = [
        (n, world.reader.send((Store(world.address("fast.setpoint"), n.to_bytes(2, "little")),)))
        for n in range(1, 200)
    ]
    while not world.reader.is_acknowledged(tickets[-1][1]):
        world.controller.run(cycles=1)
        done = [n for n, ticket in tickets if world.reader.is_acknowledged(ticket)]
        assert world.read("fast.setpoint") == done[-1]
        assert len(done) % world.writer.commands_per_latch == 0 or len(done) == len(tickets)


def test_a_mask_works_on_what_the_program_left(world: World) -> None:
    address = world.address("fast.word")
    world.reader.send((Store(address, b"\x12\0"),))
    world.reader.send((Mask(address, 0xF2, 0x25),))
    world.controller.run(cycles=1)
    assert world.read("fast.word") == 0x17


@pytest.mark.parametrize(
    ("cycle_ns", "commands"), [(200_000, 8), (MS, 16), (2 * MS, 32), (4 * MS, 64), (100 * MS, 64)]
)
def test_a_latch_applies_as_many_commands_as_fit_its_cycle(
    make: Make, cycle_ns: int, commands: int
) -> None:
    world = make(TaskClassSetup(1, cycle_ns, [ProgramSetup("fast", PythonCode(Fast))]))
    least, most = COMMANDS_PER_LATCH
    assert least <= world.writer.commands_per_latch <= most
    address = world.address("fast.setpoint")
    tickets = [world.reader.send((Store(address, b"\1\0"),)) for _ in range(100)]
    world.controller.run(cycles=1)
    assert sum(map(world.reader.is_acknowledged, tickets)) == commands


def test_one_latch_applies_few_operations_but_a_command_whole(world: World) -> None:
    flags = world.address("fast.flags")
    many = STEPS_PER_COMMAND * world.writer.commands_per_latch
    first = world.reader.send(tuple(Store(flags + i % 8 * 2, b"\1") for i in range(many)))
    second = world.reader.send((Store(flags + 1, b"\1"),))
    world.controller.run(cycles=1)
    assert world.reader.is_acknowledged(first)
    assert not world.reader.is_acknowledged(second)
    assert [world.read(f"fast.flags[{i}]") for i in range(5)] == [True, False, True, False, True]
    world.controller.run(cycles=1)
    assert world.reader.is_acknowledged(second)


def test_scattered_bytes_outside_the_memory_are_not_applied_at_all(world: World) -> None:
    flags = world.address("fast.flags")
    for bad in (0, 0xFFF, world.controller.memory.used, 0xFFFF_FFFF):
        world.reader.send((Store(flags, b"\1"), Store(bad, b"\1")))
        world.controller.run(cycles=1)
        assert world.read("fast.flags[0]") is False
    assert world.reader._producer is not None
    assert world.reader._producer.refused == 4


def test_a_command_with_one_bad_address_is_not_applied_at_all(world: World) -> None:
    good = world.address("fast.setpoint")
    ticket = world.reader.send((Store(good, b"\1\0"), Store(0x10, b"\1")))
    world.controller.run(cycles=1)
    assert world.reader.is_acknowledged(ticket)
    assert world.read("fast.setpoint") == 0
    assert world.reader._producer is not None
    assert world.reader._producer.refused == 1


def test_garbage_in_the_ring_does_not_stop_the_scan(world: World) -> None:
    producer = world.reader._producer
    assert producer is not None
    record = bytearray(encode_command((Store(world.address("fast.word"), b"\1\0"),)))
    record[8:16] = b"\xff" * 8
    producer.put(bytes(record))
    world.reader.send((Store(world.address("fast.setpoint"), b"\7\0"),))
    world.controller.run(cycles=2)
    assert producer.refused == 1
    assert world.read("fast.setpoint") == 7


def test_a_waker_is_raised_once_for_each_publish_that_acknowledges(make: Make) -> None:
    world = make()
    fd = os.eventfd(0, os.EFD_NONBLOCK | os.EFD_CLOEXEC)
    ring = world.writer._rings[0]
    world.writer._rings[0] = ring._replace(wake_fd=fd)
    with pytest.raises(BlockingIOError):
        os.eventfd_read(fd)
    world.reader.send((Store(world.address("fast.word"), b"\1\0"),))
    world.controller.run(cycles=3)
    assert os.eventfd_read(fd) == 1
    os.close(fd)


class Second(Program):
    """The second program of a slow class: between the two, the fast class runs."""

    seen = var(UINT)
    before = var(UINT)

    def cyclic(self) -> None:
        self.before = self.seen


class Busy(Program):
    """Uses three milliseconds, then changes its variable a second time."""

    half = var(UINT)
    whole = var(UINT)

    def cyclic(self) -> None:
        self.half += 1
        self.context.memory.clock.spend_ns(3 * MS)  # type: ignore[attr-defined]  # set by the test


def test_what_a_preempted_class_has_done_so_far_is_not_seen(make: Make) -> None:
    world = make(
        TaskClassSetup(1, MS, [ProgramSetup("fast", PythonCode(Fast))], 20 * MS),
        TaskClassSetup(
            4, 20 * MS,
            [ProgramSetup(p.__name__.lower(), PythonCode(p)) for p in (Busy, Second)], 20 * MS,
            first_release_ns=10 * MS,
        ),
    )  # fmt: skip
    world.controller.memory.clock = world.clock  # type: ignore[attr-defined]
    seen: list[tuple[object, bool]] = []

    def watch(_: object) -> None:
        seen.append((world.read("busy.half"), 4 in world.writer._in_cycle))

    world.controller.image.watchers.append(watch)
    ticket = -1

    def send_when_preempted(task_class: object) -> None:
        nonlocal ticket
        if 4 in world.writer._in_cycle[:-1] and ticket < 0:
            ticket = world.reader.send((Store(world.address("second.seen"), b"\5\0"),))

    world.controller.image.inputs.append(send_when_preempted)
    world.controller.run_for(16 * MS)
    during = [half for half, preempted in seen if preempted]
    after = [half for half, preempted in seen if not preempted]
    assert during
    assert set(during) == {0}
    assert after[-1] == 1
    assert world.read("second.before") == 0  # inputs stood still in RUN
    assert world.read("second.seen") == 5
    assert world.reader.is_acknowledged(ticket)


def test_slow_classes_are_written_by_the_latch_of_any_class(make: Make) -> None:
    world = make(
        TaskClassSetup(1, MS, [ProgramSetup("fast", PythonCode(Fast))]),
        TaskClassSetup(5, 100 * MS, [ProgramSetup("slow", PythonCode(Slow))]),
    )
    ticket = world.reader.send((Store(world.address("slow.wanted"), b"\7\0"),))
    world.controller.run(cycles=1)
    assert world.reader.is_acknowledged(ticket)
    assert world.read("slow.wanted") == 7
    assert world.read("slow.seen") == 0


class Huge(Program):
    first = var(UINT, 1)
    waste = var(ARRAY(BYTE, (0, 100_000)))
    last = var(UINT, 2)


def test_of_a_large_project_only_the_exported_tags_are_published(make: Make) -> None:
    world = make(TaskClassSetup(1, MS, [ProgramSetup("huge", PythonCode(Huge))]))
    assert world.writer.directory.bank_size == 0
    find = world.controller.tags.find
    tags = [find("huge.last"), find("huge.first"), find("huge.waste[0]"), find("huge.waste[20]")]
    address = find("huge.first").address
    assert _joined(world.controller, tags) == [(address, 23), (find("huge.last").address, 2)]


def test_programs_of_two_classes_never_share_a_span(make: Make) -> None:
    world = make(
        TaskClassSetup(1, MS, [ProgramSetup("fast", PythonCode(Fast))]),
        TaskClassSetup(2, 2 * MS, [ProgramSetup("slow", PythonCode(Slow))]),
    )
    find = world.controller.tags.find
    assert len(_joined(world.controller, [find("fast.name"), find("slow.level")])) == 2


def test_without_services_there_is_no_ring(make: Make) -> None:
    world = make(services=())
    world.controller.run(cycles=1)
    assert world.read("fast.count") == 1
    with pytest.raises(CommandRefused, match="no ring"):
        world.reader.send((Store(world.address("fast.word"), b"\1\0"),))


def test_each_service_has_its_own_ring(make: Make) -> None:
    world = make(services=("modbus", "web"))
    from plcsim.shared_image import ImageReader

    web = ImageReader(world.fd, "web")
    world.reader.send((Store(world.address("fast.word"), b"\1\0"),))
    ticket = web.send((Store(world.address("fast.setpoint"), b"\2\0"),))
    world.controller.run(cycles=1)
    assert web.is_acknowledged(ticket)
    assert (world.read("fast.word"), world.read("fast.setpoint")) == (1, 2)
    assert len(world.writer._rings) == 2
    assert layout.ring_cells(layout.MAX_RINGS - 1).refused < layout.HEADER_SIZE // 8


def test_a_ring_that_made_no_sense_takes_commands_again(world: World) -> None:
    producer = world.reader._producer
    assert producer is not None
    producer._ring[:8] = b"\xff" * 8
    world.reader._cells[producer._at.head] = layout.RING_SIZE
    with pytest.raises(CommandRefused):
        world.reader.send((Store(world.address("fast.setpoint"), b"\1\0"),))
    world.controller.run(cycles=1)
    assert producer.refused == 1
    ticket = world.reader.send((Store(world.address("fast.setpoint"), b"\1\0"),))
    world.controller.run(cycles=1)
    assert world.reader.is_acknowledged(ticket)
    assert world.read("fast.setpoint") == 1
