"""The clock as RTCtime_typ."""

import pytest

from plcsim.library.runtime import ERR_OK
from plcsim.library.sys_lib import (
    ERR_BUR_ILLDATE,
    ERR_BUR_ILLPTR,
    ERR_BUR_ILLTIME,
    RTCtime_typ,
)


def fields(time):
    day = time.year, time.month, time.day
    return *day, time.hour, time.minute, time.second, time.millisec, time.microsec


@pytest.fixture
def time(tasks):
    return tasks.memory.access(RTCtime_typ, tasks.out)


@pytest.mark.parametrize(
    ("read", "set_"), [("RTC_gettime", "RTC_settime"), ("SW_gettime", "SW_settime")]
)
def test_the_clock_is_read_and_set(tasks, time, read, set_):
    tasks.context.date_ns = 1_774_936_800_012_345_678
    assert tasks.function(read)(tasks.out) == ERR_OK
    assert fields(time) == (2026, 3, 31, 6, 0, 0, 12, 345)
    time.year, time.hour, time.microsec = 2030, 23, 1
    assert tasks.function(set_)(tasks.out) == ERR_OK
    assert tasks.context.date_ns == 1_901_228_400_012_001_000
    assert tasks.function(read)(0) == ERR_BUR_ILLPTR
    assert tasks.function(set_)(0) == ERR_BUR_ILLPTR


@pytest.mark.parametrize(
    ("name", "value", "status"),
    [
        ("hour", 24, ERR_BUR_ILLTIME),
        ("minute", 60, ERR_BUR_ILLTIME),
        ("second", 60, ERR_BUR_ILLTIME),
        ("millisec", 1000, ERR_BUR_ILLTIME),
        ("month", 13, ERR_BUR_ILLDATE),
        ("day", 30, ERR_BUR_ILLDATE),
        ("year", 2100, ERR_BUR_ILLDATE),
        ("year", 1969, ERR_BUR_ILLDATE),
    ],
)
def test_no_such_date_or_time(tasks, time, name, value, status):
    before = tasks.context.date_ns
    time.year, time.month, time.day = 2001, 2, 28
    setattr(time, name, value)
    assert tasks.function("RTC_settime")(tasks.out) == status
    assert tasks.context.date_ns == before


def test_ticks_and_microseconds(tasks):
    tasks.context.date_ns = 5_987_654_321
    assert tasks.function("TIM_ticks")() == 98
    assert tasks.function("TIM_musec")() == 7654
