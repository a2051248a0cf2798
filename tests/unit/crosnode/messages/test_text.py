"""Texts of any bytes, and back."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.messages.text import (
    EscapedBytes,
    EscapedText,
    bytes_of,
    escaped,
    is_utf8,
    to_latin1,
)
from crosnode.messages.values import Time


@given(st.binary())
def test_any_bytes_come_back(data: bytes) -> None:
    text = bytes(EscapedBytes(data)[0 : len(data)]).decode()
    assert bytes_of(text) == data
    assert EscapedText(text).encode() == data
    assert is_utf8(text) == (text.encode(errors="replace") == data)


def test_bytes_are_still_numbers() -> None:
    data = EscapedBytes(b"ab")
    assert (data[0], list(data), memoryview(data)[1]) == (97, [97, 98], 98)


def test_a_surrogate_that_stands_for_no_byte_is_refused() -> None:
    assert not is_utf8("\ud800")
    for encode in (bytes_of, lambda text: EscapedText(text).encode()):
        with pytest.raises(UnicodeEncodeError):
            encode("\ud800")


@pytest.mark.parametrize(
    ("data", "text"),
    [(b"gr\xc3\xbc\xc3\x9f", "grüß"), (b"gr\xfc\xdf", "grüß"), ("€ 5".encode(), "? 5"), (b"", "")],
)
def test_what_a_string_of_the_controller_holds(data: bytes, text: str) -> None:
    assert to_latin1(data.decode(errors="surrogateescape")) == text


def test_a_copy_is_escaped_and_the_rest_stays() -> None:
    time, value = Time(1, 2), ["a", ("b",), 3, None]
    copies = escaped([time, value])
    assert copies == [Time(1, 2), ["a", ["b"], 3, None]]
    assert copies[0] is not time
    assert (type(copies[1][0]), type(value[0])) == (EscapedText, str)
