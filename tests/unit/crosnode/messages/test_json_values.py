"""JSON of messages against the values and bytes that genpy gave (tests/data/ros1)."""

import json
from pathlib import Path

import pytest

from crosnode.errors import MessageValueError
from crosnode.messages import MessageTypes, from_json, to_json

DATA = Path(__file__).parents[3] / "data" / "ros1"
TYPES = MessageTypes([DATA / "packages"])
HALF = {"msg": "", "srv_request": "Request", "srv_response": "Response"}
WIRE = [json.loads(line) for line in (DATA / "wire.jsonl").read_text("utf-8").splitlines()]


@pytest.mark.parametrize("row", WIRE, ids=lambda row: f"{row['type']}-{row['variant']}")
def test_known_wire_bytes(row: dict[str, str]) -> None:
    message_type = TYPES.message(row["type"] + HALF[row["kind"]])
    encoded = message_type.encode(from_json(TYPES, message_type, row["value"]))
    assert encoded.hex() == row["hex"]
    decoded = to_json(TYPES, message_type, message_type.decode(bytes.fromhex(row["hex"])))
    assert json.dumps(decoded) == json.dumps(row["value"])


def through(text: str, value: object) -> object:
    types = MessageTypes()
    message_type = types.define("pkg/Type", text)
    data = message_type.encode(from_json(types, message_type, value))
    return to_json(types, message_type, message_type.decode(data))


def test_fields_left_out_have_defaults() -> None:
    assert through("int32 x\nHeader h\nuint8[2] a", {}) == {
        "x": 0,
        "h": {"seq": 0, "stamp": {"secs": 0, "nsecs": 0}, "frame_id": ""},
        "a": [0, 0],
    }


def test_special_floats() -> None:
    value = {"x": "NaN", "y": ["Infinity", "-Infinity", -0.0, 1]}
    assert repr(through("float32 x\nfloat64[] y", value)) == (
        "{'x': 'NaN', 'y': ['Infinity', '-Infinity', -0.0, 1.0]}"
    )


def test_extreme_integers_and_keywords() -> None:
    value = {"from": -(2**63), "u": [2**64 - 1], "flags": [True, False]}
    assert through("int64 from\nuint64[] u\nbool[] flags", value) == value


def test_base64_for_bytes() -> None:
    assert through("uint8[] x\nchar[2] y", {"x": "AP8=", "y": "YWI="}) == {
        "x": [0, 255],
        "y": [97, 98],
    }


@pytest.mark.parametrize(
    ("value", "fault"),
    [
        ([], r"pkg/Type: expected an object, got \[\]"),
        ({"z": 1}, "pkg/Type: no field 'z'"),
        ({"x": 1.5}, "pkg/Type.x: expected an integer"),
        ({"x": None}, "pkg/Type.x: expected an integer"),
        ({"f": "1"}, "pkg/Type.f: expected a number, got '1'"),
        ({"s": 1}, "pkg/Type.s: expected a string"),
        ({"a": 1}, "pkg/Type.a: expected a list"),
        ({"a": "?"}, "pkg/Type.a: neither a list nor base64"),
        ({"a": [256]}, "pkg/Type.a: 256 is out of range"),
        ({"t": {"secs": 1, "min": 2}}, "pkg/Type.t: no field 'min'"),
        ({"t": 1.5}, "pkg/Type.t: expected an object"),
        ({"h": [{"stamp": {"secs": -1}}]}, r"pkg/Type.h\[0\].stamp.secs: -1 is out of range"),
        ({"h": [{"seq": 1}, {"q": 1}]}, r"pkg/Type.h\[1\]: no field 'q'"),
    ],
)
def test_fault_names_the_field(value: object, fault: str) -> None:
    with pytest.raises(MessageValueError, match=fault):
        through("int32 x\nfloat64 f\nstring s\nuint8[] a\ntime t\nstd_msgs/Header[] h", value)
