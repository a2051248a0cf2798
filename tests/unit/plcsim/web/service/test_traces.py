import struct

import numpy as np
import pytest

from plcsim.core.errors import PlcError
from plcsim.core.tag import Tag
from plcsim.shared_image.samples import Sample
from plcsim.web.service import traces
from plcsim.web.service.traces import LiveTrace, code_of
from st_types import BOOL, INT, LREAL, REAL, SINT, STRING, TIME, UDINT
from st_types.types.derived import EnumerationType, SubrangeType

from ..site import MODE, Axis, Socket

TAGS = [Tag("a", INT, 100), Tag("b", BOOL, 102), Tag("c", REAL, 104)]


def sample(cycle, number=17):
    data = struct.pack("<h?f", cycle, cycle % 2, cycle / 2)
    return Sample(number, 1, cycle, data)


def columns_of(message):
    number, count, columns, lost = struct.unpack_from("<IIII", message)
    table = np.frombuffer(message, "<f8", offset=16).reshape(columns + 2, count)
    return number, lost, table.tolist()


def test_samples_become_columns_of_numbers():
    trace = LiveTrace(17, TAGS)
    assert trace.message() is None
    for cycle in (5, 6, 7):
        trace.take(sample(cycle), cycle * 1_000_000)
    number, lost, table = columns_of(trace.message())
    assert (number, lost) == (17, 0)
    assert table == [[0.005, 0.006, 0.007], [5, 6, 7], [5, 6, 7], [1, 0, 1], [2.5, 3, 3.5]]
    assert trace.message() is None


def test_what_is_missing_is_counted(monkeypatch):
    trace = LiveTrace(17, TAGS)
    for cycle in (1, 2, 5):
        trace.take(sample(cycle), 0)
    assert trace.lost == 2
    monkeypatch.setattr(traces, "MOST_WAITING", 4)
    for cycle in (6, 7, 8):
        trace.take(sample(cycle), 0)
    _, lost, table = columns_of(trace.message())
    assert (lost, table[1]) == (4, [5, 6, 7, 8])


@pytest.mark.parametrize(
    ("data_type", "code"),
    [(BOOL, "<B"), (UDINT, "<I"), (LREAL, "<d"), (TIME, "<i"), (MODE, "<i"),
     (EnumerationType("Gear", {"REVERSE": -1, "NEUTRAL": 0}, base=SINT), "<b"),
     (SubrangeType("Percent", INT, 0, 100), "<h")],
)  # fmt: skip
def test_what_has_a_number_can_be_drawn(data_type, code):
    assert np.dtype(code_of(data_type)).itemsize == data_type.size
    assert code_of(data_type) == code


@pytest.mark.parametrize("data_type", [STRING(8), Axis._plc_type])
def test_what_has_none_is_refused(data_type):
    with pytest.raises(PlcError, match="cannot be traced"):
        LiveTrace(17, [Tag("a", data_type, 100)])


def test_a_browser_gets_every_cycle_until_it_ends_the_trace(world):
    async def act():
        async with Socket(world) as socket:
            assert "1 to 32" in (await socket.ask("trace", tags=[]))["error"]
            assert "STRING" in (await socket.ask("trace", tags=["p.name"]))["error"]
            answer = (await socket.ask("trace", tags=["p.count", "p.running"]))["ok"]
            assert answer == {"number": 17, "key": 1, "class": 1}
            counts = []
            while len(counts) < 300:
                number, lost, table = columns_of(await socket.data())
                assert (number, lost) == (17, 0)
                counts += table[2]
            assert counts == [counts[0] + at for at in range(len(counts))]
            for _ in range(3):
                await socket.ask("trace", tags=["p.count"])
            assert "4 traces at most" in (await socket.ask("trace", tags=["p.count"]))["error"]
            await socket.ask("untrace", number=17)
            assert sorted(world.hub.traces) == [18, 19, 20]

    world.do(act)
    assert world.hub.traces == {}
    world.plc.run(cycles=2)
    assert not any(world.writer._samplers)
