"""Reading and setting the controller's date and time."""

import pytest

from plcsim.library.astime import DTGetTime, DTStructure, clock, timERR_INVALID_DTSTRUCTURE
from plcsim.library.astime.interface import DATE_AND_TIME_MAX, timERR_INVALID_PARAMETER, timNO_DST
from plcsim.library.astime.settings import AsTimeSettings
from plcsim.library.runtime import ERR_FUB_ENABLE_FALSE, ERR_OK

NEW_YEAR_2000 = 946_684_800
MARCH = 1_774_936_800
"""2026-03-31 06:00:00."""

S = 1_000_000_000


def date_at(plc):
    return plc.call(DTGetTime).DT1


def test_the_virtual_clock_starts_in_2000(plc):
    found = plc.call(DTGetTime)
    assert (found.status, found.DT1) == (ERR_OK, NEW_YEAR_2000)
    plc.pass_ms(1500)
    found()
    assert found.DT1 == NEW_YEAR_2000 + 1


def test_a_start_date_may_be_given(make_plc):
    assert date_at(make_plc(start_date_ns=MARCH * S)) == MARCH


def test_the_date_stands_still_within_a_cycle(plc):
    first = date_at(plc)
    plc.clock.sleep_until_ns(10 * S)
    assert date_at(plc) == first


def test_the_date_runs_on_over_a_restart(plc):
    plc.call(clock.DTSetTime, DT1=MARCH)
    plc.context.restart()
    assert date_at(plc) == MARCH


def test_clock_ms_wraps(plc):
    read = plc.function("clock_ms")
    plc.pass_ms(5)
    assert read() == 5
    plc.context.release_ns = (2**31 - 1) * 1_000_000
    assert read() == 2**31 - 1
    plc.context.release_ns += 1_000_000
    assert read() == -(2**31)


def test_disabled_blocks_do_nothing(plc):
    block = plc.new(clock.DTSetTime)
    block(DT1=MARCH)
    assert block.status == ERR_FUB_ENABLE_FALSE
    assert date_at(plc) == NEW_YEAR_2000


def test_set_from_seconds(plc):
    assert plc.call(clock.DTSetTime, DT1=MARCH).status == ERR_OK
    plc.pass_ms(2000)
    assert date_at(plc) == MARCH + 2
    assert plc.call(clock.DTSetTime, DT1=DATE_AND_TIME_MAX + 1).status == timERR_INVALID_PARAMETER


def test_setting_is_logged_unless_that_is_not_wanted(plc):
    plc.call(clock.DTExSetTime, DT1=MARCH, Option=1)
    assert len(plc.controller.logbook) == 0
    plc.call(clock.DTExSetTime, DT1=MARCH)
    (entry,) = plc.controller.logbook
    assert entry.text == "date and time set to 2026-03-31 06:00:00"


def test_the_structure_has_microseconds(make_plc):
    plc = make_plc(start_date_ns=MARCH * S + 12_345_678)
    address = plc.bytes(bytes(16))
    assert plc.call(clock.DTStructureGetTime, pDTStructure=address).status == ERR_OK
    found = plc.memory.access(DTStructure, address)
    assert (found.year, found.hour, found.millisec, found.microsec) == (2026, 6, 12, 345)


@pytest.mark.parametrize("block", [clock.DTStructureSetTime, clock.DTStructureExSetTime])
def test_set_from_a_structure(plc, block):
    address = plc.bytes(bytes(16))
    assert plc.call(block, pDTStructure=address).status == timERR_INVALID_DTSTRUCTURE
    assert plc.call(block, pDTStructure=0).status == timERR_INVALID_PARAMETER
    plc.function("DT_TO_DTStructure")(MARCH, address)
    assert plc.call(block, pDTStructure=address).status == ERR_OK
    assert date_at(plc) == MARCH


def test_utc_is_behind_local_time(make_plc):
    plc = make_plc([AsTimeSettings(utc_offset=120)], start_date_ns=MARCH * S)
    assert plc.call(clock.UtcDTGetTime).DT1 == MARCH - 7200
    address = plc.bytes(bytes(16))
    plc.call(clock.UtcDTStructureGetTime, pDTStructure=address)
    assert plc.memory.access(DTStructure, address).hour == 4
    assert plc.call(clock.UtcDTStructureGetTime).status == timERR_INVALID_PARAMETER


@pytest.mark.parametrize("block", [clock.UtcDTSetTime, clock.UtcDTExSetTime])
def test_set_in_utc(make_plc, block):
    plc = make_plc([AsTimeSettings(utc_offset=120)])
    assert plc.finish(block, DT1=MARCH).status == ERR_OK
    assert date_at(plc) == MARCH + 7200


@pytest.mark.parametrize("block", [clock.UtcDTStructureSetTime, clock.UtcDTStructureExSetTime])
def test_set_in_utc_from_a_structure(make_plc, block):
    plc = make_plc([AsTimeSettings(utc_offset=-60)])
    address = plc.bytes(bytes(16))
    plc.function("DT_TO_DTStructure")(MARCH, address)
    assert plc.finish(block, pDTStructure=address).status == ERR_OK
    assert date_at(plc) == MARCH - 3600


def test_conversions_between_utc_and_local_time(make_plc):
    plc = make_plc([AsTimeSettings(utc_offset=90)])
    address = plc.bytes(bytes(16))
    to_local = plc.finish(clock.UtcDT_TO_LocalDTStructure, DT1=MARCH, pDTStructure=address)
    assert to_local.status == ERR_OK
    back = plc.finish(clock.LocalDTStructure_TO_UtcDT, pDTStructure=address)
    assert (back.status, back.DT1) == (ERR_OK, MARCH)
    assert plc.function("DTStructure_TO_DT")(address) == MARCH + 5400
    plc.finish(clock.LocalDT_TO_UtcDTStructure, DT1=MARCH, pDTStructure=address)
    assert plc.function("DTStructure_TO_DT")(address) == MARCH - 5400
    assert plc.finish(clock.UtcDTStructure_TO_LocalDT, pDTStructure=address).DT1 == MARCH


def test_conversions_refuse_what_is_no_date(make_plc):
    plc = make_plc([AsTimeSettings(utc_offset=90)])
    empty = plc.bytes(bytes(16))
    convert = clock.LocalDTStructure_TO_UtcDT
    assert plc.finish(convert).status == timERR_INVALID_PARAMETER
    assert plc.finish(convert, pDTStructure=empty).status == timERR_INVALID_DTSTRUCTURE
    early = plc.finish(clock.LocalDT_TO_UtcDTStructure, DT1=60, pDTStructure=empty)
    assert early.status == timERR_INVALID_PARAMETER


def test_nothing_else_sets_the_clock(plc):
    found = plc.finish(clock.TimeDeviceGetInfo)
    assert (found.status, found.timeDevice) == (ERR_OK, 1)
    assert plc.finish(clock.DstGetInfo).dstState == timNO_DST
    assert plc.finish(clock.DstGetInfoDT).dstState == timNO_DST
