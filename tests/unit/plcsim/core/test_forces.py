"""Forced tags: what they win over, what they leave alone, what is refused."""

import pytest

from plcsim.core.errors import TagError
from plcsim.core.owners import bit_of
from st_types import ARRAY, UINT, var


@pytest.fixture
def controller(make_controller, task_class, program_of):
    program = program_of(lambda _: None, n=var(UINT), many=var(ARRAY(UINT, (0, 3))))
    return make_controller(task_class(1, 10, fast=program), task_class(2, 50, slow=program))


@pytest.fixture
def tag(controller):
    return controller.tags.find


@pytest.fixture
def forces(controller):
    return controller.forces


def value(controller, path):
    return controller.tags.read(controller.tags.find(path))


def test_forced_values_are_written_whenever_they_are_applied(controller, forces, tag):
    forces.force(tag("fast.n"), b"\7\0", "test")
    forces.force(tag("slow.many"), bytes(range(8)), "test")
    for _ in range(2):
        controller.tags.write(tag("fast.n"), 1)
        forces.apply(0)
        assert value(controller, "fast.n") == 7
        assert value(controller, "slow.many") == [0x100, 0x302, 0x504, 0x706]


def test_a_class_in_mid_cycle_is_left_alone(controller, forces, tag):
    forces.force(tag("fast.n"), b"\7\0", "test")
    forces.force(tag("slow.n"), b"\7\0", "test")
    forces.apply(bit_of(controller.classes[1]))
    assert (value(controller, "fast.n"), value(controller, "slow.n")) == (7, 0)


def test_a_forced_tag_can_be_forced_to_another_value(controller, forces, tag):
    forces.force(tag("fast.n"), b"\1\0", "somebody")
    forces.force(tag("FAST.N"), b"\2\0", "another")
    assert [(f.data, f.source) for f in forces] == [(b"\2\0", "another")]


def test_what_overlaps_a_forced_tag_is_refused_by_its_name(forces, tag):
    forces.force(tag("fast.many[1]"), b"\1\0", "test")
    with pytest.raises(TagError, match=r"fast\.many overlaps fast\.many\[1\], which is forced"):
        forces.force(tag("fast.many"), bytes(8), "test")
    forces.force(tag("fast.many[2]"), b"\1\0", "test")
    assert len(forces) == 2


def test_bytes_of_another_size_are_refused(forces, tag):
    with pytest.raises(TagError, match=r"fast\.n: 3 bytes are not a UINT"):
        forces.force(tag("fast.n"), b"123", "test")
    assert len(forces) == 0


def test_a_released_tag_keeps_its_value_until_somebody_writes_it(controller, forces, tag):
    forces.force(tag("fast.n"), b"\7\0", "test")
    forces.apply(0)
    assert forces.release(tag("fast.n"))
    assert not forces.release(tag("fast.n"))
    assert value(controller, "fast.n") == 7
    controller.tags.write(tag("fast.n"), 1)
    forces.apply(0)
    assert value(controller, "fast.n") == 1


def test_whoever_follows_is_told_of_every_change(forces, tag):
    calls = []
    forces.follow(lambda: calls.append(len(forces)))
    forces.force(tag("fast.n"), b"\7\0", "test")
    forces.force(tag("slow.n"), b"\7\0", "test")
    forces.release(tag("fast.n"))
    forces.release(tag("fast.n"))
    assert forces.clear() == 1
    assert forces.clear() == 0
    assert calls == [1, 2, 1, 0]
