"""Messages to bytes and back, and what is refused on either way."""

import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.errors import DecodeError, DefinitionError, MessageValueError
from crosnode.messages.codec import MAX_FIXED, Codec
from crosnode.messages.definition import parse_message
from crosnode.messages.message import Message
from crosnode.messages.values import Duration, Time


def codec_of(**texts: str) -> Codec:
    codec = Codec()
    for base, text in texts.items():
        codec.add(parse_message(f"pkg/{base}", text))
    return codec


def new(codec: Codec, text: str, **values: object) -> Message:
    return codec.add(parse_message("pkg/Type", text))(**values)


def test_byte_order_and_signs() -> None:
    codec = codec_of()
    message = new(codec, "byte a\nchar b\nuint16 c\ntime t\nduration d")
    message.a, message.b, message.c = -1, 255, 0x0102
    message.t, message.d = Time(2**32 - 1, 999_999_999), Duration(-(2**31), -1)
    data = bytes(codec.encode("pkg/Type", message))
    assert data == struct.pack("<bBHIIii", -1, 255, 0x0102, 2**32 - 1, 999_999_999, -(2**31), -1)
    assert codec.decode("pkg/Type", data) == message


def test_keyword_fields() -> None:
    codec = codec_of()
    message = new(
        codec, "int32 from\nint32 self\nint32 cls\nint32 pos", from_=1, self=2, cls=3, pos=4
    )
    assert bytes(codec.encode("pkg/Type", message)) == struct.pack("<4i", 1, 2, 3, 4)


def test_empty_message() -> None:
    codec = codec_of(Type="int32 ONLY_A_CONSTANT=1")
    assert bytes(codec.encode("pkg/Type", codec.decode("pkg/Type", b""))) == b""


@pytest.mark.parametrize("text", ["int32[0] x", "string[0] x", "Inner[0] x"])
def test_fixed_array_of_nothing(text: str) -> None:
    codec = codec_of(Inner="int32 x", Type=text)
    assert bytes(codec.encode("pkg/Type", codec.decode("pkg/Type", b""))) == b""


def test_lists_are_coerced_and_stay_lists() -> None:
    codec = codec_of(Inner="int16[] y", Type="float64[] x\nInner[] inner\nInner one")
    message = codec.decode("pkg/Type", bytes(12))
    inner = codec.decode("pkg/Inner", bytes(4))
    inner.y = [1, -1]
    message.x, message.inner, message.one = [1, 2], [inner], inner
    data = bytes(codec.encode("pkg/Type", message))
    assert data == struct.pack("<I2dIIhhIhh", 2, 1.0, 2.0, 1, 2, 1, -1, 2, 1, -1)
    assert message.x == [1, 2]
    assert message.inner[0].y == [1, -1]


def test_bytes_for_uint8_array() -> None:
    codec = codec_of(Type="uint8[] data")
    message = codec.decode("pkg/Type", bytes(4))
    message.data = b"\x01\x02"
    assert bytes(codec.encode("pkg/Type", message)) == b"\x02\0\0\0\x01\x02"


def test_decoded_arrays_do_not_hold_the_receive_buffer() -> None:
    codec = codec_of(Type="uint8[] data")
    buffer = bytearray(b"\x02\0\0\0\x01\x02")
    message = codec.decode("pkg/Type", buffer)
    buffer.clear()  # would raise BufferError while an array views it
    assert message.data.tolist() == [1, 2]


