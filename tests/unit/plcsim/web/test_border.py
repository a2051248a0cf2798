import json

from plcsim.core.memory import Memory
from plcsim.core.traffic import Topic, TopicEnds
from plcsim.library.astcp import TcpOpen, TcpRecv, TcpServer
from plcsim.library.astcp.idents import IdentTable
from plcsim.library.idents import Idents
from plcsim.network.protocol import Address, network_of
from plcsim.shared_image.events import EventKind
from plcsim.web.border import BorderReport

SPEED = Topic("/speed", "std_msgs/Float64", "", "", "/cell", True, False)


class Stream:
    def __init__(self):
        self.told = []

    def write(self, kind, time_ns, data):
        assert kind == EventKind.RECORD.value
        self.told.append(json.loads(data))


class FewIdents(Idents[str]):
    pass


def test_topics_and_idents_are_told_once_a_second_and_when_they_change(world):
    stream, report = Stream(), BorderReport(world.plc)
    report.connect(stream)
    speed = world.plc.context.traffic.number_of(SPEED)
    for told in world.plc.context.traffic.followers:
        told((speed, b"12345678"))
        told((speed, memoryview(b"1234")))
    world.plc.context.library(FewIdents).add("a socket")
    world.plc.run(cycles=500)
    assert stream.told == [
        {
            "topics": [["/cell", "/speed", "std_msgs/Float64", True, 2, 12, 0, []]],
            "idents": {"web": 1},
            "tcp": [],
        }
    ]
    world.plc.run(cycles=2500)
    assert len(stream.told) == 1
    report.count((speed, b"x"))
    world.plc.run(cycles=1100)
    assert [told["topics"][0][4] for told in stream.told] == [2, 3]


def test_the_pages_show_them(world):
    BorderReport(world.plc).connect(world.writer.stream_of("web"))
    speed = world.plc.context.traffic.number_of(SPEED)
    for told in world.plc.context.traffic.followers:
        told((speed, b"12345678"))
    world.plc.run(cycles=3)
    world.hub.read()
    assert world.hub.network()["topics"][0][1] == "/speed"


def test_losses_and_other_ends_of_topics_are_told_before_their_first_message(world):
    stream, report = Stream(), BorderReport(world.plc)
    report.connect(stream)
    world.plc.context.traffic.ends[SPEED] = lambda: TopicEnds(["/hmi", "/log"], 7)
    world.plc.run(cycles=2)
    (told,) = stream.told
    assert told["topics"] == [
        ["/cell", "/speed", "std_msgs/Float64", True, 0, 0, 7, ["/hmi", "/log"]]
    ]


def test_idents_are_told_with_their_peers_and_what_the_last_block_answered(world):
    stream, report = Stream(), BorderReport(world.plc)
    report.connect(stream)
    context = world.plc.context
    memory = Memory(64 * 1024)
    opening = memory.new(TcpOpen, context)
    opening(enable=True, port=4000)
    memory.new(TcpServer, context)(enable=True, ident=opening.ident)
    made = network_of(context).open("", 0).socket
    peer = context.library(IdentTable).give(made, Address("fd00::9", 1234))
    memory.new(TcpRecv, context)(enable=True, ident=peer)
    world.plc.run(cycles=2)
    assert stream.told[-1]["tcp"] == [
        [opening.ident, "", "TcpServer", "ERR_FUB_BUSY"],
        [peer, "[fd00::9]:1234", "TcpRecv", "tcpERR_PARAMETER"],
    ]
