from __future__ import annotations

from functools import partial

from hypothesis import given
from hypothesis import strategies as st

from plcsim.network.events import EventQueue


def drain(queue: EventQueue, now_ns: int) -> list[int]:
    times = []
    while (due := queue.take_due(now_ns)) is not None:
        times.append(due[0])
        due[1]()
    return times


def test_ties_go_by_order_of_planning() -> None:
    queue, seen = EventQueue(), []
    for name in "abc":
        queue.plan(5, partial(seen.append, name))
    assert drain(queue, 5) == [5, 5, 5]
    assert seen == ["a", "b", "c"]


def test_nothing_comes_early() -> None:
    queue = EventQueue()
    queue.plan(5, lambda: None)
    assert queue.take_due(4) is None
    assert queue.next_ns == 5
    assert len(queue) == 1


def test_cancelled_events_do_not_come() -> None:
    queue, seen = EventQueue(), []
    event = queue.plan(1, lambda: seen.append(1))
    queue.plan(2, lambda: seen.append(2))
    queue.cancel(event)
    queue.cancel(event)
    assert queue.next_ns == 2
    assert len(queue) == 1
    drain(queue, 9)
    assert seen == [2]


def test_cancelling_what_is_over_does_nothing() -> None:
    queue = EventQueue()
    event = queue.plan(1, lambda: None)
    drain(queue, 1)
    queue.cancel(event)
    assert len(queue) == 0
    assert queue.next_ns is None


def test_cancelled_events_do_not_pile_up() -> None:
    queue = EventQueue()
    for _ in range(10_000):
        queue.cancel(queue.plan(10**12, lambda: None))
    assert len(queue) == 0
    assert len(queue._heap) < 200


@given(st.lists(st.tuples(st.integers(0, 50), st.booleans())), st.integers(0, 60))
def test_exactly_what_is_due_comes_in_order(plans: list[tuple[int, bool]], now_ns: int) -> None:
    queue, seen = EventQueue(), []
    for number, (time_ns, cancelled) in enumerate(plans):
        event = queue.plan(time_ns, partial(seen.append, (time_ns, number)))
        if cancelled:
            queue.cancel(event)
    drain(queue, now_ns)
    kept = [(t, n) for n, (t, cancelled) in enumerate(plans) if not cancelled]
    assert seen == sorted(k for k in kept if k[0] <= now_ns)
    assert len(queue) == len(kept) - len(seen)
