"""Both servers on the virtual clock and network: exact, repeatable, without a real port."""

from itertools import pairwise
from pathlib import Path

from hypothesis import given, settings
from hypothesis import strategies as st

from plcsim.core.clock import VirtualClock
from plcsim.core.system import State
from plcsim.library.astcp import tcpERR_ALREADY_EXIST
from plcsim.library.astcp.idents import IdentTable
from plcsim.network import Address, Outcome, Socket, VirtualNetwork
from plcsim.project.assembly import assemble, load
from plcsim.project.plc_toml import read_project

APPLICATION = load(read_project(Path(__file__).parents[1]))
THESIS, ECHO = Address("127.0.0.1", 22011), Address("127.0.0.1", 22012)


class Cell:
    """A controller with both servers, and clients on the same virtual host."""

    def __init__(self) -> None:
        self.clock = VirtualClock()
        self.host = VirtualNetwork(self.clock.now_ns).host("192.168.0.10")
        self.plc = assemble(APPLICATION, network=self.host, clock=self.clock)

    def boot(self) -> "Cell":
        assert self.plc.boot() is State.RUN
        self.plc.run(cycles=10)
        return self

    def tag(self, path: str) -> object:
        return self.plc.tags.read(self.plc.tags.find(path))

    def open(self, ip: str = "", port: int = 0) -> Socket:
        socket = self.host.open(ip, port).socket
        assert socket is not None
        return socket

    def connect(self, server: Address) -> Socket:
        socket = self.open()
        for _ in range(20):
            if socket.connect(server) is Outcome.OK:
                return socket
            self.plc.run(cycles=1)
        raise AssertionError(f"no connection to {server}")

    def receive(self, socket: Socket, size: int, cycles: int = 100) -> bytes:
        """Run until ``size`` bytes are here, the connection ends, or the cycles are over."""
        data = b""
        for _ in range(cycles):
            received = socket.recv(65536)
            data += received.data
            if len(data) >= size or received.outcome not in (Outcome.OK, Outcome.WOULD_BLOCK):
                break
            self.plc.run(cycles=1)
        return data

    def send(self, socket: Socket, data: bytes) -> None:
        while data:
            data = data[socket.send(data).taken :]
            self.plc.run(cycles=1)


def test_the_thesis_server_sends_its_buffer_back_and_hangs_up() -> None:
    cell = Cell().boot()
    client = cell.connect(THESIS)
    cell.send(client, b"hello")
    assert cell.receive(client, 101) == b"hello" + bytes(95)
    assert client.recv(1).outcome is Outcome.CLOSED


def test_the_thesis_server_serves_one_client() -> None:
    cell = Cell().boot()
    first = cell.connect(THESIS)
    cell.send(first, b"hello")
    cell.receive(first, 101)
    second = cell.connect(THESIS)
    cell.send(second, b"hello")
    assert cell.receive(second, 1) == b""


def test_the_thesis_server_calls_a_block_in_every_third_cycle() -> None:
    cell = Cell()
    useful: list[int] = []
    before = [0]

    def watch(task_class: object) -> None:
        counter = cell.tag("thesis_server.counter")
        if before[0] == 2:
            assert counter == 0
            useful.append(cell.plc.classes[0].cycles)
        before[0] = int(str(counter))

    cell.plc.image.watchers.append(watch)
    cell.boot()
    cell.plc.run(cycles=20)
    assert useful[0] == 3
    assert {later - earlier for earlier, later in pairwise(useful)} == {3}


def test_a_port_in_use_is_a_status_for_the_program_and_tried_again() -> None:
    cell = Cell()
    blocker = cell.open("127.0.0.1", ECHO.port)
    blocker.listen(1)
    cell.boot()
    assert cell.tag("echo_server.status") == tcpERR_ALREADY_EXIST
    blocker.close()
    cell.plc.run(cycles=3)
    assert cell.tag("echo_server.status") == 0
    assert cell.plc.state is State.RUN


@given(st.lists(st.binary(min_size=1, max_size=3000), min_size=1, max_size=6))
@settings(max_examples=40, deadline=None)
def test_any_split_of_the_bytes_gives_the_same_echo(pieces: list[bytes]) -> None:
    cell = Cell().boot()
    client = cell.connect(ECHO)
    echo = b""
    for piece in pieces:
        cell.send(client, piece)
        echo += cell.receive(client, len(piece))
    assert echo == b"".join(pieces)


def test_fifty_clients_at_once_and_all_idents_come_back() -> None:
    cell = Cell().boot()
    listening = set(cell.plc.context.library(IdentTable).in_use())
    clients = [cell.connect(ECHO) for _ in range(50)]
    for number, client in enumerate(clients):
        cell.send(client, bytes([number]) * 2000)
    for number, client in enumerate(clients):
        assert cell.receive(client, 2000) == bytes([number]) * 2000
    for client in clients:
        client.close()
    cell.plc.run(cycles=10)
    assert cell.tag("echo_server.served") == 50
    assert set(cell.plc.context.library(IdentTable).in_use()) == listening


def test_a_thousand_clients_one_after_another() -> None:
    cell = Cell().boot()
    idents = len(cell.plc.context.library(IdentTable).in_use())
    for number in range(1000):
        client = cell.connect(ECHO)
        client.send(b"%04d" % number)
        assert cell.receive(client, 4) == b"%04d" % number
        client.close()
    cell.plc.run(cycles=5)
    assert cell.tag("echo_server.served") == 1000
    assert len(cell.plc.context.library(IdentTable).in_use()) == idents


def test_a_client_that_never_reads_or_resets_costs_only_its_own_slot() -> None:
    cell = Cell().boot()
    deaf = cell.connect(ECHO)
    for _ in range(200):
        deaf.send(bytes(4096))
        cell.plc.run(cycles=1)
    rude = cell.connect(ECHO)
    rude.send(b"x")
    rude.set_linger(0)
    rude.close()
    friend = cell.connect(ECHO)
    cell.send(friend, b"hello")
    assert cell.receive(friend, 5) == b"hello"
    assert cell.plc.state is State.RUN


def test_exit_closes_every_socket() -> None:
    cell = Cell().boot()
    client = cell.connect(ECHO)
    table = cell.plc.context.library(IdentTable)
    cell.plc.shutdown()
    assert table.in_use() == ()
    assert cell.receive(client, 1, cycles=1) == b""
