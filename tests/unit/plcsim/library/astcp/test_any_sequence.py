"""Whatever a program calls, and whatever its inputs are, it gets a documented status."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from plcsim.core.errors import PageFault
from plcsim.library import astcp
from plcsim.library.astcp import (
    ERR_FUB_BUSY,
    TcpClient,
    TcpClose,
    TcpIoctl,
    TcpOpen,
    TcpOpenSsl,
    TcpRecv,
    TcpSend,
    TcpServer,
)
from plcsim.network import WireLimits
from st_types.types.derived import Section
from st_types.types.views import type_of

from .plc import CLIENT, MS, PORT, SERVER, Plc, World

if TYPE_CHECKING:
    from plcsim.library.astcp.block import AsTcpBlock

# What makes and uses connections stands more often than what ends them.
BLOCKS = [*(TcpOpen, TcpServer, TcpClient, TcpSend, TcpRecv, TcpIoctl) * 2, TcpClose, TcpOpenSsl]
STATUSES = {v for k, v in vars(astcp).items() if k.startswith(("tcpERR_", "ERR_"))}
IOCTLS = [
    value
    for name, value in vars(astcp).items()
    if name.startswith(("tcpSO_", "tcpTCP_", "tcpID_")) and isinstance(value, int)
]
WILD = [1, 0xFFFF_FFFF]
NUMBERS = {
    "enable": [True] * 9 + [False],
    "ioctl": [0, *IOCTLS],
    "port": [0, PORT],
    "portserv": [0, 1, PORT, PORT, PORT],
    "options": [0, 1, 1, 2],
    "flags": [0, 0, 0, 1, 2, 4, 8],
    "how": [0, 1, 3, 4],
    "backlog": [0, 1, 2**32 - 1],
    "datalen": [0, 4, 4, 8, 500, 2**32 - 1],
    "datamax": [0, 1, 10, 500, 2**32 - 1],
    "sslCfgIdent": [0],
}


class Station:
    """A controller with one instance of each block."""

    def __init__(self, plc: Plc) -> None:
        self.plc = plc
        self.blocks = {block: plc.new(block) for block in BLOCKS}
        peers = [plc.text(SERVER), plc.text(CLIENT), plc.text("127.0.0.1")]
        self.choices = NUMBERS | {
            "pIfAddr": [0, 0, 0, plc.text(""), plc.text("no address"), *WILD],
            "pServer": [*peers * 3, plc.text("no address"), 0, *WILD],
            "pIpAddr": [0, plc.buffer, *WILD],
            "pData": [*[plc.buffer] * 9, 0, *WILD],
        }

    def call(self, kind: type[AsTcpBlock], draw: st.DataObject) -> None:
        block = self.blocks[kind]
        before = self.plc.idents.in_use()
        if draw.draw(st.booleans()) or block.status != ERR_FUB_BUSY:
            choices = self.choices | {"ident": [*before * 5, 0, 99]}
            for member in type_of(block).members:
                if member.section is Section.INPUT:
                    value = draw.draw(st.sampled_from(choices[member.name]))
                    setattr(block, member.name, value)
        try:
            block()
        except PageFault:
            assert self.plc.idents.in_use() == before
            return
        assert block.status in STATUSES
        assert len(self.plc.idents.in_use()) <= 6


@settings(max_examples=100, deadline=None, suppress_health_check=[HealthCheck.large_base_example])
@given(
    draw=st.data(),
    steps=st.lists(
        st.tuples(st.integers(0, 1), st.sampled_from([*BLOCKS, "wait", "wait", "reset"])),
        min_size=30,
        max_size=60,
    ),
)
def test_every_sequence_of_calls_ends_in_documented_statuses(
    draw: st.DataObject, steps: list[tuple[int, object]]
) -> None:
    world = World(limits=WireLimits(sockets=8, send_buffer=300, receive_buffer=300), idents=6)
    world.pair()
    stations = [Station(world.server), Station(world.client)]
    for which, step in steps:
        if step == "wait":
            world.pass_time(draw.draw(st.sampled_from([MS, 100 * MS, 80_000 * MS])))
        elif step == "reset":
            world.net.faults.reset(SERVER)
        else:
            stations[which].call(step, draw)
    for station in stations:
        station.plc.context.restart()
    world.pass_time(10 * world.net.limits.fade_ns)
    world.net.settle()
    assert world.net.host(SERVER).socket_count == world.net.host(CLIENT).socket_count == 0
