"""Two programs in two task classes share a global variable, seen and written over Modbus."""

import json

import pytest

from plcsim.modbus.service.errors import ModbusException
from plcsim.modbus.testing import Modbus
from plcsim.process.supervisor import Supervisor
from plcsim.project.plc_toml import read_project
from plcsim.testing.errors import PlcTestError
from plcsim.testing.target import open_plc

FILES = {
    "plc.toml": """
        [task_class.1]
        cycle = "10ms"
        programs = ["fast"]

        [task_class.4]
        cycle = "50ms"
        programs = ["slow"]

        [modbus]
        port = 0
    """,
    "Global.var": """
        VAR
            gCount : UDINT;
            gStep : UINT := 1;
        END_VAR
        VAR CONSTANT
            LIMIT : UDINT := 1000;
        END_VAR
    """,
    "tags.csv": """\
        tag,area,offset
        gCount,ir,0
        gStep,hr,0
        LIMIT,hr,1
        ::gStep,hr,3
    """,
    "fast/cyclic.py": """
        def cyclic(self):
            self.gCount = min(self.gCount + self.gStep, self.LIMIT)
    """,
    "slow/Variables.var": "VAR seen : UDINT; END_VAR\n",
    "slow/main.py": """
        from plcsim import Program

        class Slow(Program):
            def cyclic(self):
                self.seen = self.gCount
    """,
}


@pytest.fixture
def folder(project):
    return project(FILES)


def test_in_virtual_time(folder):
    with open_plc(folder) as plc:
        modbus = Modbus(plc)
        plc.run("100ms")
        assert plc["gCount"] == modbus.read("gCount") == 10
        assert plc["slow.seen"] == 8
        modbus.write("gStep", 5)
        plc.run("100ms")
        assert plc["gCount"] > 50
        assert modbus.read("LIMIT") == 1000
        with pytest.raises((ModbusException, PlcTestError)):
            modbus.write("LIMIT", 1)
        plc.force("gCount", 7)
        plc.run("50ms")
        assert plc["slow.seen"] == modbus.read("gCount") == 7
        plc.release("gCount")
        plc.restart()
        assert (plc["gCount"], plc["gStep"]) == (0, 1)


def test_on_the_real_clock(folder):
    with Supervisor(read_project(folder), for_ns=300_000_000) as supervisor:
        result = supervisor.wait()
    assert result["state"] == "STOPPED", json.dumps(result)
    assert result["task_classes"][0]["cycles"] > 3
