"""Plain values of tags to messages and back."""

import math
from collections import Counter
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.errors import MessageValueError
from crosnode.messages import MessageTypes, Time
from crosnode.plc.conversion import ConversionContext, tag_conversion
from plcsim.core.errors import ConfigurationError
from st_types import (
    ARRAY,
    BOOL,
    DATE_AND_TIME,
    DINT,
    INT,
    LINT,
    LREAL,
    REAL,
    STRING,
    TIME,
    UDINT,
    WSTRING,
    Struct,
    var,
)
from st_types.types.values import decode, encode
from st_types.types.views import type_of

TYPES = MessageTypes()
CUTS: Counter[str] = Counter()
DEFINED = 0


class Stamp(Struct):
    sec = var(UDINT)
    nsec = var(UDINT)


class Header(Struct):
    stamp = var(Stamp)
    frame_id = var(STRING(8))


class JointState(Struct):
    """As plcsim types from-ros makes it, with fewer joints."""

    header = var(Header)
    name = var(ARRAY(STRING(8), (0, 2)))
    name_length = var(UDINT)
    position = var(ARRAY(LREAL, (0, 2)))
    position_length = var(UDINT)
    velocity = var(ARRAY(LREAL, (0, 1)))
    own = var(INT, 7)


class Point(Struct):
    x = var(LREAL)
    y = var(REAL)


class Polygon(Struct):
    points = var(ARRAY(Point, (1, 2)))


def defined(text: str) -> Any:
    global DEFINED  # noqa: PLW0603  # a type has one definition
    DEFINED += 1
    return TYPES.define(f"test/Type{DEFINED}", text)


def pair(data_type: Any, message_type: Any) -> Any:
    data_type = type_of(data_type) if isinstance(data_type, type) else data_type
    return tag_conversion(ConversionContext(TYPES, CUTS), message_type, data_type, "p.tag")


def through(data_type: Any, text: str, value: Any) -> Any:
    """Return a tag's value after its way through a message on the wire."""
    message_type = defined(text)
    both = pair(data_type, message_type)
    message = message_type.decode(bytes(message_type.encode(both.to_field(value))))
    zero = decode(data_type, bytes(data_type.size))
    return decode(data_type, encode(data_type, both.to_tag(message, zero)))


@given(st.integers(-(2**15), 2**15 - 1), st.floats(width=32), st.booleans())
def test_numbers(number: int, real: float, flag: bool) -> None:
    assert through(INT, "int16 data", number) == number
    assert through(LREAL, "float32 data", real) == pytest.approx(real, nan_ok=True, rel=0)
    assert through(BOOL, "bool data", flag) is flag


@given(st.text(st.characters(max_codepoint=255, min_codepoint=1), max_size=8))
def test_texts(text: str) -> None:
    assert through(STRING(8), "string data", text) == text
    assert through(WSTRING(8), "string data", text) == text


@given(st.integers(-(2**31), 2**31 - 1), st.integers(0, 2**32 - 1), st.integers(0, 2**62))
def test_times(duration_ms: int, date_s: int, time_ns: int) -> None:
    assert through(TIME, "duration data", duration_ms) == duration_ms
    assert through(DATE_AND_TIME, "time data", date_s) == date_s
    assert through(LINT, "time data", time_ns % 10**18) == time_ns % 10**18


def test_a_time_below_a_millisecond_is_cut() -> None:
    message_type = TYPES.message("std_msgs/Duration")
    message = message_type.new()
    message.data.nsecs = 1_999_999
    assert pair(TIME, message_type).to_tag(message, 0) == 1


@pytest.mark.parametrize("names", [("sec", "nsec"), ("secs", "nsecs")])
def test_a_structure_of_seconds_is_a_time(names: tuple[str, str]) -> None:
    seconds, rest = names
    struct = type("S", (Struct,), {seconds: var(UDINT), rest: var(UDINT), "more": var(INT)})
    both = pair(struct, TYPES.message("std_msgs/Time"))
    message = both.to_field({seconds: 5, rest: 6, "more": 1})
    assert message.data == Time(5, 6)
    before = {seconds: 0, rest: 0, "more": 1}
    assert both.to_tag(message, before) == {seconds: 5, rest: 6, "more": 1}


