"""Values by hand."""

import math

import pytest

from plcsim.library import loopconr
from plcsim.library.heap import heap_of
from plcsim.library.loopconr import LCR_ERR_LCRMovAvgFlt_BASE
from plcsim.library.runtime import ERR_FUB_ENABLE_FALSE, ERR_OK

LINE = {"x1": 4.0, "y1": 0.0, "x2": 20.0, "y2": 100.0}
"""4 to 20 mA as a percentage."""


def call(plc, view, **inputs):
    block = plc.new(view)
    block(**inputs)
    return block


@pytest.mark.parametrize(("x", "y"), [(4, 0), (12, 50), (20, 100), (0, -25), (24, 125)])
def test_a_line(plc, x, y):
    assert call(plc, loopconr.LCRScal, x=x, **LINE).y == y
    assert call(plc, loopconr.LCRLimScal, x=x, **LINE).y == min(max(y, 0), 100)


def test_a_line_that_falls(plc):
    line = {"x1": 0.0, "y1": 10.0, "x2": 10.0, "y2": 0.0}
    assert call(plc, loopconr.LCRLimScal, x=-5, **line).y == 10
    assert call(plc, loopconr.LCRLimScal, x=15, **line).y == 0
    assert call(plc, loopconr.LCRLimScal, x=3, **line).y == 7


def test_two_points_with_one_x(plc):
    line = LINE | {"x2": 4.0}
    assert call(plc, loopconr.LCRScal, x=7, **line).y == 0
    assert call(plc, loopconr.LCRLimScal, x=7, **line).y == 0


@pytest.mark.parametrize(
    ("value", "out", "above", "below"),
    [
        (5.4, 5, False, False),
        (5.5, 6, False, False),
        (-5.5, -6, False, False),
        (11.0, 10, True, False),
        (-11.0, -10, False, True),
        (math.inf, 10, True, False),
        (math.nan, -10, False, False),
    ],
)
def test_limits(plc, value, out, above, below):
    given = {"in": value, "min_value": -10, "max_value": 10}
    block = call(plc, loopconr.LCRLimit, **given)
    assert (block.out, block.max_limit, block.min_limit) == (out, above, below)


def test_the_mean_of_the_latest_values(plc):
    block, found = plc.new(loopconr.LCRMovAvgFlt), []
    for x in (3.0, 6.0, 9.0, 0.0, 0.0, 0.0, 0.0):
        block(enable=True, x=x, base=3)
        found.append(block.y)
    assert block.status == ERR_OK
    assert found == [3.0, 4.5, 6.0, 5.0, 3.0, 0.0, 0.0]


def test_it_begins_anew_with_another_base_or_after_a_pause(plc):
    block = plc.new(loopconr.LCRMovAvgFlt)
    block(enable=True, x=10.0, base=2)
    block(x=20.0, base=4)
    assert block.y == 20.0
    block(enable=False)
    assert block.status == ERR_FUB_ENABLE_FALSE
    block(enable=True, x=4.0)
    assert block.y == 4.0


def test_no_base_and_no_memory(plc):
    block = plc.new(loopconr.LCRMovAvgFlt)
    block(enable=True, x=1.0)
    assert block.status == LCR_ERR_LCRMovAvgFlt_BASE
    while heap_of(plc.context).allocate(10_000):
        pass
    block(base=10_000)
    assert block.status == LCR_ERR_LCRMovAvgFlt_BASE


def test_its_memory_is_given_back(plc):
    block = plc.new(loopconr.LCRMovAvgFlt)
    block(enable=True, x=1.0, base=8)
    before = heap_of(plc.context).free_bytes
    for base in (8, 4, 8, 16, 8):
        block(base=base)
    assert heap_of(plc.context).free_bytes == before
    block(enable=False)
    assert heap_of(plc.context).free_bytes == before + 32
