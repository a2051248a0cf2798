"""Pictures: well formed for whatever is drawn."""

import xml.etree.ElementTree as ET

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.core.tag import Tag
from plcsim.testing.strategies import values_of
from plcsim.testing.svg import WIDTH, histogram, ticks, timing_diagram
from st_types import BOOL, INT, LREAL, STRING

TYPES = [BOOL, INT, LREAL, STRING(30)]


def elements(picture, name):
    return [e for e in ET.fromstring(picture).iter() if e.tag.endswith(name)]


@given(st.data())
def test_any_lanes_give_a_picture_inside_its_frame(data):
    lanes = []
    for place, data_type in enumerate(TYPES):
        times = sorted(data.draw(st.sets(st.integers(0, 10**9), max_size=8)))
        values = [data.draw(values_of(data_type)) for _ in times]
        lanes.append((Tag(f"p.v{place}", data_type, 0), list(zip(times, values, strict=True))))
    picture = timing_diagram(lanes, 10**9)
    for line in elements(picture, "polyline"):
        for point in line.get("points").split():
            assert 0 <= float(point.split(",")[0]) <= WIDTH


def test_without_lanes_there_is_still_a_picture():
    assert len(elements(timing_diagram([], 0), "svg")) == 1


@pytest.mark.parametrize("span", [1, 7, 10**6, 123_456_789, 10**12])
def test_ticks_are_round_and_few(span):
    found = ticks(17, 17 + span)
    assert len(found) <= 10
    assert all(17 <= tick <= 17 + span for tick in found)


def test_a_histogram_has_a_bar_for_each_order_and_the_limit():
    picture = histogram([(1_000, 50), (1_001, 10), (8_000, 3)], limit_ns=2_000)
    assert len([r for r in elements(picture, "rect") if r.get("class") == "bar"]) == 2
    assert len([li for li in elements(picture, "line") if li.get("class") == "limit"]) == 1


@pytest.mark.parametrize(
    ("bucket", "labels"),
    [
        (119, ["110 ns", "150 ns", "220 ns", "300 ns", "430 ns"]),
        (1_100_000, ["1 ms", "1.5 ms", "2.1 ms", "3 ms", "4.2 ms"]),
        (999, ["860 ns", "1.2 us", "1.7 us", "2.4 us", "3.4 us"]),
        (1, ["1 ns", "1 ns", "2 ns", "3 ns", "4 ns"]),
    ],
)
def test_the_labels_of_a_histogram_are_whole_and_inside(bucket, labels):
    texts = elements(histogram([(bucket, 1)], width=360), "text")
    assert [text.text for text in texts] == labels
    anchors = [(float(text.get("x")), text.get("text-anchor")) for text in texts]
    assert anchors[0] == (10, "start")
    assert anchors[-1] == (350, "end")
    assert {anchor for _, anchor in anchors[1:-1]} == {"middle"}


def test_an_empty_histogram():
    assert ET.fromstring(histogram([])).tag.endswith("svg")
