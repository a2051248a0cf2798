import json
from dataclasses import replace

import pytest

from plcsim.modbus.map import Area, Point
from plcsim.modbus.map.point import point_from

WORD = Point("p.a", "hr", 0, 1, -1, "H", "ABCD", "rw", 4096, "H", 2)


@pytest.mark.parametrize(
    ("area", "digit", "registers", "writable"),
    [
        ("co", 0, False, True),
        ("di", 1, False, False),
        ("ir", 3, True, False),
        ("hr", 4, True, True),
    ],
)
def test_the_four_areas(area: str, digit: int, registers: bool, writable: bool) -> None:
    found = Area(area)
    assert (found.digit, found.has_registers, found.is_writable) == (digit, registers, writable)


@pytest.mark.parametrize(
    ("change", "plain"),
    [
        ({}, True),
        ({"code": "h"}, True),
        ({"kind": "f", "code": "f", "size": 4, "registers": 2}, True),
        ({"kind": "i", "code": "f", "size": 4, "registers": 2}, False),
        ({"code": "B", "size": 1}, False),
        ({"code": "?", "size": 1}, False),
        ({"bit": 3}, False),
        ({"scale": 0.1}, False),
        ({"offset_eu": 1.0}, False),
        ({"kind": "s", "code": "s", "size": 2}, False),
    ],
)
def test_a_plain_point_holds_the_bytes_of_its_variable(
    change: dict[str, object], plain: bool
) -> None:
    assert replace(WORD, **change).is_plain is plain  # type: ignore[arg-type]  # fields of the row


def test_limits_and_access() -> None:
    assert not WORD.is_limited
    assert replace(WORD, minimum=0.0).is_limited
    assert replace(WORD, values=(0, 1)).is_limited
    assert [replace(WORD, access=a).is_writable for a in ("ro", "rw", "wo")] == [False, True, True]


def test_a_point_survives_json() -> None:
    point = replace(WORD, maximum=9.5, scale=0.1, values=(1, 5))
    assert point_from(json.loads(json.dumps(point.to_json()))) == point
