import os

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim import Program
from plcsim.core.errors import ConfigurationError
from plcsim.core.system import State
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup
from plcsim.shared_image import (
    CommandOutcome,
    CommandRefused,
    Mask,
    StoreCommand,
    Write,
    layout,
)
from plcsim.shared_image.command import HEAD, encode_command
from plcsim.shared_image.inbox import STEPS_PER_COMMAND
from plcsim.shared_image.writer import COMMANDS_PER_LATCH
from st_types import UINT, var

from .conftest import MS, Fast, Make, Slow, World

SHARED = World(
    Setup([TaskClassSetup(1, MS, [ProgramSetup("fast", PythonCode(Fast))])]), {"modbus": None}
)
"""For properties: a controller that no example can break."""


def test_a_snapshot_shows_the_cycle_that_has_ended(world: World) -> None:
    for cycle in range(1, 6):
        world.controller.run(cycles=1)
        assert world.read("fast.count") == world.read("fast.copy") == cycle
    assert world.read("fast.name") == "fast"


def test_a_command_is_applied_in_the_next_latch_and_acknowledged_after_its_publish(
    world: World,
) -> None:
    world.controller.run(cycles=1)
    ticket = world.write("fast.setpoint", b"\x2a\0")
    assert not world.is_applied(ticket)
    assert world.read("fast.setpoint") == 0
    world.controller.run(cycles=1)
    assert world.is_applied(ticket)
    assert world.read("fast.setpoint") == 42


def test_an_acknowledged_command_is_in_the_latest_snapshot(world: World) -> None:
    tickets = [(n, world.write("fast.setpoint", n.to_bytes(2, "little"))) for n in range(1, 200)]
    while not world.is_applied(tickets[-1][1]):
        world.controller.run(cycles=1)
        done = [n for n, ticket in tickets if world.is_applied(ticket)]
        assert world.read("fast.setpoint") == done[-1]
        assert len(done) % world.writer.commands_per_latch == 0 or len(done) == len(tickets)


def test_a_mask_works_on_what_the_program_left(world: World) -> None:
    address = world.address("fast.word")
    world.write("fast.word", b"\x12\0")
    world.reader.send(Write((Mask(address, 0xF2, 0x25),)))
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
    tickets = [world.write("fast.setpoint", b"\1\0") for _ in range(100)]
    world.controller.run(cycles=1)
    assert sum(map(world.is_applied, tickets)) == commands


def test_one_latch_applies_few_operations_but_a_command_whole(world: World) -> None:
    flags = world.address("fast.flags")
    many = STEPS_PER_COMMAND * world.writer.commands_per_latch
    first = world.reader.send(
        Write(tuple(StoreCommand(flags + i % 8 * 2, b"\1") for i in range(many)))
    )
    second = world.reader.send(Write((StoreCommand(flags + 1, b"\1"),)))
    world.controller.run(cycles=1)
    assert world.is_applied(first)
    assert not world.is_applied(second)
    assert [world.read(f"fast.flags[{i}]") for i in range(5)] == [True, False, True, False, True]
    world.controller.run(cycles=1)
    assert world.is_applied(second)


def test_scattered_bytes_outside_the_memory_are_not_applied_at_all(world: World) -> None:
    flags = world.address("fast.flags")
    for bad in (0, 0xFFF, world.controller.memory.used, 0xFFFF_FFFF):
        ticket = world.reader.send(Write((StoreCommand(flags, b"\1"), StoreCommand(bad, b"\1"))))
        world.controller.run(cycles=1)
        assert world.reader.outcome(ticket) is CommandOutcome.NO_SUCH_ADDRESS
        assert world.read("fast.flags[0]") is False


def test_a_command_with_one_bad_address_is_not_applied_at_all(world: World) -> None:
    good = world.address("fast.setpoint")
    ticket = world.reader.send(Write((StoreCommand(good, b"\1\0"), StoreCommand(0x10, b"\1"))))
    world.controller.run(cycles=1)
    assert world.reader.outcome(ticket) is CommandOutcome.NO_SUCH_ADDRESS
    assert world.read("fast.setpoint") == 0


def test_garbage_in_the_ring_does_not_stop_the_scan(world: World) -> None:
    producer = world.reader._producer
    assert producer is not None
    record = bytearray(encode_command(Write((StoreCommand(world.address("fast.word"), b"\1\0"),))))
    record[16:24] = b"\xff" * 8
    bad = producer.put(bytes(record))
    world.write("fast.setpoint", b"\7\0")
    world.controller.run(cycles=2)
    assert world.reader.outcome(bad) is CommandOutcome.NO_COMMAND
    assert world.read("fast.setpoint") == 7


