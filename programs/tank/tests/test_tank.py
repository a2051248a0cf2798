"""The tank on the virtual clock: its control, its alarms, and its Modbus map."""

import pytest

from plcsim.modbus.testing import Modbus, ModbusException
from plcsim.testing import Plc


def fill_by_hand(plc: Plc) -> None:
    plc["control.automatic"] = False
    plc["control.valve_request"] = True


def test_the_level_settles_at_the_setpoint(plc: Plc) -> None:
    plc.run("20s")
    assert plc["control.level"] == pytest.approx(6.0, abs=0.01)
    assert plc["valve_open"] is False


def test_the_pump_empties_the_tank_and_the_valve_refills_it(plc: Plc) -> None:
    plc.run("20s")
    plc.always(lambda: 5.7 < plc["control.level"] < 6.05)
    plc["control.pump_request"] = True
    plc.until({"valve_open": True})
    plc.until({"valve_open": False}, within="30s")
    assert plc["control.litres"] > 0


def test_by_hand_the_tank_overflows_only_up_to_the_switch(plc: Plc) -> None:
    fill_by_hand(plc)
    plc.run("60s")
    assert plc["plant.spilled"] == 0
    assert 9.8 < plc["plant.level"] <= 10.0


def test_the_high_alarm_stays_until_it_is_acknowledged_and_its_cause_has_gone(plc: Plc) -> None:
    fill_by_hand(plc)
    plc.until("control.alarm_high", within="30s")
    assert plc["control.alarms"] == 1
    plc["control.alarm_acknowledge"] = True
    plc.assert_stable("control.alarm_high", for_="100ms")
    plc["control.valve_request"] = False
    plc["control.pump_request"] = True
    plc.assert_stable("control.alarm_high", for_="20s")
    plc["control.alarm_acknowledge"] = True
    plc.assert_within("10ms", {"control.alarm_high": False})


def test_an_operator_plays_with_the_tank_over_modbus(plc: Plc, modbus: Modbus) -> None:
    modbus.write("control.setpoint", 2.0)
    modbus.write("control.pump_request", True)
    modbus.write("control.pump_speed", 50)
    with pytest.raises(ModbusException, match="pump_speed = 101: ILLEGAL_DATA_VALUE"):
        modbus.write("control.pump_speed", 101)
    plc.run("20s")
    assert 1.7 < modbus.read("control.level") < 2.1
    assert modbus.read("pump_on") is True


def test_the_level_and_the_setpoint_lie_at_their_addresses(plc: Plc, modbus: Modbus) -> None:
    plc.run("20s")
    high, low, low_first, high_last, centimetres = modbus.read_input_registers(1, 5)
    assert (high, low) == (high_last, low_first)
    assert 590 < centimetres < 610
    assert modbus.read_holding_registers(5) == [600]
    modbus.write_registers(5, [250])
    assert plc["control.setpoint"] == 2.5


def test_text_and_bits(plc: Plc, modbus: Modbus) -> None:
    plc.cycles(1)
    assert modbus.read("control.batch") == "water"
    modbus.write("control.batch", "milk")
    assert plc["control.batch"] == "milk"
    assert modbus.read_holding_registers(14) == [1]  # automatic
    modbus.request(bytes.fromhex("16 000e fffb 0004"))  # mask write: one bit of the word
    assert plc["control.pump_request"] is True
    assert modbus.read_coils(0, 4) == [True, False, True, False]


def test_six_minutes_are_the_same_every_time(plc: Plc) -> None:
    levels = []
    for _ in range(2):
        plc.restart()
        plc["control.pump_request"] = True
        plc.run("360s")
        levels.append(plc["plant.level"])
    assert levels[0] == levels[1]
