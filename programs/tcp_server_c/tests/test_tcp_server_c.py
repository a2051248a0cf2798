"""The server in C on the virtual clock and network, cycle by cycle beside the one in Python."""

from pathlib import Path

from plcsim.core.clock import VirtualClock
from plcsim.core.tag import leaves
from plcsim.network import Address, Outcome, Socket, VirtualNetwork
from plcsim.project.assembly import Application, assemble, load
from plcsim.project.plc_toml import read_project

HERE = Path(__file__).parents[1]
IN_C = load(read_project(HERE))
IN_PYTHON = load(read_project(HERE.with_name("tcp_server")))
SERVER = Address("127.0.0.1", 22011)

OTHERS = ("pIfAddr", "pIpAddr", "pData", "ident", "identclnt")
"""Members that hold PLC addresses, of the same variables at other places, and numbers given out.

The project in Python has another server, which takes numbers too.
"""

TEXTS = {"buffer": 100, "ipAddr": 10}
"""Bytes of what is an array in one language and a STRING in the other."""


class Cell:
    """A controller with a server, and a client that always does the same."""

    def __init__(self, application: Application) -> None:
        clock = VirtualClock()
        self.host = VirtualNetwork(clock.now_ns).host("192.168.0.10")
        self.plc = assemble(application, network=self.host, clock=clock)
        self.trace: list[dict[str, object]] = []

    def cycles(self, count: int) -> None:
        for _ in range(count):
            self.plc.run(cycles=1)
            self.trace.append(self.tags())

    def tags(self) -> dict[str, object]:
        """Return all tags of the program; texts and arrays of bytes as bytes."""
        found: dict[str, object] = {}
        for name, size in TEXTS.items():
            tag = self.plc.tags.find(f"thesis_server.{name}")
            found[name] = self.plc.memory.read(tag.address, size)
        for area in (each for each in self.plc.areas if each.path == "thesis_server"):
            for tag in leaves(area):
                name = tag.path.removeprefix("thesis_server.")
                if name.partition("[")[0] not in TEXTS and name.rpartition(".")[2] not in OTHERS:
                    found[name] = self.plc.tags.read(tag)
        return found

    def serve(self) -> bytes:
        """Connect, send, and return what comes back."""
        self.cycles(12)
        client: Socket | None = self.host.open("", 0).socket
        assert client is not None
        while client.connect(SERVER) is not Outcome.OK:
            self.cycles(1)
        self.cycles(9)
        client.send(b"hello")
        data = b""
        for _ in range(60):
            self.cycles(1)
            received = client.recv(200)
            data += received.data
            if received.outcome not in (Outcome.OK, Outcome.WOULD_BLOCK):
                break
        return data


def served(application: Application) -> tuple[bytes, list[dict[str, object]]]:
    cell = Cell(application)
    cell.plc.boot()
    return cell.serve(), cell.trace


def test_the_server_sends_its_buffer_back_and_hangs_up() -> None:
    data, trace = served(IN_C)
    assert data == b"hello" + bytes(95)
    assert trace[-1]["TcpClose_1.status"] == 0


def test_all_tags_are_those_of_the_server_in_python_in_every_cycle() -> None:
    in_c, in_python = served(IN_C), served(IN_PYTHON)
    assert in_c[0] == in_python[0]
    assert len(in_c[1]) == len(in_python[1])
    for cycle, (one, other) in enumerate(zip(in_c[1], in_python[1], strict=True)):
        assert one.keys() == other.keys()
        assert one == other, f"cycle {cycle}"