def test_what_from_ros_makes_goes_with_its_message() -> None:
    message_type = TYPES.message("sensor_msgs/JointState")
    both = pair(JointState, message_type)
    message = message_type.new(name=["a", "b"], position=[1.0, 2.0], velocity=[3.0])
    message.header.stamp, message.header.frame_id = Time(1, 2), "base"
    before = decode(type_of(JointState), bytes(type_of(JointState).size))
    before |= {"velocity": [8.0, 9.0], "own": 3}
    after = both.to_tag(message_type.decode(bytes(message_type.encode(message))), before)
    assert after == {
        "header": {"stamp": {"sec": 1, "nsec": 2}, "frame_id": "base"},
        "name": ["a", "b", ""],
        "name_length": 2,
        "position": [1.0, 2.0, 0.0],
        "position_length": 2,
        "velocity": [3.0, 9.0],
        "own": 3,
    }
    back = both.to_field(after)
    assert (back.name, back.position, back.velocity) == (["a", "b"], [1.0, 2.0], [3.0, 9.0])
    assert (back.header.stamp, back.header.frame_id) == (Time(1, 2), "base")


def test_more_elements_than_the_tag_holds_are_cut() -> None:
    message_type = TYPES.message("sensor_msgs/JointState")
    before = decode(type_of(JointState), bytes(type_of(JointState).size))
    after = pair(JointState, message_type).to_tag(message_type.new(position=[1.0] * 9), before)
    assert (after["position"], after["position_length"]) == ([1.0] * 3, 3)


def test_structures_in_an_array() -> None:
    message_type = TYPES.message("geometry_msgs/Polygon")
    both = pair(Polygon, message_type)
    value = {"points": [{"x": 1.0, "y": 2.0}, {"x": 3.0, "y": 4.0}]}
    message = message_type.decode(bytes(message_type.encode(both.to_field(value))))
    assert [(point.x, point.y, point.z) for point in message.points] == [(1, 2, 0), (3, 4, 0)]
    assert both.to_tag(message, {"points": [{"x": 0.0, "y": 0.0}] * 2}) == value


def test_fixed_arrays() -> None:
    assert through(ARRAY(INT, (0, 2)), "int16[3] data", [1, 2, 3]) == [1, 2, 3]
    with pytest.raises(ConfigurationError, match=r"ARRAY\[0..2\] OF INT.* int16\[4\]"):
        pair(ARRAY(INT, (0, 2)), defined("int16[4] data"))


def test_a_value_that_does_not_fit_is_left_to_the_encoder() -> None:
    message_type = TYPES.message("std_msgs/Float32")
    message = pair(LREAL, message_type).to_field(1e300)
    with pytest.raises(MessageValueError, match=r"std_msgs/Float32\.data: 1e\+300"):
        message_type.encode(message)
    assert math.isinf(pair(LREAL, message_type).to_tag(message_type.new(data=math.inf), 0.0))


@pytest.mark.parametrize(
    ("data_type", "text", "fault"),
    [
        (INT, "string data", r"p\.tag is INT, which does not go with string"),
        (STRING(3), "int32 data", r"STRING\[3\], which does not go with int32"),
        (INT, "int32[] data", r"does not go with int32\[\]"),
        (ARRAY(INT, (0, 1)), "int32 data", "does not go with int32"),
        (LREAL, "time data", "does not go with time"),
        (type_of(Point), "time data", "does not go with time"),
        (type_of(Point), "string data", "does not go with string"),
        (LREAL, "geometry_msgs/Vector3 data", "does not go with geometry_msgs/Vector3"),
        (type_of(JointState), "float64 position\nint8 q", r"p\.tag\.position is ARRAY"),
        (type_of(JointState), "Header header\nHeader position", r"p\.tag\.position is ARRAY"),
        (type_of(Point), "int8 a\nint8 b", r"no member of p\.tag is a field of .*: a, b"),
        (DINT, "int8 a\nint8 b", r"p\.tag is one value, .* has 2 fields"),
    ],
)
def test_what_can_never_fit(data_type: Any, text: str, fault: str) -> None:
    with pytest.raises(ConfigurationError, match=fault):
        pair(data_type, defined(text))


def test_what_is_longer_than_what_takes_it_is_counted() -> None:
    CUTS.clear()
    names = TYPES.message("sensor_msgs/JointState")

    class Two(Struct):
        name = var(ARRAY(STRING(3), (0, 1)))
        position = var(ARRAY(LREAL, (0, 1)))

    both = pair(Two, names)
    before = decode(type_of(Two), bytes(type_of(Two).size))
    both.to_tag(names.new(name=["abcd", "b", "c"], position=[1.0, 2.0]), before)
    assert CUTS == {"p.tag.name": 1, "p.tag.name[]": 1}
