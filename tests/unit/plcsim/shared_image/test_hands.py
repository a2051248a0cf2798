"""Forces, releases and control by command: what they do, what the logbook says, what is refused."""

import pytest

from plcsim.core.control import Action, Request
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, TaskClassSetup
from plcsim.shared_image import Command, CommandOutcome, Control, ForceCommand, Release
from plcsim.shared_image.force_list import ForcedTag
from plcsim.shared_image.hands import Hands
from st_types.types.values import encode

from .conftest import MS, Fast, Make, Slow, World


def do(world: World, command: Command) -> CommandOutcome:
    ticket = world.reader.send(command)
    world.controller.run(cycles=1)
    return world.reader.outcome(ticket)


def force(world: World, path: str, value: object) -> CommandOutcome:
    tag = world.controller.tags.find(path)
    return do(world, ForceCommand(path, encode(tag.data_type, value)))


def entries(world: World) -> list[str]:
    return [f"{entry.source}: {entry.text}" for entry in world.controller.logbook]


def test_a_forced_tag_wins_over_the_program_until_it_is_released(world: World) -> None:
    assert force(world, "fast.count", 500) is CommandOutcome.APPLIED
    assert world.read("fast.count") == 500
    world.controller.run(cycles=2)
    assert world.read("fast.count") == 500
    assert world.read("fast.copy") == 501  # a program sees what it has written itself
    assert do(world, Release("FAST.count")) is CommandOutcome.APPLIED
    assert world.read("fast.count") == 501


def test_a_forced_tag_wins_over_later_stores(world: World) -> None:
    force(world, "fast.setpoint", 5)
    ticket = world.write("fast.setpoint", b"\x09\0")
    world.controller.run(cycles=1)
    assert world.is_applied(ticket)
    assert world.read("fast.setpoint") == 5


def test_every_reader_sees_what_is_forced(world: World) -> None:
    assert world.reader.forces() == []
    force(world, "fast.setpoint", 5)
    force(world, "fast.name", "hand")
    assert world.reader.forces() == [
        ForcedTag("fast.setpoint", world.address("fast.setpoint"), b"\5\0", "modbus"),
        ForcedTag("fast.name", world.address("fast.name"), b"hand".ljust(12, b"\0"), "modbus"),
    ]
    do(world, Release("fast.setpoint"))
    assert [forced.path for forced in world.reader.forces()] == ["fast.name"]


def test_the_logbook_says_who_forced_what(world: World) -> None:
    force(world, "fast.setpoint", 5)
    force(world, "fast.name", "hand")
    force(world, "fast.flags", [True] * 16)
    do(world, Release("fast.name"))
    do(world, Release(""))
    assert entries(world)[-5:] == [
        "modbus: fast.setpoint is forced to 5",
        "modbus: fast.name is forced to 'hand'",
        "modbus: fast.flags is forced to [16(TRUE)]",
        "modbus: fast.name is released",
        "modbus: 2 forced tags are released",
    ]
    assert world.reader.forces() == []


def test_what_cannot_be_forced_is_refused(world: World) -> None:
    assert do(world, ForceCommand("fast.nothing", b"\0")) is CommandOutcome.NO_SUCH_TAG
    assert do(world, ForceCommand("", b"\0")) is CommandOutcome.NO_SUCH_TAG
    assert do(world, ForceCommand("fast.count", b"\0")) is CommandOutcome.NO_COMMAND
    assert do(world, Release("fast.nothing")) is CommandOutcome.NO_SUCH_TAG
    assert do(world, Release("fast.count")) is CommandOutcome.NOT_FORCED
    assert force(world, "fast.flags[2]", True) is CommandOutcome.APPLIED
    assert force(world, "fast.flags", [True] * 16) is CommandOutcome.OVERLAPS
    assert [forced.path for forced in world.reader.forces()] == ["fast.flags[2]"]


def test_forces_that_the_list_cannot_hold_are_refused(world: World) -> None:
    long = world.controller.tags.find("fast.flags")._replace(path="x" * 65_420)
    world.controller.forces.force(long, bytes(16), "test")
    assert force(world, "fast.word", 7) is CommandOutcome.APPLIED
    assert force(world, "fast.count", 7) is CommandOutcome.TOO_MANY
    other = ForceCommand("fast.word", b"\x09\0")
    assert Hands(world.controller).carry_out(other, "x" * 99) is CommandOutcome.TOO_MANY
    assert [(f.path[:9], f.data) for f in world.reader.forces()] == [
        ("x" * 9, bytes(16)),
        ("fast.word", b"\7\0"),
    ]


def test_a_force_waits_for_a_class_in_the_middle_of_a_cycle(make: Make) -> None:
    world = make(
        TaskClassSetup(1, MS, [ProgramSetup("fast", PythonCode(Fast))]),
        TaskClassSetup(5, 100 * MS, [ProgramSetup("slow", PythonCode(Slow))]),
    )
    slow = world.controller.classes[1]
    ticket = world.reader.send(ForceCommand("slow.wanted", b"\7\0"))
    world.controller.scan.in_cycle.append(slow)
    world.controller.run(cycles=1)
    assert world.reader.outcome(ticket) is CommandOutcome.WAITING
    world.controller.scan.in_cycle.remove(slow)
    world.controller.run(cycles=1)
    assert world.reader.outcome(ticket) is CommandOutcome.APPLIED
    assert world.read("slow.wanted") == 7


@pytest.mark.parametrize("action", list(Action))
def test_a_control_command_is_a_request_of_the_controller(world: World, action: Action) -> None:
    ticket = world.reader.send(Control(action, 3))
    world.controller.run(cycles=5)
    assert world.reader.outcome(ticket) is CommandOutcome.APPLIED
    assert list(world.controller.requests) == [Request(action, 3, "modbus")]
    assert world.controller.classes[0].cycles == 1  # the run ended after this cycle


def test_the_speed_of_the_real_clock_cannot_be_changed(world: World) -> None:
    world.clock.is_virtual = False
    assert do(world, Control(Action.SPEED, 2)) is CommandOutcome.NOT_HERE
    assert not world.controller.requests
