"""The tank on the virtual clock: its control, its alarms, and its Modbus map."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from plcsim.clock import VirtualClock
from plcsim.controller import Controller
from plcsim.network import VirtualNetwork
from plcsim.project import load_setup, read_project
from plcsim.services.modbus.in_process import VirtualServer
from plcsim.tagmap.load import load_map

PROJECT = read_project(Path(__file__).parents[1])
SETUP = load_setup(PROJECT)
SECOND = 1_000_000_000


class Tank:
    """The controller with its plant, and a Modbus master that speaks in PDUs."""

    def __init__(self) -> None:
        clock = VirtualClock()
        network = VirtualNetwork(clock.now_ns).host("192.168.0.10")
        self.plc = Controller(SETUP, network=network, clock=clock)
        settings, folder = PROJECT.extensions["modbus"]
        points = load_map(settings, folder, self.plc.tags, self.plc.tasks).points
        self.modbus = VirtualServer(self.plc, points)
        self._master = self.modbus.connect()
        self.plc.boot()
        self.plc.run(cycles=1)

    def ask(self, pdu: str) -> str:
        data = bytes.fromhex(pdu)
        header = bytes.fromhex("0001 0000") + (len(data) + 1).to_bytes(2, "big") + b"\1"
        return self.modbus.exchange(self._master, header + data)[7:].hex()

    def __getitem__(self, path: str) -> Any:
        return self.plc.tags.read(self.plc.tags.find(path))

    def __setitem__(self, path: str, value: object) -> None:
        self.plc.tags.write(self.plc.tags.find(path), value)

    def run(self, seconds: float) -> None:
        self.plc.run_for(round(seconds * SECOND))


@pytest.fixture
def tank() -> Iterator[Tank]:
    made = Tank()
    yield made
    made.modbus.close()


def test_the_level_settles_at_the_setpoint(tank: Tank) -> None:
    tank.run(20)
    assert tank["control.level"] == pytest.approx(6.0, abs=0.01)
    assert tank["control.valve_open"] is False


def test_the_pump_empties_the_tank_and_the_valve_refills_it(tank: Tank) -> None:
    tank.run(20)
    tank["control.pump_request"] = True
    levels, valve = [], set()
    for _ in range(100):
        tank.run(0.2)
        levels.append(tank["control.level"])
        valve.add(tank["control.valve_open"])
    assert valve == {True, False}
    assert min(levels) > 5.7
    assert max(levels) < 6.05
    assert tank["control.litres"] > 0


def test_by_hand_the_tank_overflows_only_up_to_the_switch(tank: Tank) -> None:
    tank["control.automatic"] = False
    tank["control.valve_request"] = True
    tank.run(60)
    assert tank["plant.spilled"] == 0
    assert 9.8 < tank["plant.level"] <= 10.0


def test_the_high_alarm_stays_until_it_is_acknowledged_and_its_cause_has_gone(tank: Tank) -> None:
    tank["control.automatic"] = False
    tank["control.valve_request"] = True
    tank.run(30)
    assert tank["control.alarm_high"] is True
    assert tank["control.alarms"] == 1
    tank["control.alarm_acknowledge"] = True
    tank.run(0.1)
    assert tank["control.alarm_high"] is True
    tank["control.valve_request"] = False
    tank["control.pump_request"] = True
    tank.run(20)
    assert tank["control.alarm_high"] is True
    tank["control.alarm_acknowledge"] = True
    tank.run(0.1)
    assert tank["control.alarm_high"] is False


def test_an_operator_plays_with_the_tank_over_modbus(tank: Tank) -> None:
    assert tank.ask("10 0000 0002 04 40000000") == "1000000002"  # setpoint 2.0 m
    assert tank.ask("05 0002 ff00") == "050002ff00"  # pump on
    assert tank.ask("06 0004 0032") == "0600040032"  # at half its speed
    assert tank.ask("06 0004 0065") == "8603"  # more is not possible
    tank.run(20)
    assert 1.7 < tank["plant.level"] < 2.1
    assert tank.ask("03 0005 0001") == "030200c8"  # setpoint in centimetres
    centimetres = int(tank.ask("04 0005 0001")[4:], 16)
    assert 170 < centimetres < 210


def test_the_level_is_the_same_in_both_word_orders(tank: Tank) -> None:
    answer = tank.ask("04 0001 0004")[4:]
    assert answer[:4] == answer[12:]
    assert answer[4:8] == answer[8:12]


def test_text_and_bits(tank: Tank) -> None:
    assert tank.ask("03 0006 0008") == "0310" + b"water".ljust(16, b"\0").hex()
    assert tank.ask("10 0006 0008 10" + b"milk".ljust(16, b"\0").hex()) == "1000060008"
    assert tank["control.batch"] == "milk"
    assert tank.ask("03 000e 0001") == "03020001"
    assert tank.ask("16 000e fffb 0004") == "16000efffb0004"
    assert tank["control.pump_request"] is True


def test_six_minutes_are_the_same_every_time(tank: Tank) -> None:
    other = Tank()
    for one in (tank, other):
        one["control.pump_request"] = True
        one.run(360)
    assert tank["plant.level"] == other["plant.level"]
    other.modbus.close()
