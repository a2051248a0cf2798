"""The thesis' TCP server in Structured Text does as its twin in Python, cycle by cycle."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from plcsim.core.clock import VirtualClock
from plcsim.core.controller import Controller
from plcsim.core.tag import leaves
from plcsim.network import Address, Outcome, Socket, VirtualNetwork
from plcsim.network.virtual_host import VirtualHost
from plcsim.project.assembly import assemble, load
from plcsim.project.plc_toml import read_project
from plcsim.testing import Trace

PROGRAMS = Path(__file__).parents[2]
SERVER = Address("127.0.0.1", 22011)
NAMES = ("counter", "codex", "serv_ready", "recv_ready", "send_ready", "close_ready", "buffer",
         "ipAddr", "TcpOpen_1", "TcpServer_1", "TcpSend_1", "TcpClose_1", "TcpRecv_1")  # fmt: skip


@contextmanager
def running(project: str) -> Iterator[tuple[Controller, VirtualHost]]:
    clock = VirtualClock()
    host = VirtualNetwork(clock.now_ns).host("192.168.0.10")
    plc = assemble(load(read_project(PROGRAMS / project)), network=host, clock=clock)
    plc.boot()
    yield plc, host
    plc.shutdown()


def talk(plc: Controller, host: VirtualHost, data: bytes) -> bytes:
    """Return all that the server answers before it hangs up."""
    plc.run(cycles=20)
    client = connected(plc, host)
    client.send(data)
    answer = b""
    for _ in range(100):
        plc.run(cycles=1)
        received = client.recv(1000)
        answer += received.data
        if received.outcome is Outcome.CLOSED:
            break
    return answer


def connected(plc: Controller, host: VirtualHost) -> Socket:
    client = host.open("", 0).socket
    assert client is not None
    while client.connect(SERVER) is not Outcome.OK:
        plc.run(cycles=1)
    return client


def test_it_sends_its_buffer_back_and_hangs_up() -> None:
    with running("tcp_server_st") as (plc, host):
        assert talk(plc, host, b"hello") == b"hello" + bytes(95)


def trace_of(project: str) -> Trace:
    with running(project) as (plc, host):
        paths = [f"thesis_server.{name}" for name in NAMES]
        trace = Trace([leaf for path in paths for leaf in leaves(plc.tags.find(path))])
        plc.image.watchers.append(
            lambda each: trace.sample(plc.memory, each.number, each.cycles, each.release_ns)
        )
        talk(plc, host, b"as its twin")
        plc.run(cycles=50)
    return trace


def test_its_tags_are_those_of_its_twin_in_python() -> None:
    own, twin = trace_of("tcp_server_st"), trace_of("tcp_server")
    assert len(own) > 50
    # the twin's controller has another server beside it: other addresses, other numbers of sockets
    others = {"pIfAddr", "pData", "ident", "identclnt"}
    names = [tag.path.rpartition(".")[2] for tag in own.tags]
    places = [place for place, name in enumerate(names) if name not in others]
    changes = [[(row.time_ns, [row.raw[place] for place in places]) for row in trace.rows]
               for trace in (own, twin)]  # fmt: skip
    assert changes[0] == changes[1]
