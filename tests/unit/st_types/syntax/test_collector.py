import gc

import pytest

from st_types.syntax.collector import collector_paused


def test_the_collector_is_paused_and_comes_back_also_after_an_error() -> None:
    seen = []

    def fail() -> None:
        with collector_paused():
            seen.append(gc.isenabled())
            raise KeyError

    with pytest.raises(KeyError):
        fail()
    assert [*seen, gc.isenabled()] == [False, True]


def test_a_collector_that_is_off_stays_off() -> None:
    gc.disable()
    try:
        with collector_paused(), collector_paused():
            assert not gc.isenabled()
        assert not gc.isenabled()
    finally:
        gc.enable()


def test_what_was_made_inside_is_not_walked_by_the_next_collection() -> None:
    gc.collect()
    with collector_paused():
        kept = [[number] for number in range(50_000)]
    young, middle, _ = (len(gc.get_objects(generation)) for generation in range(3))
    assert young + middle < len(kept) // 2
    assert gc.get_freeze_count() == 0


def test_what_is_frozen_stays_frozen() -> None:
    gc.freeze()
    try:
        frozen = gc.get_freeze_count()
        assert frozen > 0
        with collector_paused():
            pass
        assert gc.get_freeze_count() == frozen
    finally:
        gc.unfreeze()
