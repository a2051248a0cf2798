"""Whatever a program calls, and whatever its inputs are, it gets a documented status."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from plcsim.errors import PageFault
from plcsim.library import astcp
from plcsim.library.astcp import (
    TcpClient,
    TcpClose,
    TcpIoctl,
    TcpOpen,
    TcpOpenSsl,
    TcpRecv,
    TcpSend,
    TcpServer,
)
from plcsim.network import Limits
from st_types.derived import Section
from st_types.views import type_of

from .plc import CLIENT, MS, SERVER, Plc, World

BLOCKS = [TcpOpen, TcpOpenSsl, TcpServer, TcpClient, TcpClose, TcpSend, TcpRecv, TcpIoctl]
STATUSES = {v for k, v in vars(astcp).items() if k.startswith(("tcpERR_", "ERR_"))}
IOCTLS = [v for k, v in vars(astcp).items() if k.startswith(("tcpSO_", "tcpTCP_", "tcpID_"))]
NUMBERS = st.integers(0, 5) | st.sampled_from([8, 16, 100, 65_535, 2**31, 2**32 - 1])


class Station:
    """A controller with one instance of each block."""

    def __init__(self, plc: Plc) -> None:
        self.plc = plc
        self.blocks = [plc.new(block) for block in BLOCKS]
        texts = [plc.text(text) for text in (SERVER, CLIENT, "127.0.0.1", "", "no address")]
        self.pointers = [0, 1, plc.buffer, 0xFFFF_FFFF, *texts]

    def value(self, name: str, draw: st.DataObject) -> object:
        if name == "enable":
            return draw.draw(st.sampled_from([True, True, True, False]))
        if name.startswith("p") and not name.startswith("port"):
            return draw.draw(st.sampled_from(self.pointers))
        if name == "ident":
            return draw.draw(st.sampled_from([0, 99, *self.plc.idents.in_use()]))
        if name in ("port", "portserv"):
            return draw.draw(st.integers(0, 3))
        if name == "ioctl":
            return draw.draw(st.sampled_from([0, *(i for i in IOCTLS if isinstance(i, int))]))
        return draw.draw(NUMBERS)

    def call(self, draw: st.DataObject) -> None:
        block = draw.draw(st.sampled_from(self.blocks))
        if draw.draw(st.booleans()):
            for member in type_of(block).members:
                if member.section is Section.INPUT:
                    setattr(block, member.name, self.value(member.name, draw))
        before = self.plc.idents.in_use()
        try:
            block()
        except PageFault:
            assert self.plc.idents.in_use() == before
            return
        assert block.status in STATUSES
        assert len(self.plc.idents.in_use()) <= 4


@settings(max_examples=150, deadline=None)
@given(draw=st.data(), steps=st.lists(st.integers(0, 9), max_size=50))
def test_every_sequence_of_calls_ends_in_documented_statuses(
    draw: st.DataObject, steps: list[int]
) -> None:
    world = World(limits=Limits(sockets=6), idents=4)
    stations = [Station(world.server), Station(world.client)]
    for step in steps:
        if step == 9:
            world.pass_time(draw.draw(st.integers(1, 40_000)) * MS)
        elif step == 8:
            world.net.faults.reset(SERVER)
        else:
            stations[step % 2].call(draw)
    for station in stations:
        station.plc.context.restart()
    world.pass_time(10 * world.net.limits.fade_ns)
    world.net.settle()
    assert world.net.host(SERVER).socket_count == world.net.host(CLIENT).socket_count == 0
