"""Garbage is collected in sleeps that are long enough, and never by itself once frozen."""

import gc

import pytest

from plcsim.host import garbage


@pytest.fixture
def collected(monkeypatch):
    """The generations collected; ``gc.get_count`` gives what the test wants."""
    found = []
    monkeypatch.setattr(garbage.gc, "collect", found.append)
    return found


@pytest.fixture
def counts(monkeypatch):
    """``counts(young, middle, old)`` sets what the collector has counted."""

    def counts(*numbers):
        monkeypatch.setattr(garbage.gc, "get_count", lambda: numbers)

    return counts


LONG_NS = garbage.ENOUGH_IDLE_NS
SHORT_NS = LONG_NS - 1
MANY = garbage.YOUNG_OBJECTS + 1
TOO_MANY = garbage.TOO_MANY_OBJECTS + 1


@pytest.mark.parametrize(
    ("numbers", "idle_ns", "generations"),
    [
        ((MANY - 1, 0, 0), LONG_NS, []),
        ((MANY, 0, 0), SHORT_NS, []),
        ((MANY, 0, 0), LONG_NS, [0]),
        ((MANY, 11, 0), LONG_NS, [1]),
        ((MANY, 11, 11), LONG_NS, [2]),
        ((TOO_MANY, 0, 0), SHORT_NS, [0]),
        ((TOO_MANY, 0, 0), -1, [0]),
    ],
)
def test_what_is_collected_when(numbers, idle_ns, generations, counts, collected):
    counts(*numbers)
    garbage.collect_while_idle(idle_ns)
    assert collected == generations


def test_frozen_objects_are_not_collected_and_thaw_undoes_it():
    try:
        garbage.freeze()
        assert not gc.isenabled()
        assert gc.get_freeze_count() > 0
    finally:
        garbage.thaw()
    assert gc.isenabled()
    assert gc.get_freeze_count() == 0


class Knot:
    """Refers to itself, so only the collector frees it."""

    alive = 0

    def __init__(self):
        Knot.alive += 1
        self.me = self

    def __del__(self):
        Knot.alive -= 1


def test_a_program_that_makes_reference_cycles_does_not_grow(run_for, task_class, program_of):
    most = 0

    def cyclic(_):
        nonlocal most
        for _ in range(100):
            Knot()
        most = max(most, Knot.alive)

    gc.collect()
    gc.disable()
    try:
        run_for(3000, task_class(1, 10, p=program_of(cyclic)))
    finally:
        gc.enable()
    assert most < 3 * garbage.YOUNG_OBJECTS
