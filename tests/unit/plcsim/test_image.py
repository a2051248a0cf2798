"""The process image: commands in LATCH, bounded; observations in PUBLISH."""

import pytest

from plcsim.errors import TagError
from plcsim.image import DRAINED_PER_CYCLE, QUEUE_LENGTH
from plcsim.task import Policy
from st_types import BOOL, INT, UINT, var

MS = 1_000_000


@pytest.fixture
def controller(make_controller, task_class, program_of):
    """One program that counts its cycles and has two inputs."""

    def cyclic(program):
        program.cycles += 1

    program = program_of(cyclic, cycles=var(UINT), speed=var(INT), on=var(BOOL))
    controller = make_controller(task_class(1, 10, main=program))
    controller.boot()
    return controller


def test_a_command_is_applied_in_the_next_latch(controller):
    variables = controller.tasks[0].variables
    assert controller.image.command("main.speed", -3)
    assert controller.image.command("MAIN.ON", True)
    assert (variables.speed, variables.on) == (0, False)
    controller.run(cycles=1)
    assert (variables.speed, variables.on) == (-3, True)


def test_commands_are_applied_in_order(controller):
    for value in (1, 2, 3):
        controller.image.command("main.speed", value)
    controller.run(cycles=1)
    assert controller.tasks[0].variables.speed == 3


def test_a_flood_of_commands_is_bounded_and_applied_some_in_each_cycle(controller):
    taken = [controller.image.command("main.speed", value) for value in range(QUEUE_LENGTH + 10)]
    assert taken == [True] * QUEUE_LENGTH + [False] * 10
    assert controller.image.refused == 10
    controller.run(cycles=1)
    assert controller.tasks[0].variables.speed == DRAINED_PER_CYCLE - 1
    assert controller.image.command("main.speed", 7)
    controller.run(cycles=QUEUE_LENGTH // DRAINED_PER_CYCLE)
    assert controller.tasks[0].variables.speed == 7


@pytest.mark.parametrize(
    ("path", "value"),
    [("main.sped", 1), ("other.speed", 1), ("main.speed", 40_000), ("main.speed", "fast")],
)
def test_a_wrong_command_is_refused_at_once(controller, path, value):
    with pytest.raises(TagError, match=path):
        controller.image.command(path, value)
    controller.run(cycles=1)
    assert controller.tasks[0].variables.speed == 0


def test_inputs_see_what_commands_did_and_programs_see_both(controller):
    seen = []

    def plant(task_class):
        seen.append((task_class.number, controller.tasks[0].variables.speed))
        controller.tasks[0].variables.on = True

    controller.image.inputs.append(plant)
    controller.image.watchers.append(
        lambda _: seen.append((controller.tasks[0].variables.on, len(seen)))
    )
    controller.image.command("main.speed", 5)
    controller.run(cycles=1)
    assert seen == [(1, 5), (True, 1)]


def test_a_command_does_not_reach_into_a_cycle_that_is_preempted(
    make_controller, task_class, program_of, clock
):
    seen = []

    def note(_):
        seen.append(controller.tasks[1].variables.level)
        clock.spend_ns(6 * MS)

    def ask(program):
        program.level += 1
        controller.image.command("A.level", program.level)

    slow = {"a": program_of(note, level=var(INT)), "b": program_of(note), "c": program_of(note)}
    controller = make_controller(
        task_class(1, 4, {"policy": Policy.LOG}, fast=program_of(ask, level=var(INT))),
        task_class(2, 30, **slow),
    )
    controller.boot()
    controller.run_for(70 * MS)
    first, second = seen[0], seen[3]
    assert seen == [first] * 3 + [second] * 3
    assert 0 < first < second