@pytest.mark.parametrize(
    ("values", "fault"),
    [
        ({"n": 256}, r"pkg/Type\.n: 256 is out of range of uint8"),
        ({"n": "1"}, r"pkg/Type\.n: expected an integer, got str"),
        ({"f": 1e300}, r"pkg/Type\.f: 1e\+300 is out of range of float32"),
        ({"s": b"x"}, r"pkg/Type\.s: expected a string"),
        ({"s": "\ud800"}, r"pkg/Type\.s: .*surrogates"),
        ({"t": Time(-1, 0)}, r"pkg/Type\.t\.secs: -1 is out of range of uint32"),
        ({"t": 3}, r"pkg/Type\.t\.secs: missing in int"),
        ({"a": [1, "x"]}, r"pkg/Type\.a: expected a number"),
        ({"a": [1]}, r"pkg/Type\.a: expected 2 elements, got 1"),
        ({"w": ["a", 1]}, r"pkg/Type\.w\[1\]: expected a string"),
        ({"w": None}, r"pkg/Type\.w: expected a list, got NoneType"),
        ({"i": [None]}, r"pkg/Type\.i\[0\]\.x: missing in NoneType"),
        ({"i": [{"x": []}]}, r"pkg/Type\.i\[0\]: expected a message pkg/Inner, got dict"),
        ({"w": "ab"}, r"pkg/Type\.w: expected a list, got str"),
        ({"fixed": []}, r"pkg/Type\.fixed: expected 1 elements, got 0"),
    ],
)
def test_fault_names_the_field(values: dict[str, object], fault: str) -> None:
    codec = codec_of(Inner="int32[] x")
    text = (
        "uint8 n\nfloat32 f\nstring s\ntime t\nfloat64[2] a\nstring[] w\nInner[] i\nInner[1] fixed"
    )
    message = new(codec, text, **values)
    with pytest.raises(MessageValueError, match=fault):
        codec.encode("pkg/Type", message)


def test_message_of_another_type() -> None:
    codec = codec_of(Type="int32 x", Other="int32 y")
    other = codec.decode("pkg/Other", bytes(4))
    with pytest.raises(MessageValueError, match=r"pkg/Type\.x: missing in Other"):
        codec.encode("pkg/Type", other)


@pytest.mark.parametrize(
    ("text", "data"),
    [
        ("int32 x", b"\0\0\0"),
        ("int32 x", b"\0\0\0\0\0"),
        ("", b"\0"),
        ("string s", b"\xff\xff\xff\xff"),
        ("string s", b"\x01\0\0\0\xff\xff"),
        ("string[] s", b"\xff\xff\xff\xff\x01\0\0\0\xff"),
        ("uint8[] x", b"\xff\xff\xff\xff"),
        ("float64[] x", b"\xff\xff\xff\x1f" + bytes(64)),
        ("float64[2] x", bytes(8)),
        ("string[] x", b"\xff\xff\xff\xff"),
        ("time[] x", b"\xff\xff\xff\xff" + bytes(64)),
        ("Inner[] x", b"\xff\xff\xff\xff" + bytes(64)),
    ],
)
def test_hostile_bytes(text: str, data: bytes) -> None:
    codec = codec_of(Inner="uint8 x", Type=text)
    with pytest.raises(DecodeError, match="pkg/Type"):
        codec.decode("pkg/Type", data)


def test_long_fixed_arrays() -> None:
    codec = codec_of(Type="uint8[100000] x")
    assert len(codec.encode("pkg/Type", codec.decode("pkg/Type", bytes(100000)))) == 100000
    with pytest.raises(DefinitionError, match=r"pkg/Long\.x: array of more than 4096 string"):
        codec_of(Long=f"string[{MAX_FIXED + 1}] x")


TEXTS = codec_of(
    Inner="string y", Type="uint8[] d\nstring s\nstring[] w\nstring[2] two\nInner[] i\nfloat32[] f"
)


@given(st.lists(st.binary(max_size=8), min_size=5, max_size=5))
def test_strings_of_any_bytes_come_back_as_they_came(texts: list[bytes]) -> None:
    a, b, c, d, e = (struct.pack("<I", len(text)) + text for text in texts)
    one = struct.pack("<I", 1)
    data = one + b"\xff" + a + one + b + c + d + one + e + one + struct.pack("<f", 0.5)
    message = TEXTS.decode("pkg/Type", data)
    assert message.s.encode(errors="surrogateescape") == texts[0]
    assert message.i[0].y.encode(errors="surrogateescape") == texts[4]
    assert (message.d.tolist(), message.f.tolist()) == ([255], [0.5])
    assert bytes(TEXTS.encode("pkg/Type", message)) == data


