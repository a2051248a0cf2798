"""node-opcua, a client that shares nothing with our server's library, works with programs/tank."""

import json
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("asyncua")
pytest.importorskip("argon2")

from plcsim.access import Role, Users
from plcsim.access.users import users_file
from tests.ports import free_port

HERE = Path(__file__).parent
TANK = HERE.parents[2] / "programs" / "tank"

if not (HERE / "node_modules" / "node-opcua-client").is_dir():
    pytest.skip(
        "node-opcua is not installed; run tests/interop/opcua/install.sh", allow_module_level=True
    )


@pytest.fixture(scope="module")
def tank(tmp_path_factory):
    """Run the tank with OPC UA; yield its folder and the address of the server."""
    folder = Path(shutil.copytree(TANK, tmp_path_factory.mktemp("opcua") / "tank"))
    port = free_port()
    file = folder / "plc.toml"
    text = file.read_text().replace("port = 1502", f"port = {free_port()}")
    file.write_text(f"{text}\n[opcua]\nport = {port}\n")
    process = subprocess.Popen(
        [sys.executable, "-m", "plcsim", "run", str(folder)],
        stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True,
    )  # fmt: skip
    assert process.stderr is not None
    while "opcua: serving" not in (text := process.stderr.readline()):
        assert text
    yield folder, f"opc.tcp://127.0.0.1:{port}"
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=100)


def client(tank, *arguments):
    command = ["node", "client.js", tank[1], *arguments]
    done = subprocess.run(
        command, cwd=HERE, capture_output=True, text=True, timeout=120, check=False
    )
    (line,) = [each for each in done.stdout.splitlines() if each.startswith("{")]
    return json.loads(line)


def last_write(tank):
    return json.loads((tank[0] / ".plcsim/opcua-audit.jsonl").read_text().splitlines()[-1])


@pytest.mark.parametrize("security", ["None", "Basic256Sha256", "Aes256_Sha256_RsaPss"])
def test_it_browses_reads_subscribes_and_writes(tank, security):
    found = client(tank, security)

    assert "setpoint" in found["control"]
    assert found["level"][0] == "Float"
    assert found["level"][2] == "Good"
    assert found["written"] == "Good"
    assert found["seen"][-1] == 6.5
    assert (found["mistyped"], found["constant"]) == ("BadTypeMismatch", "BadNotWritable")
    assert (last_write(tank)["tag"], last_write(tank)["value"]) == ("control.setpoint", 6.5)


def test_with_name_and_password(tank):
    users = Users(users_file(tank[0]))
    users.add("anna", Role.OPERATE, "secret words")
    try:
        assert client(tank, "Basic256Sha256", "anna", "secret words")["written"] == "Good"
        assert last_write(tank)["user"] == "anna"
        assert "BadUserAccessDenied" in client(tank, "None", "anna", "wrong")["error"]
        assert "BadUserAccessDenied" in client(tank, "None")["error"]
    finally:
        users.remove("anna")
