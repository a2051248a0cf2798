import math
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.modbus.map import IllegalValue, Point
from plcsim.modbus.map.conversion import from_registers, to_registers, wire_order
from plcsim.modbus.map.point import ORDERS, REGISTERS


def point(kind: str, code: str, **more: object) -> Point:
    size = struct.calcsize("<" + code) if code != "s" else 10
    values: dict[str, object] = {
        "tag": "t", "area": "hr", "offset": 0, "registers": REGISTERS.get(kind, 5), "bit": -1,
        "kind": kind, "order": "ABCD", "access": "rw", "address": 4096, "code": code, "size": size,
    }  # fmt: skip
    return Point(**(values | more))  # type: ignore[arg-type]  # the fields of the row


def stored(code: str, value: float) -> bytes:
    return struct.pack("<" + code, value)


@pytest.mark.parametrize(
    ("order", "wire"),
    [("ABCD", "12345678"), ("CDAB", "56781234"), ("BADC", "34127856"), ("DCBA", "78563412")],
)
def test_the_four_orders_of_32_bits(order: str, wire: str) -> None:
    assert to_registers(point("I", "I", order=order), stored("I", 0x12345678)).hex() == wire


@pytest.mark.parametrize(
    ("order", "wire"),
    [
        ("ABCD", "0123456789abcdef"),
        ("CDAB", "cdef89ab45670123"),
        ("BADC", "23016745ab89efcd"),
        ("DCBA", "efcdab8967452301"),
    ],
)
def test_the_four_orders_of_64_bits(order: str, wire: str) -> None:
    assert to_registers(point("Q", "Q", order=order), stored("Q", 0x0123456789ABCDEF)).hex() == wire


@given(st.sampled_from([2, 4, 8]), st.sampled_from(ORDERS))
def test_every_order_undoes_itself(size: int, order: str) -> None:
    places = wire_order(size, order)
    assert [places[i] for i in places] == list(range(size))


RANGES = {"b": 8, "h": 16, "i": 32, "q": 64}


@given(st.data(), st.sampled_from("bBhHiIqQ"), st.sampled_from(ORDERS))
def test_an_integer_survives_registers_that_are_wide_enough(
    data: st.DataObject, code: str, order: str
) -> None:
    bits = RANGES[code.lower()]
    low = -(1 << bits - 1) if code.islower() else 0
    value = data.draw(st.integers(low, low + (1 << bits) - 1))
    kinds = [k for k in "hiq" if RANGES[k] >= bits]
    kind = data.draw(st.sampled_from(kinds))
    chosen = point(kind if code.islower() else kind.upper(), code, order=order)
    assert from_registers(chosen, to_registers(chosen, stored(code, value))) == stored(code, value)


@given(st.floats(width=32, allow_nan=False, allow_infinity=False), st.sampled_from(ORDERS))
def test_a_real_survives(value: float, order: str) -> None:
    for kind, code in (("f", "f"), ("d", "d"), ("d", "f")):
        chosen = point(kind, code, order=order)
        wire = to_registers(chosen, stored(code, value))
        assert from_registers(chosen, wire) == stored(code, value)


@given(st.binary(max_size=9).filter(lambda b: 0 not in b), st.sampled_from(ORDERS))
def test_a_string_survives_and_is_padded(text: bytes, order: str) -> None:
    chosen = point("s", "s", order=order)
    wire = to_registers(chosen, text + b"\0" + b"x" * (9 - len(text)))
    assert len(wire) == 10
    assert from_registers(chosen, wire) == text.ljust(10, b"\0")


def test_two_characters_share_a_register_the_first_in_the_high_byte() -> None:
    assert to_registers(point("s", "s"), b"AB\0") == b"AB" + bytes(8)
    assert to_registers(point("s", "s", order="BADC"), b"AB\0") == b"BA" + bytes(8)
    assert to_registers(point("s", "s", order="CDAB"), b"AB\0") == b"AB" + bytes(8)


def test_a_string_that_is_too_long_is_refused_and_a_long_one_cut_when_read() -> None:
    with pytest.raises(IllegalValue, match="10 characters"):
        from_registers(point("s", "s"), b"0123456789")
    assert to_registers(point("s", "s", registers=2), b"hello\0") == b"hell"


@pytest.mark.parametrize(
    ("wire", "value"), [(b"\0\0", b"\0"), (b"\0\1", b"\1"), (b"\x80\0", b"\1")]
)
def test_a_bool_in_a_register_is_any_bit(wire: bytes, value: bytes) -> None:
    assert from_registers(point("?", "?"), wire) == value
    assert from_registers(point("H", "?"), wire) == value
    assert to_registers(point("?", "?"), value) == (b"\0\1" if value == b"\1" else b"\0\0")


