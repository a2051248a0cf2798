"""A client reads, subscribes and writes over OPC UA while the controller runs."""

import asyncio
import json
import os
import signal
import socket
import subprocess
import sys
import textwrap
import time
from contextlib import ExitStack, suppress
from itertools import groupby
from pathlib import Path

import pytest

pytest.importorskip("asyncua")
pytest.importorskip("argon2")
from asyncua import Client, ua

from plcsim.access import Role, Users
from plcsim.access.users import users_file
from tests.ports import free_port

FILES = {
    "plc.toml": """
        [plc]
        realtime = "off"
        watchdog = "100s"

        [task_class.1]
        cycle = "5ms"
        tolerance = "10s"
        programs = ["line"]

        [opcua]
        port = PORT
        sampling = "10ms"
    """,
    "Global.typ": """
        TYPE
            Mode : (OFF, SLOW, FAST := 7);
            Motor : STRUCT speed : REAL; on : BOOL; END_STRUCT;
        END_TYPE
    """,
    "Global.var": """
        VAR gCount : UDINT; gText : STRING[10] := 'abc'; END_VAR
        VAR CONSTANT LIMIT : INT := 5; END_VAR
    """,
    "tags.csv": "tag,area,offset,unit,min,max\nline.motors[1].speed,hr,0,rpm,0,3000\n",
    "line/Variables.var": """
        VAR
            motors : ARRAY[1..2] OF Motor;
            mode : Mode;
            grid : ARRAY[0..1,0..2] OF INT := [1,2,3,4,5,6];
            wait : TIME := T#1s500ms;
            doubled : REAL;
        END_VAR
    """,
    "line/cyclic.st": """
        PROGRAM _CYCLIC
            gCount := gCount + 1;
            doubled := 2 * motors[1].speed;
        END_PROGRAM
    """,
}


@pytest.fixture(scope="module")
def line(tmp_path_factory):
    """Run the project; yield its folder and the address of the server."""
    folder = tmp_path_factory.mktemp("opcua") / "line"
    port = free_port()
    for name, text in FILES.items():
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(textwrap.dedent(text).replace("PORT", str(port)))
    process = subprocess.Popen(
        [sys.executable, "-m", "plcsim", "run", str(folder)],
        stderr=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        text=True,
    )
    assert process.stderr is not None
    told = []
    while "opcua: serving" not in (text := process.stderr.readline()):
        assert text, told
        told.append(text)
    yield folder, f"opc.tcp://127.0.0.1:{port}", text
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=100)


def talk(line, act, **login):
    """Let a client act, again where it is told that the scan stands still."""

    async def run():
        client = Client(line[1], timeout=100)
        if login:
            client.set_user(login["user"])
            client.set_password(login["password"])
        async with client:
            index = await client.get_namespace_index("urn:plcsim:line")
            return await act(client, lambda path: client.get_node(ua.NodeId(path, index)))

    deadline = time.monotonic() + 100
    while True:
        with suppress(ua.uaerrors.BadNoCommunication):  # the host let the scan stand still
            return asyncio.run(run())
        assert time.monotonic() < deadline


def test_what_is_served_is_told(line):
    # 2 globals and a constant, 4 of the motors, mode, grid, wait, doubled
    assert "opcua: serving 11 variables on opc.tcp://127.0.0.1:" in line[2]


def test_structs_are_objects_and_values_have_their_types(line):
    async def act(_client, node):
        names = [
            (await child.read_browse_name()).Name for child in await node("::line").get_children()
        ]
        grid = await node("line.grid").read_data_value()
        wait = await node("line.wait").read_data_value()
        return names, grid.Value, wait.Value

    names, grid, wait = talk(line, act)

    assert names == ["motors", "mode", "grid", "wait", "doubled"]
    assert (grid.Value, grid.VariantType) == ([[1, 2, 3], [4, 5, 6]], ua.VariantType.Int16)
    assert (wait.Value, wait.VariantType) == (1500.0, ua.VariantType.Double)


def test_an_enumeration_tells_its_values(line):
    async def act(client, node):
        data_type = client.get_node(await node("line.mode").read_data_type())
        definition = await data_type.read_data_type_definition()
        return (await data_type.read_browse_name()).Name, {
            f.Name: f.Value for f in definition.Fields
        }

    assert talk(line, act) == ("Mode", {"OFF": 0, "SLOW": 1, "FAST": 7})


def test_unit_and_range_of_the_tag_map(line):
    async def act(_client, node):
        speed = node("line.motors[1].speed")
        found = {
            (await p.read_browse_name()).Name: await p.read_value()
            for p in await speed.get_properties()
        }
        return found["EngineeringUnits"].DisplayName.Text, found["EURange"]

    unit, limits = talk(line, act)
    assert (unit, limits.Low, limits.High) == ("rpm", 0, 3000)


def test_a_write_is_in_the_program_and_in_the_audit_log(line):
    async def act(_client, node):
        await node("line.motors[1].speed").write_value(21.5, ua.VariantType.Float)
        deadline = time.monotonic() + 100
        while await node("line.doubled").read_value() != 43 and time.monotonic() < deadline:
            await asyncio.sleep(0.01)
        return await node("line.doubled").read_value()

    assert talk(line, act) == 43
    entry = json.loads((line[0] / ".plcsim/opcua-audit.jsonl").read_text().splitlines()[-1])
    assert {key: entry[key] for key in ("user", "tag", "value", "before")} == {
        "user": "anonymous",
        "tag": "line.motors[1].speed",
        "value": 21.5,
        "before": 0.0,
    }


