"""Acts in the order of their moments, then of planning."""

from hypothesis import given
from hypothesis import strategies as st

from plcsim.testing.schedule import Schedule


@given(st.lists(st.integers(0, 20)), st.integers(0, 20))
def test_what_is_due_happens_once_in_order(moments, until):
    schedule, done = Schedule(), []
    for number, moment in enumerate(moments):
        schedule.plan(moment, lambda n=number: done.append(n))
    schedule.perform(until)
    due = [n for n, moment in enumerate(moments) if moment <= until]
    assert done == sorted(due, key=lambda n: (moments[n], n))
    assert len(schedule) == len(moments) - len(due)
    schedule.perform(until)
    assert len(done) == len(due)


def test_an_act_may_plan_another_for_the_same_moment():
    schedule, done = Schedule(), []
    schedule.plan(1, lambda: schedule.plan(1, lambda: done.append("second")))
    schedule.perform(1)
    assert done == ["second"]


def test_cleared_acts_do_not_happen():
    schedule, done = Schedule(), []
    schedule.plan(1, lambda: done.append(1))
    schedule.clear()
    schedule.perform(9)
    assert done == []