def test_a_text_that_is_not_utf8_is_plain_and_the_message_stays_as_it_was() -> None:
    """A program may cut it, join it and send the pieces on."""
    codec = codec_of(Type="string s\nint32[] n\nstring[] w")
    message = codec.decode("pkg/Type", b"\x03\0\0\0a\xe9b" + bytes(8))
    assert (type(message.s), message.s) == (str, "a\udce9b")
    words = message.w = [message.s[1:]]
    message.n = [7]
    data = bytes(codec.encode("pkg/Type", message))
    assert data == b"\x03\0\0\0a\xe9b" + struct.pack("<IiII", 1, 7, 1, 2) + b"\xe9b"
    assert (message.w is words, message.n, type(words[0])) == (True, [7], str)


EVERY_KIND = (
    "bool b\nstring s\nint64 i\ntime t\nuint8[] a\nfloat32[2] f\nbool[] flags\nstring[] w\n"
    "Inner inner\nInner[] some\nduration[2] d"
)
CODEC = codec_of(Inner="uint16[] x\nstring y", Type=EVERY_KIND)


@given(st.binary(max_size=120))
def test_any_bytes_are_a_message_or_refused(data: bytes) -> None:
    try:
        message = CODEC.decode("pkg/Type", data)
    except DecodeError:
        return
    assert CODEC.decode("pkg/Type", CODEC.encode("pkg/Type", message)) is not None


@given(
    st.integers(-(2**63), 2**63 - 1),
    st.text(),
    st.binary(),
    st.lists(st.lists(st.integers(0, 65535), max_size=3), max_size=3),
    st.lists(st.booleans(), max_size=3),
)
def test_any_message_comes_back(
    number: int, text: str, data: bytes, some: list[list[int]], flags: list[bool]
) -> None:
    message = CODEC.decode("pkg/Type", bytes(CODEC.encode("pkg/Type", DEFAULT)))
    inner_class = type(message.inner)
    message.i, message.s, message.a, message.flags = number, text, data, flags
    message.some = [inner_class(x=x, y=text) for x in some]
    back = CODEC.decode("pkg/Type", CODEC.encode("pkg/Type", message))
    assert (back.i, back.s, back.a.tobytes(), back.flags.tolist()) == (number, text, data, flags)
    assert [inner.x.tolist() for inner in back.some] == some


DEFAULT = CODEC.add(parse_message("pkg/Type", EVERY_KIND))()


def test_a_text_is_no_list_of_texts() -> None:
    codec = codec_of()
    for text in ("string[] words", "string[3] words"):
        message = new(codec, text, words="abc")
        with pytest.raises(MessageValueError, match=r"pkg/Type\.words: expected a list, got str"):
            codec.encode("pkg/Type", message)
    message = new(codec, "uint8[] data", data="abc")
    with pytest.raises(MessageValueError, match=r"pkg/Type\.data: expected a sequence, got str"):
        codec.encode("pkg/Type", message)


@pytest.mark.parametrize("value", [2, "no", None, []])
def test_what_is_no_bool(value: object) -> None:
    codec = codec_of()
    for text, held in (("bool b", value), ("bool[] b", [value]), ("bool[1] b", [value])):
        message = new(codec, text, b=held)
        with pytest.raises(MessageValueError, match=r"pkg/Type\.b: expected a bool"):
            codec.encode("pkg/Type", message)


def test_what_stands_for_a_bool() -> None:
    codec = codec_of()
    message = new(codec, "bool a\nbool[] b\nbool[2] c", a=np.True_, b=[0, True], c=[1, np.False_])
    assert codec.encode("pkg/Type", message) == b"\1\2\0\0\0\0\1\1\0"
    assert codec.decode("pkg/Type", b"\5\0\0\0\0\0\0").a is True


def test_warm_runs_the_code_once() -> None:
    codec = codec_of(Inner="int32 x", Type="Inner i\nInner[] j")
    codec.warm("pkg/Type")