def test_scaling_goes_both_ways() -> None:
    chosen = point("h", "f", scale=0.1, offset_eu=-40.0)
    assert to_registers(chosen, stored("f", 25.0)) == (650).to_bytes(2, "big")
    assert struct.unpack("<f", from_registers(chosen, (650).to_bytes(2, "big")))[0] == 25.0
    number = point("H", "i", scale=10.0)
    assert from_registers(number, b"\0\x07") == stored("i", 70)


@pytest.mark.parametrize(
    ("value", "raw"), [(1e9, 32767), (-1e9, -32768), (math.nan, 0), (math.inf, 32767)]
)
def test_what_does_not_fit_shows_the_nearest_number(value: float, raw: int) -> None:
    chosen = point("h", "f", scale=0.1)
    assert to_registers(chosen, stored("f", value)) == raw.to_bytes(2, "big", signed=True)


def test_an_lreal_too_large_for_a_float32_shows_infinity() -> None:
    wire = to_registers(point("f", "d"), stored("d", -1e300))
    assert struct.unpack(">f", wire)[0] == -math.inf


@pytest.mark.parametrize("code", ["f", "d"])
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_number_that_is_not_finite_is_refused(code: str, value: float) -> None:
    for chosen in (point(code, code), point(code, code, minimum=0.0), point("f", "i")):
        wire = struct.pack(">" + chosen.kind, value)
        with pytest.raises(IllegalValue, match="finite"):
            from_registers(chosen, wire)


@pytest.mark.parametrize(("raw", "fits"), [(0, False), (5, True), (10, True), (11, False)])
def test_limits_hold_in_engineering_units(raw: int, fits: bool) -> None:
    chosen = point("H", "H", minimum=5, maximum=10)
    scaled = point("H", "f", scale=0.5, minimum=2.5, maximum=5)
    for one in (chosen, scaled):
        if fits:
            from_registers(one, raw.to_bytes(2, "big"))
        else:
            with pytest.raises(IllegalValue, match="outside its limits"):
                from_registers(one, raw.to_bytes(2, "big"))


def test_a_signed_limit_holds_on_unsigned_registers() -> None:
    chosen = point("H", "h", minimum=-5, maximum=10)
    assert from_registers(chosen, b"\xff\xff") == stored("h", -1)
    with pytest.raises(IllegalValue):
        from_registers(chosen, b"\x80\x00")


@pytest.mark.parametrize(
    ("kind", "code", "value"), [("H", "B", 256), ("h", "B", -1), ("i", "h", 40000), ("f", "b", 1e9)]
)
def test_a_value_the_variable_cannot_hold_is_refused(kind: str, code: str, value: float) -> None:
    with pytest.raises(IllegalValue, match="does not fit"):
        from_registers(point(kind, code), struct.pack(">" + kind, value))


def test_a_float64_too_large_for_a_real_is_refused() -> None:
    with pytest.raises(IllegalValue, match="does not fit"):
        from_registers(point("d", "f"), struct.pack(">d", 1e300))


any_point_with_a_scale = given(
    st.sampled_from("hHiIqQfd"),
    st.sampled_from("bBhHiIqQfd"),
    st.binary(min_size=8, max_size=8),
    st.floats(allow_nan=False, allow_infinity=False).filter(bool),
    st.floats(allow_nan=False, allow_infinity=False),
)


@any_point_with_a_scale
def test_whatever_is_written_with_a_scale_is_refused_or_a_finite_value(
    kind: str, code: str, wire: bytes, scale: float, offset: float
) -> None:
    scaled = point(kind, code, scale=scale, offset_eu=offset)
    data = wire[: 2 * scaled.registers]
    try:
        found = from_registers(scaled, data)
    except IllegalValue:
        return
    assert math.isfinite(struct.unpack("<" + code, found)[0])


@any_point_with_a_scale
def test_whatever_a_variable_holds_can_be_read_with_any_scale(
    kind: str, code: str, data: bytes, scale: float, offset: float
) -> None:
    scaled = point(kind, code, scale=scale, offset_eu=offset)
    assert len(to_registers(scaled, data[: scaled.size])) == 2 * scaled.registers


def test_a_value_that_the_scale_makes_infinite_is_refused() -> None:
    for code in "hfd":
        with pytest.raises(IllegalValue, match="inf is not a finite number"):
            from_registers(point("d", code, scale=1e300), struct.pack(">d", 1e300))
