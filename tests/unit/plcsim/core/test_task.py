"""Task classes, tasks and programs; the scan's part is in test_scan.py."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.core.task import Cause, Policy, Task, TaskClass, Unit

MS = 1_000_000


@pytest.mark.parametrize("number", [0, 9, -1])
def test_a_class_outside_1_to_8_is_refused(number):
    with pytest.raises(ValueError, match=f"task class {number} is outside 1..8"):
        TaskClass(number, 10 * MS, 0, [])


@pytest.mark.parametrize(
    ("cycle_ns", "tolerance_ns", "text"),
    [(0, 0, "cycle time"), (-1, 0, "cycle time"), (1, -1, "tolerance")],
)
def test_times_that_make_no_sense_are_refused(cycle_ns, tolerance_ns, text):
    with pytest.raises(ValueError, match=f"task class 1: the {text}"):
        TaskClass(1, cycle_ns, tolerance_ns, [])


def test_a_first_release_before_the_start_is_refused():
    with pytest.raises(ValueError, match="task class 1: the first release"):
        TaskClass(1, 10, 0, [], first_release_ns=-1)


def test_the_first_release_is_half_a_cycle_after_the_start():
    task_class = TaskClass(1, 10 * MS, 0, [])
    task_class.lay_grid(100 * MS)
    assert task_class.release_ns == 105 * MS


@given(st.integers(1, 50), st.integers(0, 50), st.integers(-10, 300))
def test_the_next_release_is_the_first_grid_point_not_before_the_end(cycle_ns, first_ns, late_ns):
    task_class = TaskClass(1, cycle_ns, 0, [], first_release_ns=first_ns)
    task_class.lay_grid(1000)
    end_ns = 1000 + first_ns + late_ns
    task_class.advance(end_ns)
    grid = range(1000 + first_ns, 2000, cycle_ns)
    following_ns = next(t for t in grid[1:] if t >= end_ns)
    assert task_class.release_ns == following_ns
    assert task_class.missed == grid.index(following_ns) - 1


@pytest.mark.parametrize(
    ("cause", "policy"),
    [
        (Cause.PROGRAM, Policy.SERVICE),
        (Cause.PREEMPTED, Policy.SERVICE),
        (Cause.HOST, Policy.LOG),
    ],
)
def test_the_policies_by_default(cause, policy):
    assert TaskClass(1, 10, 0, []).policy_for(cause) is policy


def test_use_is_counted_from_the_release_on_and_by_program():
    def task():
        return Task("p", None, {Unit.CYCLIC: None}, fault_of=None, interrupt=None)

    own, other = task(), task()
    task_class = TaskClass(1, 100, 0, [own])
    task_class.lay_grid(0)  # released at 50
    task_class.note_use(other, 0, 50, 50)
    assert task_class.used_by_own_and_others() == ({}, {}, 0)
    task_class.note_use(other, 40, 60, 20)
    task_class.note_use(other, 60, 90, 10)
    task_class.note_use(own, 90, 100, 10)
    task_class.note_use(None, 45, 55, 3)
    assert task_class.used_by_own_and_others() == ({own: 10}, {other: 20}, 3)
    task_class.advance(100)
    assert task_class.used_by_own_and_others() == ({}, {}, 0)


def test_after_a_pause_the_grid_is_as_before_and_nothing_was_missed():
    task_class = TaskClass(1, 100, 0, [])
    task_class.lay_grid(0)
    for now_ns, release_ns in ((0, 50), (50, 50), (51, 150), (150, 150), (1000, 1050)):
        task_class.skip_to(now_ns)
        assert task_class.release_ns == release_ns
    assert task_class.missed == 0
