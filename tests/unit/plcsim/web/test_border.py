import json

from plcsim.core.traffic import Topic
from plcsim.library.idents import Idents
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
        {"topics": [["/cell", "/speed", "std_msgs/Float64", True, 2, 12]], "idents": {"web": 1}}
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