@pytest.mark.parametrize(
    ("path", "value", "kind", "error"),
    [
        ("LIMIT", 6, ua.VariantType.Int16, ua.uaerrors.BadNotWritable),
        ("line.motors[1].speed", 3001.0, ua.VariantType.Float, ua.uaerrors.BadOutOfRange),
        ("line.mode", 3, ua.VariantType.Int32, ua.uaerrors.BadOutOfRange),
        ("gText", "longer than ten", ua.VariantType.String, ua.uaerrors.BadOutOfRange),
        ("gCount", 1, ua.VariantType.Int32, ua.uaerrors.BadTypeMismatch),
        ("line.nothing", 1, ua.VariantType.Int32, ua.uaerrors.BadNodeIdUnknown),
        ("::line", 1, ua.VariantType.Int32, ua.uaerrors.BadUserAccessDenied),
    ],
)
def test_what_cannot_be_written_is_refused_with_its_reason(line, path, value, kind, error):
    async def act(_client, node):
        with pytest.raises(error):
            await node(path).write_value(value, kind)

    talk(line, act)


def test_a_client_is_no_administrator_of_the_address_space(line):
    async def act(client, node):
        with pytest.raises(ua.uaerrors.BadUserAccessDenied):
            await client.delete_nodes([node("line.mode")])
        with pytest.raises(ua.uaerrors.BadUserAccessDenied):
            await client.nodes.objects.add_variable(ua.NodeId("mine", 2), "mine", 1)

    talk(line, act)


def test_a_subscription_sees_every_change_and_ends_without_a_trace(line):
    class Seen:
        def __init__(self):
            self.values = []

        def datachange_notification(self, _node, value, _data):
            self.values.append(value)

    async def act(client, node):
        """Return the texts that were told; one is told again with how good it is."""
        seen = Seen()
        subscription = await client.create_subscription(20, seen)
        await subscription.subscribe_data_change([node("gText"), node("gCount")])
        for text in ("one", "two"):
            await node("gText").write_value(text, ua.VariantType.String)
            deadline = time.monotonic() + 100
            while text not in seen.values and time.monotonic() < deadline:
                await asyncio.sleep(0.01)
        await subscription.delete()
        told = [v for v in seen.values if isinstance(v, str)]
        return [text for text, _ in groupby(told)], len(seen.values)

    texts, count = talk(line, act)
    assert texts == ["abc", "one", "two"]
    assert count > 4


def test_users_of_the_project_have_their_roles(line):
    users = Users(users_file(line[0]))
    users.add("anna", Role.OPERATE, "secret words")
    users.add("panel", Role.LOOK, "only looking")

    async def write(_client, node):
        await node("line.motors[2].on").write_value(True, ua.VariantType.Boolean)

    try:
        talk(line, write, user="anna", password="secret words")
        with pytest.raises(ua.uaerrors.BadUserAccessDenied):
            talk(line, write, user="panel", password="only looking")
        with pytest.raises(ua.uaerrors.BadUserAccessDenied):
            talk(line, write, user="anna", password="wrong words")
        with pytest.raises(ua.uaerrors.BadUserAccessDenied):
            talk(line, write)
    finally:
        users.remove("anna")
        users.remove("panel")


def status(line):
    """Return cycles of the controller now."""

    async def act(_client, node):
        return await node("gCount").read_value()

    return talk(line, act)


def server_process(line):
    """Return the process id of the service that listens."""
    port = int(line[1].rpartition(":")[2])
    rows = Path("/proc/net/tcp").read_text().splitlines()[1:]
    listening = {row.split()[9] for row in rows
                 if row.split()[1].endswith(f":{port:04X}") and row.split()[3] == "0A"}  # fmt: skip
    for folder in Path("/proc").glob("[0-9]*"):
        for file in _files(folder):
            if file in {f"socket:[{inode}]" for inode in listening}:
                command = (folder / "cmdline").read_text()
                if "plcsim.opcua.service" in command:
                    return int(folder.name)
    raise AssertionError("nobody listens")


def _files(folder):
    try:
        return [str(file.readlink()) for file in (folder / "fd").iterdir()]
    except OSError:  # it has gone
        return []


def resident(pid):
    return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_beyond_the_limit_of_connections_a_client_is_told(line):
    pid = server_process(line)
    before, memory = status(line), resident(pid)
    address = ("127.0.0.1", int(line[1].rpartition(":")[2]))
    with ExitStack() as stack:
        clients = [stack.enter_context(socket.create_connection(address, 100)) for _ in range(1000)]
        for client in clients[64:]:
            answer = client.recv(100)
            assert answer[:4] == b"ERRF"
            assert int.from_bytes(answer[8:12], "little") == ua.StatusCodes.BadTcpServerTooBusy
        while len(_files(Path(f"/proc/{pid}"))) > 64 + 40:
            time.sleep(0.02)  # those that were refused are being closed
        assert resident(pid) - memory < 20_000_000
    eventually(lambda: status(line) > before)


def eventually(act):
    """Wait until it is so; it may be refused for a moment, while connections are being closed."""
    deadline = time.monotonic() + 100
    while True:
        with suppress(OSError, TimeoutError, ua.UaError):
            if act():
                return
        assert time.monotonic() < deadline


def test_a_chunk_of_100_mb_is_refused_before_it_has_come(line):
    before = status(line)
    with socket.create_connection(("127.0.0.1", int(line[1].rpartition(":")[2])), 100) as client:
        client.sendall(b"HELF" + (100_000_000).to_bytes(4, "little"))
        answer = client.recv(200)
        assert int.from_bytes(answer[8:12], "little") == ua.StatusCodes.BadTcpMessageTooLarge
        assert b"65535 at most" in answer
    eventually(lambda: status(line) > before)
