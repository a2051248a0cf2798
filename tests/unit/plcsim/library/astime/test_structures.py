"""Dates and durations as structures. Expected dates are those of ``date -u -d @SECONDS``."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.library.astime import DATE_AND_TIME_MAX, DTStructure, TIMEStructure
from plcsim.library.astime.structures import duration_parts

DATES = {
    0: (1970, 1, 1, 4, 0, 0, 0),
    951_782_399: (2000, 2, 28, 1, 23, 59, 59),
    951_782_400: (2000, 2, 29, 2, 0, 0, 0),
    1_774_936_800: (2026, 3, 31, 2, 6, 0, 0),
    DATE_AND_TIME_MAX: (2099, 12, 31, 4, 23, 59, 59),
    0xFFFF_FFFF: (2106, 2, 7, 0, 6, 28, 15),
}
DAY_MS = 86_400_000


def date_fields(view):
    return view.year, view.month, view.day, view.wday, view.hour, view.minute, view.second


@pytest.mark.parametrize("seconds", DATES)
def test_a_date_is_taken_apart_and_put_together(plc, seconds):
    view = plc.new(DTStructure)
    view.millisec, view.microsec = 7, 8
    address = plc.bytes(bytes(DTStructure._plc_type.size))
    assert plc.function("DT_TO_DTStructure")(seconds, address) == address
    found = plc.memory.access(DTStructure, address)
    assert date_fields(found) == DATES[seconds]
    assert (found.millisec, found.microsec) == (0, 0)
    assert plc.function("DTStructure_TO_DT")(address) == seconds


@pytest.mark.parametrize(
    "wrong",
    [
        {"month": 13},
        {"month": 0},
        {"day": 30},
        {"hour": 24},
        {"second": 60},
        {"year": 1969},
        {"year": 2107},
        {"millisec": 1000},
        {"microsec": 1000},
    ],
)
def test_no_date_is_0(plc, wrong):
    address = plc.bytes(bytes(DTStructure._plc_type.size))
    view = plc.memory.access(DTStructure, address)
    view.year, view.month, view.day = 2001, 2, 28
    assert plc.function("DTStructure_TO_DT")(address) == 983_318_400
    for name, value in wrong.items():
        setattr(view, name, value)
    assert plc.function("DTStructure_TO_DT")(address) == 0


@pytest.mark.parametrize(
    ("milliseconds", "parts"),
    [
        (0, (0, 0, 0, 0, 0)),
        (3_723_004, (0, 1, 2, 3, 4)),
        (DAY_MS + 1, (1, 0, 0, 0, 1)),
        (-DAY_MS - 1, (-1, 0, 0, 0, 1)),
    ],
)
def test_a_duration_is_taken_apart_and_put_together(plc, milliseconds, parts):
    address = plc.bytes(b"\xff" * TIMEStructure._plc_type.size)
    assert plc.function("TIME_TO_TIMEStructure")(milliseconds, address) == address
    view = plc.memory.access(TIMEStructure, address)
    assert (view.day, view.hour, view.minute, view.second, view.millisec) == parts
    assert view.microsec == 0
    assert plc.function("TIMEStructure_TO_TIME")(address) == milliseconds


@given(st.integers(0, 2**31))
def test_parts_of_a_duration_add_up(milliseconds):
    day, hour, minute, second, rest = duration_parts(milliseconds)
    assert (hour < 24, minute < 60, second < 60, rest < 1000) == (True,) * 4
    assert (((day * 24 + hour) * 60 + minute) * 60 + second) * 1000 + rest == milliseconds


def test_a_null_pointer_gives_0(plc):
    assert plc.function("DT_TO_DTStructure")(1, 0) == 0
    assert plc.function("DTStructure_TO_DT")(0) == 0
    assert plc.function("TIME_TO_TIMEStructure")(1, 0) == 0
    assert plc.function("TIMEStructure_TO_TIME")(0) == 0
