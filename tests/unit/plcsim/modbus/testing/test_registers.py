"""The HMI's side of registers: undoes what the server's side does, for every type and order."""

import struct
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.modbus.map import conversion
from plcsim.modbus.map.point import ORDERS, REGISTERS, Point
from plcsim.modbus.testing.registers import from_registers, to_registers
from plcsim.testing.errors import PlcTestError

PLAIN = Point("p.x", "hr", 0, 1, -1, "h", "ABCD", "rw", 0, "h", 2)
NUMBERS = {
    "h": st.integers(-(2**15), 2**15 - 1),
    "H": st.integers(0, 2**16 - 1),
    "i": st.integers(-(2**31), 2**31 - 1),
    "I": st.integers(0, 2**32 - 1),
    "q": st.integers(-(2**63), 2**63 - 1),
    "Q": st.integers(0, 2**64 - 1),
    "f": st.floats(width=32, allow_nan=False, allow_infinity=False),
    "d": st.floats(allow_nan=False, allow_infinity=False),
}


def point_of(kind, order="ABCD", **fields):
    size = 2 * REGISTERS[kind]
    made = replace(PLAIN, kind=kind, code=kind, registers=size // 2, size=size, order=order)
    return replace(made, **fields)


@given(st.data(), st.sampled_from(sorted(NUMBERS)), st.sampled_from(ORDERS))
def test_the_server_understands_what_the_hmi_writes_and_the_hmi_what_it_shows(data, kind, order):
    value = data.draw(NUMBERS[kind])
    point = point_of(kind, order)
    variable = struct.pack("<" + kind, value)
    assert conversion.from_registers(point, to_registers(point, value)) == variable
    assert from_registers(point, conversion.to_registers(point, variable)) == value


@given(st.text(st.characters(codec="latin-1", exclude_characters="\0"), max_size=8),
       st.sampled_from(ORDERS))  # fmt: skip
def test_texts_come_back_too(text, order):
    point = replace(PLAIN, kind="s", code="s", registers=4, size=9, order=order)
    variable = text.encode("latin-1").ljust(9, b"\0")
    assert conversion.from_registers(point, to_registers(point, text)) == variable
    assert from_registers(point, conversion.to_registers(point, variable)) == text


def test_a_scaled_value_is_shown_and_entered_in_engineering_units():
    point = point_of("H", scale=0.01, offset_eu=-10.0)
    assert to_registers(point, 2.5) == (1250).to_bytes(2)
    assert from_registers(point, (1250).to_bytes(2)) == pytest.approx(2.5)


def test_bits_and_bools():
    assert from_registers(replace(PLAIN, kind="?", bit=3), b"\0\x08") is True
    assert from_registers(replace(PLAIN, kind="?", bit=4), b"\0\x08") is False
    whole = replace(PLAIN, kind="?", code="?", size=1)
    assert to_registers(whole, True) == b"\0\1"
    assert from_registers(whole, b"\0\0") is False


@pytest.mark.parametrize(
    ("kind", "value"), [("h", 40_000), ("H", -1), ("f", 1e300), ("h", "text"), ("h", float("nan"))]
)
def test_what_does_not_fit_is_named(kind, value):
    with pytest.raises(PlcTestError, match=r"p\.x: .* does not fit its \d registers"):
        to_registers(point_of(kind), value)


@pytest.mark.parametrize("text", ["123456789", "€"])
def test_a_text_that_does_not_fit_is_named(text):
    with pytest.raises(PlcTestError, match="does not fit its 4 registers"):
        to_registers(replace(PLAIN, kind="s", registers=4), text)
