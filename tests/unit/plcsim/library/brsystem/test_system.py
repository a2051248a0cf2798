"""What runs, since when, in which version."""

import re
from importlib.metadata import version

from plcsim.core.task import Unit
from plcsim.library import brsystem
from plcsim.library.brsystem import (
    INIT_REASON_WARMSTART,
    brERR_INVALID_PARAMETER,
    brERR_NON_CYCLIC_CONTEXT,
)
from plcsim.library.runtime import ERR_OK


def test_the_class_that_runs(plc):
    info = plc.new(brsystem.RTInfo)
    info(enable=True)
    assert info.status == brERR_NON_CYCLIC_CONTEXT
    plc.controller.scan.active = plc.controller.tasks[0]
    info()
    assert (info.status, info.cycle_time, info.task_class) == (ERR_OK, 10_000, 1)
    assert info.init_reason == INIT_REASON_WARMSTART
    assert plc.function("RTTolerance")() == 0


def test_it_is_known_in_init_too(plc):
    info, seen = plc.new(brsystem.RTInfo), []

    def init():
        info(enable=True)
        seen.append(info.cycle_time)

    plc.controller.tasks[0].units[Unit.INIT] = init
    plc.controller.boot()
    assert seen == [10_000]


def test_cycle_times_by_class(plc):
    for name in "RTCycleTime", "RTCylceTime":
        assert plc.function(name)(1) == 10_000
        assert plc.function(name)(2) == 0


def test_ticks_of_10_ms(plc):
    plc.context.release_ns = 1_239_999_999
    info = plc.call(brsystem.SysInfo)
    assert (info.status, info.tick_count, info.init_count) == (ERR_OK, 123, 1)


def test_the_version(plc):
    major, minor = (int(part) for part in re.findall(r"\d+", version("plcsim"))[:2])
    address = plc.text("", 10)
    assert plc.call(brsystem.TARGETInfo).status == brERR_INVALID_PARAMETER
    info = plc.call(brsystem.TARGETInfo, pOSVersion=address)
    assert (info.status, info.DataFormat) == (ERR_OK, 1)
    assert plc.string(address) == f"P{major:02}.{minor:02}"
    assert plc.function("OSVersionMajor")() == major
    assert plc.function("OSVersionMinor")() == minor
    assert plc.function("OSVersionPatch")() >= 0
    assert plc.function("OSVersionBuild")() >= 0
    assert plc.call(brsystem.SysInfo).version == major << 8 | minor


def test_the_battery_is_full(plc):
    assert plc.call(brsystem.BatteryInfo).state == brsystem.brBATTERY_OK
