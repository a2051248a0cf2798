"""The process image: inputs are set in LATCH, watchers see the tags in PUBLISH."""

import pytest

from plcsim.core.image import ProcessImage
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


def test_an_image_without_a_scan_has_no_phases():
    calls = []
    image = ProcessImage()
    image.inputs.append(calls.append)
    image.watchers.append(calls.append)
    image.latch("class 1")
    image.publish("class 2")
    assert calls == ["class 1", "class 2"]
