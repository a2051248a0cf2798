"""Connection headers."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.errors import TcprosError
from crosnode.tcpros.header import decode_header, encode_header, missing_field, sums_agree
from crosnode.tcpros.reader import length_of


def field(text: bytes) -> bytes:
    return length_of(text) + text


def test_bytes_of_a_header() -> None:
    body = field(b"callerid=/talker") + field(b"type=std_msgs/String")
    fields = {"callerid": "/talker", "type": "std_msgs/String"}
    assert encode_header(fields) == length_of(body) + body
    assert decode_header(body) == fields


keys = st.text(st.characters(exclude_characters="=", exclude_categories=("Cs",)))
values = st.text(st.characters(exclude_categories=("Cs",)))


@given(st.dictionaries(keys, values))
def test_any_fields_come_back(fields: dict[str, str]) -> None:
    assert decode_header(encode_header(fields)[4:]) == fields


def test_equals_sign_in_a_value() -> None:
    assert decode_header(field(b"message_definition=int32 A=1\n")) == {
        "message_definition": "int32 A=1\n"
    }


def test_later_of_two_fields_counts() -> None:
    assert decode_header(field(b"a=1") + field(b"a=2")) == {"a": "2"}


def test_not_utf_8() -> None:
    assert decode_header(field(b"a=\xff")) == {"a": "\ufffd"}


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        (b"\0\0\0", "ends within a length at byte 0"),
        (field(b"a=1") + b"\1", "ends within a length at byte 7"),
        (b"\xff\xff\xff\xff", "field of 4294967295 bytes at byte 4 leaves"),
        (field(b"a=1")[:-1], "field of 3 bytes at byte 4 leaves"),
        (field(b""), "without '=' at byte 4"),
        (field(b"callerid"), "without '=' at byte 4"),
    ],
)
def test_refused(body: bytes, reason: str) -> None:
    with pytest.raises(TcprosError, match=reason):
        decode_header(body)


@given(st.binary())
def test_any_bytes(body: bytes) -> None:
    try:
        fields = decode_header(body)
    except TcprosError:
        return
    assert decode_header(encode_header(fields)[4:]) == fields


def test_missing_field() -> None:
    assert missing_field({"a": "", "c": ""}, ("a", "b", "c")) == "missing required 'b' field"
    assert missing_field({"a": ""}, ("a",)) is None


def test_sums() -> None:
    assert sums_agree("1", "1")
    assert sums_agree("*", "1")
    assert sums_agree("1", "*")
    assert not sums_agree("1", "2")
