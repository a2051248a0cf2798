"""Real Modbus clients read and write programs/tank."""

import json
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from pymodbus.client import ModbusTcpClient

PEERS = Path(__file__).parent / "peers"
TIMEOUT_S = 100.0


STOOD_STILL = re.compile(r"(device|server) failure|tim(ed |e)out|code: 4\b", re.IGNORECASE)
"""What clients say where the host let the scan or the service stand still for a moment."""


def output_of(*command: str | Path) -> str:
    """Return what a client printed; it must end with exit code 0, sooner or later."""
    deadline = time.monotonic() + TIMEOUT_S
    while True:
        done = subprocess.run(
            list(map(str, command)), capture_output=True, text=True, timeout=TIMEOUT_S, check=False
        )
        if done.returncode == 0:
            return done.stdout
        told = done.stdout + done.stderr
        assert STOOD_STILL.search(told), told
        assert time.monotonic() < deadline, told


def answer_of(act: Callable[[], Any]) -> Any:
    """Return what pymodbus was answered, asked again as long as the scan stands still."""
    deadline = time.monotonic() + TIMEOUT_S
    while (answer := act()).isError() and answer.exception_code == 4:
        assert time.monotonic() < deadline
    return answer


def tool(name: str) -> str:
    found = shutil.which(name)
    if found is None:
        pytest.skip(f"{name} is not installed; tests/interop/modbus/install.sh installs it")
    return found


def node_package(name: str) -> str:
    """Return node, where a package is there for it."""
    if not (PEERS / "node_modules" / name).is_dir():
        pytest.skip(f"{name} is not installed; tests/interop/modbus/install.sh installs it")
    return tool("node")


def mbpoll(port: int, *arguments: str) -> str:
    return output_of(tool("mbpoll"), "-m", "tcp", "-p", str(port), "-a", "1", *arguments)


def test_mbpoll(tank: Any) -> None:
    level = mbpoll(tank.port, "-t", "3:float", "-B", "-r", "2", "-c", "1", "-1", "127.0.0.1")
    assert 0 <= float(re.search(r"\[2\]:\s+(\S+)", level)[1]) <= 10  # type: ignore[index]
    swapped = mbpoll(tank.port, "-0", "-t", "3:float", "-r", "3", "-c", "1", "-1", "127.0.0.1")
    assert 0 <= float(re.search(r"\[3\]:\s+(\S+)", swapped)[1]) <= 10  # type: ignore[index]
    assert "Written 1 references" in mbpoll(tank.port, "-t", "4", "-r", "5", "127.0.0.1", "42")
    speed = mbpoll(tank.port, "-t", "4", "-r", "5", "-1", "127.0.0.1")
    assert re.search(r"\[5\]:\s+42", speed)
    mbpoll(tank.port, "-t", "0", "-r", "3", "127.0.0.1", "1")
    assert re.search(r"\[3\]:\s+1", mbpoll(tank.port, "-t", "0", "-r", "3", "-1", "127.0.0.1"))
    with pytest.raises(AssertionError, match="Illegal data value"):
        mbpoll(tank.port, "-t", "4", "-r", "5", "127.0.0.1", "101")


def test_libmodbus(tank: Any, tmp_path: Path) -> None:
    compiler, config = tool("gcc"), tool("pkg-config")
    if subprocess.run([config, "--exists", "libmodbus"], check=False).returncode:
        pytest.skip("libmodbus-dev is not installed; tests/interop/modbus/install.sh installs it")
    flags = output_of(config, "--cflags", "--libs", "libmodbus").split()
    program = tmp_path / "client"
    output_of(compiler, "-Wall", "-Werror", "-o", program, PEERS / "libmodbus_client.c", *flags)
    assert output_of(program, str(tank.port)).endswith("SUCCESS\n")


@pytest.mark.parametrize("package", ["modbus-serial", "jsmodbus"])
def test_node_clients(tank: Any, package: str) -> None:
    node = node_package(package)
    script = PEERS / f"{package.replace('-', '_')}_client.js"
    assert output_of(node, script, str(tank.port)).endswith("SUCCESS\n")


