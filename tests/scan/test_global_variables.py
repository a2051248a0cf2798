"""Two programs in two task classes share a global variable, seen and written over Modbus."""

import signal
import subprocess
import sys
import time

import pytest
from pymodbus.client import ModbusTcpClient

from plcsim.modbus.service.errors import ModbusException
from plcsim.modbus.testing import Modbus
from plcsim.testing.errors import PlcTestError
from plcsim.testing.target import open_plc
from tests.ports import free_port

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
        slow.seen,ir,2
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


@pytest.fixture
def served(folder):
    """The project as it runs with its service: a client, and the process."""
    port = free_port()
    plc_toml = folder / "plc.toml"
    plc_toml.write_text(plc_toml.read_text().replace("port = 0", f"port = {port}"))
    command = [sys.executable, "-m", "plcsim", "run", "--quiet", str(folder)]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        client = ModbusTcpClient("127.0.0.1", port=port, timeout=20, retries=0)
        try:
            deadline = time.monotonic() + 60
            while not client.connect():
                assert process.poll() is None, process.stderr.read()
                assert time.monotonic() < deadline
            yield client
        finally:
            client.close()
            process.send_signal(signal.SIGINT)
            assert process.wait(60) == 0


def udint(registers):
    return registers[0] << 16 | registers[1]


def test_over_modbus_on_the_real_clock(served):
    def count():
        return udint(served.read_input_registers(0, count=2).registers)

    def wait(condition):
        deadline = time.monotonic() + 60
        while not condition():
            assert time.monotonic() < deadline

    wait(lambda: count() >= 2)  # the program of task class 1 counts
    assert served.read_holding_registers(0, count=1).registers == [1]
    assert not served.write_register(0, 500).isError()
    assert served.read_holding_registers(3, count=1).registers == [500]
    wait(lambda: count() == 1000)  # in larger steps, up to the constant
    wait(lambda: udint(served.read_input_registers(2, count=2).registers) == 1000)
    assert served.write_registers(1, [0, 7]).isError()  # a CONSTANT
    assert udint(served.read_holding_registers(1, count=2).registers) == 1000