@given(st.binary(min_size=1, max_size=60), st.integers(1, 255), st.integers(0, 2**16 - 1))
def test_whatever_a_record_says_the_scan_goes_on(body: bytes, kind: int, count: int) -> None:
    world = SHARED
    size = 16 + -(-len(body) // 8) * 8
    record = HEAD.pack(size, kind, 0, count, 0) + body.ljust(size - 16, b"\0")
    assert world.reader._producer is not None
    ticket = world.reader._producer.put(record)
    good = world.write("fast.setpoint", b"\7\0")
    world.controller.requests.clear()
    world.controller.run(cycles=3)
    assert world.reader.outcome(ticket) is not CommandOutcome.WAITING
    assert world.is_applied(good)
    assert world.controller.state is State.RUN


def test_a_waker_is_raised_once_for_each_publish_that_answers(make: Make) -> None:
    world = make()
    fd = os.eventfd(0, os.EFD_NONBLOCK | os.EFD_CLOEXEC)
    world.writer._inboxes[0]._wake_fd = fd
    with pytest.raises(BlockingIOError):
        os.eventfd_read(fd)
    world.write("fast.word", b"\1\0")
    world.write("fast.word", b"\2\0")
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
        seen.append((world.read("busy.half"), bool(world.controller.image.held())))

    world.controller.image.watchers.append(watch)
    ticket = -1

    def send_when_preempted(task_class: object) -> None:
        nonlocal ticket
        if world.controller.image.held() and ticket < 0:
            ticket = world.write("second.seen", b"\5\0")

    world.controller.image.inputs.append(send_when_preempted)
    world.controller.run_for(16 * MS)
    during = [half for half, preempted in seen if preempted]
    after = [half for half, preempted in seen if not preempted]
    assert during
    assert set(during) == {0}
    assert after[-1] == 1
    assert world.read("second.before") == 0  # inputs stood still in RUN
    assert world.read("second.seen") == 5
    assert world.is_applied(ticket)


def test_slow_classes_are_written_by_the_latch_of_any_class(make: Make) -> None:
    world = make(
        TaskClassSetup(1, MS, [ProgramSetup("fast", PythonCode(Fast))]),
        TaskClassSetup(5, 100 * MS, [ProgramSetup("slow", PythonCode(Slow))]),
    )
    ticket = world.write("slow.wanted", b"\7\0")
    world.controller.run(cycles=1)
    assert world.is_applied(ticket)
    assert world.read("slow.wanted") == 7
    assert world.read("slow.seen") == 0


def test_without_services_there_is_no_ring(make: Make) -> None:
    world = make(services=())
    world.controller.run(cycles=1)
    assert world.read("fast.count") == 1
    with pytest.raises(CommandRefused, match="no ring"):
        world.write("fast.word", b"\1\0")


def test_each_service_has_its_own_ring(make: Make) -> None:
    world = make(services=("modbus", "web"))
    from plcsim.shared_image import ImageReader

    web = ImageReader(world.fd, "web")
    world.write("fast.word", b"\1\0")
    ticket = web.send(Write((StoreCommand(world.address("fast.setpoint"), b"\2\0"),)))
    world.controller.run(cycles=1)
    assert web.outcome(ticket) is CommandOutcome.APPLIED
    assert (world.read("fast.word"), world.read("fast.setpoint")) == (1, 2)
    assert len(world.writer.directory.streams) == 2 + layout.GUESTS


def test_a_ring_that_made_no_sense_takes_commands_again(world: World) -> None:
    producer = world.reader._producer
    assert producer is not None
    producer._ring[:8] = b"\xff" * 8
    world.reader._cells[producer._at.head] = layout.RING_SIZE
    with pytest.raises(CommandRefused):
        world.write("fast.setpoint", b"\1\0")
    world.controller.run(cycles=1)
    assert producer.refused == 1
    ticket = world.write("fast.setpoint", b"\1\0")
    world.controller.run(cycles=1)
    assert world.is_applied(ticket)
    assert world.read("fast.setpoint") == 1


def test_more_services_than_there_are_rings_are_an_error(make: Make) -> None:
    with pytest.raises(ConfigurationError, match="13 services: at most 12"):
        make(services=tuple(map(str, range(13))))


class Slower(Slow):
    pass


def test_a_command_for_a_class_in_mid_cycle_does_not_hold_up_those_for_others(make: Make) -> None:
    world = make(
        TaskClassSetup(1, MS, [ProgramSetup("fast", PythonCode(Fast))]),
        TaskClassSetup(5, 100 * MS, [ProgramSetup("slow", PythonCode(Slow))]),
        TaskClassSetup(6, 100 * MS, [ProgramSetup("slower", PythonCode(Slower))]),
    )
    in_cycle, slow = world.controller.scan.in_cycle, world.controller.classes[1]
    in_cycle.append(slow)
    held = [world.write("slow.wanted", n.to_bytes(2, "little")) for n in (1, 2)]
    both = world.reader.send(
        Write(
            (
                StoreCommand(world.address("slow.wanted"), b"\3\0"),
                StoreCommand(world.address("slower.wanted"), b"\3\0"),
            )
        )
    )
    behind = world.write("slower.wanted", b"\4\0")  # after `both`, which writes it too
    free = world.write("fast.setpoint", b"\5\0")
    world.controller.run(cycles=3)
    assert world.is_applied(free)
    assert not any(map(world.is_applied, [*held, both, behind]))
    assert (world.read("slow.wanted"), world.read("slower.wanted")) == (0, 0)
    in_cycle.remove(slow)
    world.controller.run(cycles=1)
    assert all(map(world.is_applied, [*held, both, behind]))
    assert (world.read("slow.wanted"), world.read("slower.wanted")) == (3, 4)


def test_what_waited_is_applied_over_several_latches_where_it_is_much(make: Make) -> None:
    world = make(
        TaskClassSetup(1, MS, [ProgramSetup("fast", PythonCode(Fast))]),
        TaskClassSetup(5, 100 * MS, [ProgramSetup("slow", PythonCode(Slow))]),
    )
    in_cycle, slow = world.controller.scan.in_cycle, world.controller.classes[1]
    in_cycle.append(slow)
    tickets = [world.write("slow.wanted", n.to_bytes(2, "little")) for n in range(1, 1001)]
    world.controller.run(cycles=80)
    late = world.write("fast.setpoint", b"\5\0")
    world.controller.run(cycles=1)
    assert not world.is_applied(late)  # so many wait that the ring stands
    in_cycle.remove(slow)
    latches = 0
    while not world.is_applied(late):
        before = sum(map(world.is_applied, tickets))
        world.controller.run(cycles=1)
        latches += 1
        done = sum(map(world.is_applied, tickets))
        assert done - before <= world.writer.commands_per_latch
        assert world.read("slow.wanted") == done
    assert latches == -(-1001 // world.writer.commands_per_latch)


orders = st.lists(
    st.one_of(
        st.tuples(st.just("write"), st.sets(st.sampled_from([0, 1, 2]), min_size=1)),
        st.tuples(st.just("hold"), st.sets(st.sampled_from([1, 2]))),
        st.tuples(st.just("run"), st.just(set())),
    ),
    max_size=40,
)


@given(orders)
def test_whatever_is_held_writes_to_a_variable_are_applied_in_order_and_none_is_lost(
    orders: list[tuple[str, set[int]]],
) -> None:
    names = ["fast.setpoint", "slow.wanted", "slower.wanted"]
    world = World(
        Setup(
            [
                TaskClassSetup(1, MS, [ProgramSetup("fast", PythonCode(Fast))]),
                TaskClassSetup(5, 10_000 * MS, [ProgramSetup("slow", PythonCode(Slow))]),
                TaskClassSetup(6, 10_000 * MS, [ProgramSetup("slower", PythonCode(Slower))]),
            ]
        ),
        {"modbus": None},
    )
    addresses = [world.address(name) for name in names]
    in_cycle = world.controller.scan.in_cycle
    written: list[list[int]] = [[0], [0], [0]]
    shown: list[list[int]] = [[0], [0], [0]]
    number = 0
    for order, which in [*orders, ("hold", set()), ("run", set()), ("run", set()), ("run", set())]:
        if order == "write":
            number += 1
            data = number.to_bytes(2, "little")
            world.reader.send(Write(tuple(StoreCommand(addresses[w], data) for w in sorted(which))))
            for w in which:
                written[w].append(number)
        elif order == "hold":
            in_cycle[:] = [world.controller.classes[w] for w in sorted(which)]
        else:
            world.controller.run(cycles=1)
            for w, name in enumerate(names):
                value = world.read(name)
                assert isinstance(value, int)
                shown[w].append(value)
                if world.controller.classes[w] in in_cycle:
                    assert shown[w][-1] == shown[w][-2]
    for w in range(3):
        assert shown[w] == sorted(shown[w])  # never an older value after a newer one
        assert set(shown[w]) <= set(written[w])
        assert shown[w][-1] == written[w][-1]
    os.close(world.fd)


def test_while_paused_values_are_exchanged_without_a_cycle(world: World) -> None:
    world.controller.run(cycles=1)
    world.controller.forces.force(world.controller.tags.find("fast.word"), b"\x09\0", "test")
    ticket = world.write("fast.setpoint", b"\7\0")
    number = world.reader.latest
    world.writer.exchange()
    assert world.is_applied(ticket)
    assert (world.read("fast.setpoint"), world.read("fast.word")) == (7, 9)
    assert world.reader.latest == number + 1
    assert world.read("fast.count") == 1