def test_pymodbus(tank: Any) -> None:
    client = ModbusTcpClient("127.0.0.1", port=tank.port)
    assert client.connect()
    kinds = client.DATATYPE
    answer = answer_of(lambda: client.read_input_registers(1, count=2))
    level = client.convert_from_registers(answer.registers, kinds.FLOAT32)
    assert 0 <= level <= 10
    asked = client.convert_to_registers(7.5, kinds.FLOAT32)
    assert not answer_of(lambda: client.write_registers(0, asked)).isError()
    assert answer_of(lambda: client.read_holding_registers(0, count=2)).registers == asked
    assert answer_of(lambda: client.read_holding_registers(5)).registers == [750]
    assert not answer_of(lambda: client.write_register(4, 12)).isError()
    assert not answer_of(lambda: client.write_coil(2, True)).isError()
    assert answer_of(lambda: client.read_coils(0, count=4)).bits[:4] == [True, False, True, False]
    assert answer_of(lambda: client.read_discrete_inputs(0, count=5)).bits[3] is False
    assert not answer_of(
        lambda: client.mask_write_register(address=14, and_mask=0xFFFE, or_mask=0)
    ).isError()
    answer = answer_of(
        lambda: client.readwrite_registers(
            read_address=4, read_count=1, write_address=4, values=[13]
        )
    )
    assert answer.registers == [13]
    text = answer_of(lambda: client.read_holding_registers(6, count=8)).registers
    assert client.convert_from_registers(text, kinds.STRING) == "water"
    assert answer_of(client.read_device_information).information[0] == b"plcsim"
    assert answer_of(lambda: client.write_register(4, 101)).exception_code == 3
    assert answer_of(lambda: client.read_holding_registers(9000)).exception_code == 2
    client.close()


def node_red_flow(tank: Any) -> list[dict[str, Any]]:
    """Return the exported flow; its values go to the console, and one write is added."""
    exported = output_of(
        sys.executable, "-m", "plcsim.cli.main", "tags", "export", tank.folder,
        "--format", "nodered",
    )  # fmt: skip
    nodes: list[dict[str, Any]] = json.loads(exported)
    for node in nodes:
        if node["type"] == "debug":
            node["console"] = True
    tab = next(node["id"] for node in nodes if node["type"] == "tab")
    server = next(node["id"] for node in nodes if node["type"] == "modbus-client")
    holding = {"dataType": "HoldingRegister", "adr": "4", "quantity": "1", "unitid": "1"}
    inject = {"id": "inject1", "type": "inject", "z": tab, "props": [{"p": "payload"}],
              "payload": "55", "payloadType": "num", "once": True, "onceDelay": 2,
              "repeat": "5", "wires": [["write1"]]}  # fmt: skip
    write = {"id": "write1", "type": "modbus-write", "z": tab, "server": server, **holding}
    return [*nodes, inject, write]


def test_node_red(tank: Any, tmp_path: Path) -> None:
    node = node_package("node-red-contrib-modbus")
    user = tmp_path / "node-red"
    user.mkdir()
    (user / "flows.json").write_text(json.dumps(node_red_flow(tank)))
    (user / "settings.js").write_text(
        "module.exports = {flowFile: 'flows.json', httpAdminRoot: false, httpNodeRoot: false,"
        f" nodesDir: [{json.dumps(str(PEERS / 'node_modules' / 'node-red-contrib-modbus'))}],"
        " logging: {console: {level: 'info'}}, uiPort: 0};"
    )
    log = tmp_path / "node-red.log"
    with log.open("w") as file:
        process = subprocess.Popen(
            [node, str(PEERS / "node_modules" / "node-red" / "red.js"), "--userDir", str(user),
             "--settings", str(user / "settings.js")],
            stdout=file, stderr=subprocess.STDOUT,
        )  # fmt: skip
        try:
            deadline = time.monotonic() + TIMEOUT_S
            while "control_pump_speed: 55" not in (text := log.read_text()):
                assert time.monotonic() < deadline, text
                assert process.poll() is None, text
                time.sleep(0.2)
        finally:
            process.terminate()
            process.wait(TIMEOUT_S)
    assert "control_batch: 'water'" in text
    assert "control_automatic: true" in text
