"""The process image: inputs are set in LATCH, watchers see the tags in PUBLISH."""

import pytest

from plcsim.core.errors import PhaseError
from st_types import BOOL, UINT, var


@pytest.fixture
def controller(make_controller, task_class, program_of):
    """One program that counts its cycles and has an input."""

    def cyclic(program):
        program.cycles += 1

    program = program_of(cyclic, cycles=var(UINT), on=var(BOOL))
    controller = make_controller(task_class(1, 10, main=program))
    controller.boot()
    return controller


def test_inputs_are_set_before_the_programs_run_and_watchers_see_what_they_did(controller):
    seen = []
    variables = controller.tasks[0].cyclic.__self__

    def plant(task_class):
        seen.append((task_class.number, variables.cycles))
        variables.on = True

    controller.image.inputs.append(plant)
    controller.image.watchers.append(lambda _: seen.append((variables.on, variables.cycles)))
    controller.run(cycles=2)
    assert seen == [(1, 0), (True, 1), (1, 1), (True, 2)]


def test_what_was_entered_first_is_called_first(controller):
    calls = []
    for name in ("first", "second"):
        controller.image.inputs.append(lambda _, name=name: calls.append(("in", name)))
        controller.image.watchers.append(lambda _, name=name: calls.append(("out", name)))
    controller.run(cycles=1)
    assert calls == [("in", "first"), ("in", "second"), ("out", "first"), ("out", "second")]


def test_the_phases_are_kept_to(controller):
    image = controller.image
    (task_class,) = controller.classes
    with pytest.raises(PhaseError, match="not allowed in SLEEP, only in LATCH"):
        image.latch(task_class)
    with pytest.raises(PhaseError, match="not allowed in SLEEP, only in PUBLISH"):
        image.publish(task_class)


def test_a_forced_tag_wins_over_inputs_and_over_the_program(controller):
    seen = []
    variables = controller.tasks[0].cyclic.__self__
    tag = controller.tags.find("main.cycles")

    def plant(_):
        variables.cycles = 1

    controller.image.inputs.append(plant)
    controller.image.watchers.append(lambda _: seen.append(variables.cycles))
    controller.forces.force(tag, (500).to_bytes(2, "little"), "test")
    controller.run(cycles=2)
    assert seen == [500, 500]
    assert controller.forces.release(tag)
    controller.run(cycles=1)
    assert seen[-1] == 2
