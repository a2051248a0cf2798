import math
import struct

import pytest

from plcsim.web.service.values import json_value
from st_types import INT, LINT, LREAL, REAL, STRING, TIME, UDINT

from ..site import MODE, Axis


@pytest.mark.parametrize(
    ("data_type", "data", "value"),
    [
        (INT, struct.pack("<h", -7), -7),
        (REAL, struct.pack("<f", 0.1), 0.1),
        (LREAL, struct.pack("<d", 0.1), 0.1),
        (REAL, struct.pack("<f", math.nan), "nan"),
        (LREAL, struct.pack("<d", -math.inf), "-inf"),
        (LINT, struct.pack("<q", 2**53 + 1), str(2**53 + 1)),
        (UDINT, struct.pack("<I", 2**32 - 1), 2**32 - 1),
        (TIME, struct.pack("<i", 1500), "T#1s500ms"),
        (MODE, struct.pack("<i", 2), "MANUAL"),
        (MODE, struct.pack("<i", 9), "9"),
        (STRING(5), b"<b>\0\0\0", "<b>"),
    ],
)
def test_values_as_the_pages_show_them(data_type, data, value):
    assert json_value(data_type, data) == value


def test_a_struct_is_text_of_bounded_length():
    text = json_value(Axis._plc_type, bytes(8))
    assert text == "(speed := 0.0, count := 0)"


def test_watched_tags_follow_the_snapshot_and_are_forgotten(world):
    values, find = world.hub.values, world.hub.image.directory.find
    first = values.watch([find("p.count"), find("p.level")])
    second = values.watch([find("p.count")])
    assert second[0] is first[0]
    values.refresh()
    before, version = first[0].value, first[0].version
    assert (before, first[1].value) == (1, 1.5)
    world.plc.run(cycles=3)
    values.refresh()
    assert (first[0].value, first[0].version) == (before + 3, version + 1)
    assert first[1].version == 1  # its bytes have not changed
    values.leave(first)
    values.refresh()
    world.plc.run(cycles=1)
    values.refresh()
    assert second[0].value == before + 4
    values.leave(second)
    assert not values._watched
