"""until, assert_within, assert_stable, assert_sequence: what holds, what fails, what it says."""

import pytest

from plcsim.core.errors import TagError
from plcsim.testing import ExpectationFailed, PlcTestError

MS = 1_000_000


def test_until_gives_the_time_to_the_release_of_the_cycle(cell_plc):
    assert cell_plc.until({"Cell.count": 4}) == 35 * MS
    assert cell_plc.until({"Cell.count": 4}) == 0


def test_until_takes_a_tag_a_mapping_or_a_function(cell_plc):
    cell_plc["Cell.start"] = True
    cell_plc.until("Cell.motor.on", within="10ms")
    cell_plc.until({"Cell.light": "GREEN", "Cell.start": True}, within="100ms")
    cell_plc.until(lambda: cell_plc["Cell.count"] >= 9, within="100ms")
    assert cell_plc["Cell.count"] == 9


def test_a_real_is_compared_as_the_tag_holds_it(cell_plc):
    cell_plc["Cell.level"] = 0.1
    assert cell_plc["Cell.level"] != 0.1
    cell_plc.until({"Cell.level": 0.1}, within="0ms")
    cell_plc["Cell.level"] = -0.0
    cell_plc.until({"Cell.level": 0}, within="0ms")


def test_until_that_never_holds_shows_what_it_saw(cell_plc):
    with pytest.raises(ExpectationFailed) as caught:
        cell_plc.until(lambda: cell_plc["Cell.count"] > 30, within="250ms")
    assert str(caught.value) == (
        'waited 250 ms for cell_plc["Cell.count"] > 30; it held after none of 25 cycles; '
        "Cell.count is 25"
    )
    note = caught.value.__notes__[0]
    assert "the last 20 cycles" in note
    assert "   25  245 ms          25" in note
    assert "    6   55 ms           6" in note
    assert "    5   45 ms" not in note


def test_a_cycle_at_the_end_of_the_time_counts(cell_plc):
    cell_plc.assert_within("25ms", {"Cell.count": 3})


def test_a_cycle_after_the_end_of_the_time_does_not(cell_plc):
    with pytest.raises(ExpectationFailed, match=r"Cell.count = 3 within 24.9 ms; .* 2 cycles"):
        cell_plc.assert_within("24.9ms", {"Cell.count": 3})


def test_assert_within_tells_how_long_it_took(cell_plc):
    assert cell_plc.assert_within("1s", {"Cell.count": 3}).elapsed_ns == 25 * MS


def test_within_a_block_until_waits_no_longer_than_the_block_may_take(cell_plc):
    with cell_plc.assert_within("100ms"):
        cell_plc.run("60ms")
        with pytest.raises(ExpectationFailed, match=r"waited 40 ms for Cell.start"):
            cell_plc.until("Cell.start")


def test_after_the_block_its_limit_is_gone(cell_plc):
    with cell_plc.assert_within("100ms"):
        pass
    cell_plc.until({"Cell.count": 300})


def test_a_block_that_takes_too_long_fails(cell_plc):
    with (
        pytest.raises(ExpectationFailed, match="100 ms at most; it took 110 ms"),
        cell_plc.assert_within("100ms"),
    ):
        cell_plc.run("110ms")


def test_a_block_that_fails_itself_keeps_its_own_error(cell_plc):
    def block():
        with cell_plc.assert_within("100ms"):
            cell_plc.run("110ms")
            raise ValueError("mine")

    with pytest.raises(ValueError, match="mine"):
        block()


def test_stable(cell_plc):
    cell_plc.assert_stable(["Cell.start", "Cell.motor"], for_="1s")
    assert cell_plc.time_ns == 1000 * MS


def test_what_changes_is_not_stable(cell_plc):
    with pytest.raises(ExpectationFailed, match="stay RED for 1 s; after 35 ms it became GREEN"):
        cell_plc.assert_stable("Cell.light", for_="1s")


def test_stable_with_a_value_that_is_not_there(cell_plc):
    with pytest.raises(ExpectationFailed, match=r"Cell.light to be GREEN, but Cell.light is RED"):
        cell_plc.assert_stable("Cell.light", for_="1s", value="GREEN")


def test_stable_value_needs_one_tag(cell_plc):
    with pytest.raises(PlcTestError, match="exactly one tag"):
        cell_plc.assert_stable(["Cell.start", "Cell.light"], for_="1s", value=1)


def test_sequence_of_values(cell_plc):
    cell_plc.assert_sequence("Cell.light", ["RED", "GREEN", "YELLOW", "RED"])


def test_sequence_with_durations(cell_plc):
    steps = ["RED", ("GREEN", "40ms"), ("YELLOW", "40ms"), "RED"]
    cell_plc.assert_sequence("Cell.light", steps, tolerance="0ms")


def test_the_first_step_may_have_begun_before(cell_plc):
    cell_plc.run("20ms")
    cell_plc.assert_sequence("Cell.light", [("RED", "40ms"), "GREEN"], tolerance="0ms")


def test_sequence_of_several_tags(cell_plc):
    steps = [("RED", False), (("GREEN", False), "40ms"), ("YELLOW", False)]
    cell_plc.assert_sequence(("Cell.light", "Cell.start"), steps)


@pytest.mark.parametrize(
    ("steps", "text"),
    [
        (["GREEN"], "step 1, GREEN: it is RED at the start"),
        (["RED", "YELLOW"], "at step 2, YELLOW: GREEN came"),
        (["RED", ("GREEN", "20ms"), "YELLOW"], "stayed for 40 ms instead of 20 ms"),
        (["RED", ("GREEN", "60ms"), "YELLOW"], "stayed for 40 ms instead of 60 ms"),
        ([("RED", "20ms"), "GREEN"], "step 1, RED: it stayed for 35 ms instead of 20 ms"),
    ],
)
def test_sequence_that_goes_otherwise(cell_plc, steps, text):
    with pytest.raises(ExpectationFailed, match=text):
        cell_plc.assert_sequence("Cell.light", steps)


def test_sequence_that_stops(cell_plc):
    with pytest.raises(ExpectationFailed, match="still FALSE at the end of the time"):
        cell_plc.assert_sequence("Cell.start", [False, True], within="100ms")


@pytest.mark.parametrize("steps", [[], [(1, 2, 3)]])
def test_sequence_with_steps_that_do_not_fit(cell_plc, steps):
    with pytest.raises((PlcTestError, TagError)):
        cell_plc.assert_sequence(("Cell.light", "Cell.start"), steps)


@pytest.mark.parametrize("within", ["fast", "10", 1.5, -1, None])
def test_durations_are_checked(cell_plc, within):
    with pytest.raises(PlcTestError, match="is not a duration"):
        cell_plc.assert_within(within, "Cell.start")


def test_in_the_slow_class_its_own_cycles_are_shown(new_plc):
    plc = new_plc(10, 50)
    with pytest.raises(ExpectationFailed) as caught:
        plc.assert_within("200ms", {"Cell2.count": 100})
    assert "    4  175 ms            4" in caught.value.__notes__[0]


def test_tags_of_two_classes_are_shown_together(new_plc):
    plc = new_plc(10, 50)
    with pytest.raises(ExpectationFailed) as caught:
        plc.assert_within("100ms", {"Cell.count": 100, "Cell2.count": 100})
    assert "#2" in caught.value.__notes__[0]
    assert "#1" in caught.value.__notes__[0]
