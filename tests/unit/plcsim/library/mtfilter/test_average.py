"""The mean of the latest values."""

import pytest

from plcsim.library.heap import heap_of
from plcsim.library.mtfilter import average, mtBCD_ERR_FILTER_WINDOW_INVALID


def run(block, values, **inputs):
    found = []
    for value in values:
        block(Enable=True, In=value, **inputs)
        found.append(block.Out)
    return found


def test_the_mean_of_the_latest_values(plc):
    block = plc.new(average.MTFilterMovingAverage)
    assert run(block, [3, 6, 9, 0, 0, 0], WindowLength=3) == [3, 4.5, 6, 5, 3, 0]
    assert block.Active


def test_a_new_length_begins_anew(plc):
    block = plc.new(average.MTFilterMovingAverage)
    run(block, [3, 6], WindowLength=3)
    assert run(block, [9], WindowLength=2) == [6]
    assert run(block, [9, 3], Update=True) == [9, 6]
    assert block.UpdateDone


@pytest.mark.parametrize("length", [0, 10_000])
def test_lengths_that_cannot_be(plc, length):
    block = plc.new(average.MTFilterMovingAverage)
    run(block, [1], WindowLength=length)
    assert (block.Active, block.StatusID) == (False, mtBCD_ERR_FILTER_WINDOW_INVALID)


def test_its_memory_is_given_back(plc):
    block = plc.new(average.MTFilterMovingAverage)
    run(block, [1], WindowLength=8)
    before = heap_of(plc.context).free_bytes
    block(Enable=False)
    assert heap_of(plc.context).free_bytes == before + 32
