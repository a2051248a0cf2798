"""Functions written for a type: what nests, what repeats, what takes no bytes."""

import struct

import pytest

from crosnode.errors import DecodeError
from crosnode.messages.compiled import INLINE, MAX_EMPTY

from .test_codec import codec_of


def test_variable_array_of_nothing_is_read_up_to_a_limit() -> None:
    """Four bytes on the wire could otherwise ask for four thousand million objects."""
    codec = codec_of(Nothing="", Nested="Nothing n\nNothing[3] m\nint8[0] k", Type="Nested[] x")
    message = codec.decode("pkg/Type", struct.pack("<I", 3))
    assert len(message.x) == 3
    assert codec.encode("pkg/Type", message) == struct.pack("<I", 3)
    assert len(codec.decode("pkg/Type", struct.pack("<I", MAX_EMPTY)).x) == MAX_EMPTY
    with pytest.raises(DecodeError, match="pkg/Type: array of 65537 elements at byte 4"):
        codec.decode("pkg/Type", struct.pack("<I", MAX_EMPTY + 1))


def test_a_message_of_many_fields_is_written_by_functions_of_its_parts() -> None:
    wide = "".join(f"float64 f{number}\n" for number in range(INLINE))
    codec = codec_of(Wide=wide, Type="Wide one\nint8 between\nWide[] more\nstring last")
    message = codec.decode("pkg/Type", bytes(8 * INLINE + 1 + 4 + 4))
    message.one.f0, message.between, message.last = 0.5, 3, "x"
    message.more = [message.one, message.one]
    data = codec.encode("pkg/Type", message)
    one = struct.pack(f"<d{8 * (INLINE - 1)}x", 0.5)
    assert data == one + b"\3\2\0\0\0" + one + one + b"\1\0\0\0x"
    assert codec.decode("pkg/Type", data) == message


def test_arrays_of_arrays_of_arrays() -> None:
    texts = {"T0": "int8 x"} | {f"T{n}": f"T{n - 1}[] a\nint8 y" for n in range(1, 30)}
    codec = codec_of(**texts)
    name, data = "pkg/T29", b"\7" + b"\5" * 29
    data = b"\1\0\0\0" * 29 + data
    message = codec.decode(name, data)
    assert codec.encode(name, message) == data
    for _ in range(29):
        assert message.y == 5
        (message,) = message.a
    assert message.x == 7


def test_a_type_of_very_many_fields_does_not_grow_with_its_nesting() -> None:
    texts = {"T0": "int8 x"} | {f"T{n}": f"T{n - 1} a\nT{n - 1} b" for n in range(1, 12)}
    codec = codec_of(**texts)
    assert codec.encode("pkg/T11", codec.decode("pkg/T11", bytes(2**11))) == bytes(2**11)
