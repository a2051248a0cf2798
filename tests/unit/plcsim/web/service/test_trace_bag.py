"""A trace as a bag: every sample at its time, read by rosbags as any other bag."""

import struct

import pytest

from plcsim.core.errors import PlcError
from plcsim.core.tag import Tag
from plcsim.recorder.bag.reading import open_bag
from plcsim.web.service import trace_bag
from plcsim.web.service.trace_bag import CYCLE, KeptSamples, write_bag
from st_types import BOOL, LINT, REAL

from ..site import MODE, Socket, request

TAGS = [Tag("cell.speed", REAL, 100), Tag("cell.on", BOOL, 104), Tag("cell.axes[2].far", LINT, 108)]
EPOCH_NS = 1_700_000_000_000_000_000


def data(cycle):
    return struct.pack("<f?q", cycle / 2, cycle % 2, cycle - (1 << 60))


def kept(count):
    made = KeptSamples(13)
    for cycle in range(1, count + 1):
        made.add(cycle * 1_000_000, cycle, data(cycle))
    return made


def messages(path):
    with open_bag(path) as bag:
        return [(m.topic, m.type_name, m.time_ns, m.data) for m in bag.messages()]


def test_every_variable_is_a_topic_and_every_sample_a_message(tmp_path):
    path = tmp_path / "trace.bag"
    write_bag(path, TAGS, kept(3), EPOCH_NS)
    found = messages(path)
    assert len(found) == 3 * 4
    at_2 = {topic: (kind, body) for topic, kind, ns, body in found if ns == EPOCH_NS + 2_000_000}
    assert at_2 == {
        CYCLE: ("std_msgs/msg/UInt64", (2).to_bytes(8, "little")),
        "/cell/speed": ("std_msgs/msg/Float32", struct.pack("<f", 1.0)),
        "/cell/on": ("std_msgs/msg/Bool", b"\0"),
        "/cell/axes_2/far": ("std_msgs/msg/Int64", struct.pack("<q", 2 - (1 << 60))),
    }


def test_the_oldest_samples_go_where_there_is_no_room(monkeypatch):
    monkeypatch.setattr(trace_bag, "MOST_BYTES", 100 * (16 + 13))
    found = kept(250)
    cycles = [cycle for _, cycle, _ in found.rows()]
    assert 75 <= len(found) == len(cycles) <= 100
    assert cycles == list(range(251 - len(cycles), 251))


def test_a_trace_without_samples_is_no_bag(tmp_path):
    with pytest.raises(PlcError, match="no samples"):
        write_bag(tmp_path / "trace.bag", TAGS, kept(0), EPOCH_NS)
    assert list(tmp_path.iterdir()) == []


def test_a_disk_that_is_full_is_told(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(PlcError, match="cannot be made"):
        write_bag(tmp_path / "file" / "trace.bag", TAGS, kept(1), EPOCH_NS)


def test_a_browser_gets_its_trace_while_it_runs_and_after_its_end(world, tmp_path):
    async def act():
        async with Socket(world) as socket:
            answer = (await socket.ask("trace", tags=["p.count", "p.mode"]))["ok"]
            await socket.data()
            running = await request(world, "POST", "/trace.bag", {"key": answer["key"]})
            await socket.ask("untrace", number=answer["number"])
            for _ in range(3):  # of those that have ended, some are kept
                (await socket.ask("trace", tags=["p.count"]))["ok"]
        ended = await request(world, "POST", "/trace.bag", {"key": answer["key"]})
        gone = await request(world, "POST", "/trace.bag", {"key": 99})
        other = {"origin": "http://evil.example"}
        foreign = await request(world, "POST", "/trace.bag", {"key": 1}, headers=other)
        return running, ended, gone, foreign

    running, ended, gone, foreign = world.do(act)
    assert (running.status, ended.status, gone.status, foreign.status) == (200, 200, 400, 403)
    assert "not kept" in gone.json()["error"]
    path = tmp_path / "trace.bag"
    path.write_bytes(ended.body)
    counts = [struct.unpack("<I", m[3])[0] for m in messages(path) if m[0] == "/p/count"]
    assert counts == list(range(counts[0], counts[0] + len(counts)))
    assert {m[1] for m in messages(path) if m[0] == "/p/mode"} == {"std_msgs/msg/Int32"}
    assert MODE.size == 4
