"""Who owns which variables."""

import pytest

from plcsim.core.owners import SHARED, bit_of, bits_of
from st_types import ARRAY, BYTE, var


@pytest.fixture
def controller(make_controller, task_class, program_of):
    program = program_of(lambda _: None, data=var(ARRAY(BYTE, (0, 99))))
    return make_controller(task_class(1, 10, a=program), task_class(4, 50, b=program, c=program))


def test_a_variable_belongs_to_the_class_of_its_program(controller):
    first, second = controller.classes
    address = controller.tags.find("b.data[99]").address
    assert controller.owners.of(address) == bit_of(second)
    assert controller.owners.of(controller.tags.find("a.data[0]").address) == bit_of(first)


def test_what_belongs_to_no_class_is_shared(controller):
    below = controller.tags.find("a").address - 1
    above = controller.tags.find("c").address + 100
    assert {controller.owners.of(a) for a in (0, below, above)} == {SHARED}


def test_a_range_is_cut_where_the_owner_changes(controller):
    first, second = map(bit_of, controller.classes)
    a, b, c = (controller.tags.find(name).address for name in "abc")
    assert controller.owners.cut(a + 90, c - a) == [
        (first, a + 90, b - a - 90),
        (second, b, c - b),
        (second, c, 90),
    ]
    assert controller.owners.cut(c + 90, 20) == [(second, c + 90, 10), (SHARED, c + 100, 10)]


def test_sets_of_owners(controller):
    first, second = controller.classes
    assert bits_of([]) == 0
    assert bits_of([first, second]) == bit_of(first) | bit_of(second)
    assert controller.owners.all == bits_of([first, second]) | SHARED
