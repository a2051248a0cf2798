"""A whole Automation Studio project on the virtual clock: everything that its files say."""

from pathlib import Path

import pytest

from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.core.errors import ConfigurationError
from plcsim.testing.target import open_plc

BOTTLING = Path(__file__).parents[1] / "data" / "automation_studio" / "Bottling"


@pytest.fixture
def plc():
    try:
        find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")
    with open_plc(project=BOTTLING) as plc:
        yield plc


def test_task_classes_run_with_the_times_of_the_hardware(plc):
    plc.run("8s")
    assert plc["gTicks"] == 10_000
    assert plc["Clock.seconds"] == 8
    assert plc["Count.cycles"] == 100


def test_actions_libraries_and_globals_of_packages(plc):
    plc["gStart"] = True
    plc.run("40ms")
    assert plc["gLamp"] is True
    plc.run("8s")
    assert plc["gLine.bottles"] == plc["gTotal"] > 5
    assert plc["stationShare"] == pytest.approx(plc["gLine.bottles"] / 10)
    assert plc["gLine.names[0]"] == "Kölsch"


def test_one_source_as_two_tasks_with_variables_of_their_own(plc):
    for _ in range(3):
        plc["ValveA.command"] = True
        plc.run("16ms")
        plc["ValveA.command"] = False
        plc.run("16ms")
    assert (plc["ValveA.opened"], plc["ValveB.opened"]) == (3, 0)
    assert plc["linePulse.count"] == 3


def test_what_nothing_executes_is_simulated_by_a_table_and_told(plc):
    plc.run("100ms")
    assert plc["FillStatio.alarms.Enable"] is True
    assert plc["FillStatio.alarm_ready"] is True
    texts = [entry.text for entry in plc.controller.logbook]
    assert "MpAlarm: MpAlarmCore is simulated: Active follows Enable" in texts


def test_a_program_in_ladder_beside_structured_text(plc):
    def press(name):
        plc[f"Motor.{name}"] = True
        plc.run("8ms")
        plc[f"Motor.{name}"] = False
        plc.run("8ms")

    press("start")
    assert (plc["Motor.motor"], plc["Motor.warm"]) == (True, False)
    plc.run("120ms")
    assert plc["Motor.warm"] is True
    press("stop")
    turns = plc["Motor.turns"]
    assert (plc["Motor.motor"], plc["Motor.warm"], plc["Motor.last"]) == (False, False, turns)
    assert (turns > 10, plc["Motor.starts"], plc["Motor.often"]) == (True, 1, False)
    for _ in range(2):
        press("start")
        press("stop")
    assert (plc["Motor.starts"], plc["Motor.often"], plc["Motor.many"]) == (3, True, True)
    press("clear")
    assert (plc["Motor.starts"], plc["Motor.often"], plc["Motor.many"]) == (0, False, False)


def test_a_program_in_a_sequential_function_chart(plc):
    def active():
        steps = ("Idle", "Fill", "Wash", "Ready", "Watch", "Drain")
        return " ".join(step for step in steps if plc[f"Washer.{step}.X"])

    plc.run("40ms")
    assert active() == "Idle"
    assert plc["Washer.Idle.T"] > 16
    plc["Washer.start"] = True
    seen = []
    for _ in range(90):
        plc.run("4ms")
        outputs = [name for name in ("valve", "pump", "lamp") if plc[f"Washer.{name}"]]
        here = f"{active()}: {' '.join(outputs)}"
        if here not in seen[-1:]:
            seen.append(here)
    assert seen == [
        "Idle: ",
        "Fill: valve",
        "Wash Watch: pump lamp",
        "Ready Watch: lamp",
        "Fill: valve",
        "Wash Watch: pump lamp",
        "Ready Watch: lamp",
        "Drain: ",
    ]
    assert (plc["Washer.loads"], plc["Washer.drained"]) == (2, True)
    plc["Washer.start"] = False
    plc.run("8ms")
    assert active() == "Idle"


def test_a_program_in_automation_basic(plc):
    def put(kind, time="60ms"):
        plc["Sorter.kind"] = kind
        plc["Sorter.part"] = True
        plc.run(time)
        plc["Sorter.part"] = False
        plc.run("8ms")

    assert plc["Sorter.text"] == "no 'part' yet"
    put(3, "20ms")
    assert list(plc["Sorter.count"]) == [0, 0, 0, 0]
    put(3)
    put(1)
    assert plc["Sorter.text"] == "sorted"
    assert plc["Sorter.cleaned"] is False
    put(2)
    assert list(plc["Sorter.count"]) == [0, 2, 1, 0]
    assert list(plc["Sorter.last"]) == [2, 1, 3, -1]
    assert (plc["Sorter.flags"], plc["Sorter.cleaned"]) == (6, True)
    put(9, "200ms")
    assert plc["Sorter.text"] == "unknown"


def test_a_program_in_a_function_block_diagram(plc):
    plc.run("400ms")
    assert (plc["Mixer.level"], plc["Mixer.full"], plc["Mixer.mixing"]) == (60, False, False)
    plc.run("1s")
    assert (plc["Mixer.level"], plc["Mixer.full"], plc["Mixer.mixing"]) == (100, True, True)


def test_io_channels_are_latched_and_published(plc):
    plc['%IX."X20DI9371".DigitalInput01'] = True
    plc["IoMap.X20DI9371.DigitalInput03"] = True
    plc.run("100ms")
    assert plc["gStart"] is True
    assert plc["ValveB.opened"] == 1
    assert plc["IoMap.X20DO9322.DigitalOutput01"] is True
    assert plc["IoMap.X20AO4622.AnalogOutput01"] == plc["gSpeed"] > 0


def test_variables_go_to_variables_with_the_cycles(plc):
    plc["gStart"] = True
    plc.run("1s")
    plc["gStart"] = False
    plc.run("1s")
    assert plc["gSpeed"] == plc["Boiler.speed"] == 0
    assert plc["gPressure"] == plc["Boiler.outputs.pressure"] == 1000
